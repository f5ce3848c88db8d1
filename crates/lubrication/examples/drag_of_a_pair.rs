//! Normal and tangential drag of a wet pair over the gap, one column per law.
//!
//! Two 4 mm spheres with 0.5 mm³ of silicone oil (0.1 Pa s) between them, as in the experiments of
//! Pitois et al. Run with `cargo run -p pendular-lubrication --example drag_of_a_pair`.

use pendular_lubrication::{
    Bridge, Gap, Mate, NormalCurve, NormalDrag, NormalModel, OutOfRange, Regularisation,
    TangentialCurve, TangentialDrag, TangentialModel,
};

fn main() -> Result<(), OutOfRange> {
    let mate = Mate::Sphere { radius: 4e-3 };
    let bridge = Bridge::new(4e-3, mate, 5e-10, [10f64.to_radians(); 2], 0.021)?;
    let near = Regularisation::from(Gap::RelativeRoughness { fraction: 0.001 });
    let mut normal = Vec::new();
    for model in NormalModel::ALL {
        normal.push(model.with(near).curve(&bridge, 0.1)?);
    }
    let mut tangential = Vec::new();
    for model in TangentialModel::ALL {
        tangential.push(model.with(near).curve(&bridge, 0.1)?);
    }

    print!("{:>9}", "gap um");
    let names = NormalModel::NAMES.iter().chain(TangentialModel::NAMES);
    names.for_each(|name| print!("{name:>16}"));
    println!("   (N s/m)");
    for gap_um in [-8.0, -4.0, 0.0, 1.0, 10.0, 100.0, 1000.0] {
        let gap = gap_um * 1e-6;
        print!("{gap_um:>9}");
        normal.iter().for_each(|curve| print!("{:>16.6}", curve.coefficient(gap)));
        tangential.iter().for_each(|curve| print!("{:>16.6}", curve.resistance(gap).slip));
        println!();
    }
    Ok(())
}
