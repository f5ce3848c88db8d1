//! Restitution against impact speed from each law, and one loading cycle that yields.
//!
//! A lactose sphere of 0.2 mm against a rigid wall (E = 2.5 GPa, ν = 0.2, p_y = 27 MPa, Krull et al.
//! 2025). Run with `cargo run --release -p pendular-contact --example rebound`.

use pendular_contact::{
    AnyContact, ContactError, Elastic, ElasticPlastic, HertzMindlin, Linear, NormalContact,
    PlasticMemory, impact,
};

fn main() -> Result<(), ContactError> {
    let radius: f64 = 1e-4;
    let mass = 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3) * 1540.0;
    let modulus = Elastic::new(2.5e9, 0.2)?.effective_modulus_on_rigid();
    let plastic = ElasticPlastic::new(modulus, radius, 27e6)?;
    let laws: [AnyContact; 3] = [
        Linear::from_restitution(1e4, 0.8, mass)?.into(),
        HertzMindlin::from_restitution(modulus, radius, 0.8, mass)?.into(),
        plastic.into(),
    ];

    println!("yields at {:.3e} m/s", plastic.yield_speed(mass));
    println!(
        "{:>10} {:>10} {:>14} {:>16} {:>10}",
        "speed", "linear", "hertz-mindlin", "elastic-plastic", "energy"
    );
    for exponent in -3..=1 {
        let speed = 10f64.powi(exponent);
        print!("{speed:>10}");
        for (law, width) in laws.iter().zip([10, 14, 16]) {
            let time_step = 2e-4 * (mass / law.stiffness(1e-2 * radius)).sqrt();
            print!(" {:>width$.4}", impact(law, mass, speed, time_step)?.restitution);
        }
        println!(" {:>10.4}", plastic.restitution(mass, speed)?);
    }

    println!("\n{:>12} {:>12} {:>12}", "overlap nm", "loading mN", "unloading mN");
    let mut memory = PlasticMemory::default();
    let overlaps: Vec<f64> = (0..=10).map(|k| f64::from(k) * 1e-7).collect();
    let mut force = |s: &f64| 1e3 * plastic.force(*s, 0.0, &mut memory);
    let loading: Vec<f64> = overlaps.iter().map(&mut force).collect();
    let mut unloading: Vec<f64> = overlaps.iter().rev().map(&mut force).collect();
    unloading.reverse();
    for ((s, up), down) in overlaps.iter().zip(loading).zip(unloading) {
        println!("{:>12.0} {up:>12.4} {down:>12.4}", s * 1e9);
    }
    println!("permanent deformation {:.0} nm", memory.plastic_overlap * 1e9);
    Ok(())
}
