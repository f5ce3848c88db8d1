//! One water bridge between two glass spheres: the force over the gap by every law that holds.
//!
//! Run with `cargo run -p pendular-capillary --example one_bridge`.

use pendular_capillary::{AnyCapillary, Bridge, CapillaryLaw, ForceCurve, Mate, OutOfRange, Range};

fn main() -> Result<(), OutOfRange> {
    let angle = 15f64.to_radians();
    let bridge = Bridge::new(2.5e-3, Mate::Sphere { radius: 3.5e-3 }, 1e-10, [angle; 2], 0.07275)?;
    println!("V* = {:.2e}, R = {:.3} mm", bridge.v_star(), bridge.harmonic_radius() * 1e3);

    let gaps = [0.0, 10e-6, 50e-6, 100e-6, 200e-6];
    println!("{:<28}{}", "gap [µm]", gaps.map(|gap| format!("{:>9.0}", gap * 1e6)).concat());
    for law in AnyCapillary::ALL {
        match law.curve(&bridge, Range::Strict) {
            Ok(curve) => {
                let forces = gaps.map(|gap| format!("{:>9.4}", curve.force(gap) * 1e3));
                println!("{:<28}{} mN", law.name(), forces.concat());
            }
            Err(reason) => println!("{:<28}  {reason}", law.name()),
        }
    }
    Ok(())
}
