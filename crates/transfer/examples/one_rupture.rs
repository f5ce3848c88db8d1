//! The liquid of one bridge, from the films to the films.
//!
//! `cargo run -p pendular-transfer --example one_rupture`

use pendular_transfer::formation::{WetMate, claims, films_touch};
use pendular_transfer::split::TransferTable;
use pendular_transfer::{AnyRupture, Bridge, Dynamic, Range, RuptureLaw, film};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // POM spheres of 10 and 5 mm with water films, pulled apart at 0.1 m/s.
    let (radii, mut films) = ([5e-3, 2.5e-3], [3.5e-8, 4.5e-9]);
    let angles = [40f64.to_radians(); 2];
    let h = [film::thickness(radii[0], films[0])?, film::thickness(radii[1], films[1])?];
    println!("films        {:.1} and {:.1} µm", 1e6 * h[0], 1e6 * h[1]);
    assert!(films_touch(1.5e-4, h));

    let mate = WetMate::Sphere { radius: radii[1], film_volume: films[1] };
    let given = claims(radii[0], films[0], mate)?;
    films = [films[0] - given[0], films[1] - given[1]];
    println!("given        {:.3} and {:.3} mm³", 1e9 * given[0], 1e9 * given[1]);

    let bridge = Bridge::new(radii[0], mate.mate(), given[0] + given[1], angles, 0.07275)?;
    let rest = AnyRupture::WillettUnequal.distance(&bridge, Range::Strict)?;
    let moving = rest * Dynamic::Pitois2001 { viscosity: 1e-3 }.factor(&bridge, 0.1)?;
    println!("breaks at    {:.3} mm at rest, {:.3} mm moving", 1e3 * rest, 1e3 * moving);

    let table = TransferTable::for_pair(radii[0], mate.mate(), angles)?;
    let back = table.at_volume(bridge.volume())?.shares(bridge.volume());
    films = [films[0] + back[0], films[1] + back[1]];
    println!("given back   {:.3} and {:.3} mm³", 1e9 * back[0], 1e9 * back[1]);
    println!("films        {:.3} and {:.3} mm³", 1e9 * films[0], 1e9 * films[1]);
    Ok(())
}
