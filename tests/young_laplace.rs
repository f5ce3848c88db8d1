//! The exact bridge against every row of data/young_laplace_reference.csv.

use std::path::Path;

use pendular_capillary::tabulated::Tabulated;
use pendular_capillary::young_laplace::{ExactBridge, YoungLaplace};
use pendular_capillary::{Bridge, CapillaryLaw, ForceCurve, Mate, Range};

/// Force, neck radius and half-filling angles within 1e-8 on all rows; the laws made of them.
#[test]
fn every_row_of_the_reference() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../data/young_laplace_reference.csv");
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path).unwrap();
    let mut worst = [0.0_f64; 5];
    let mut rows = 0;
    for record in reader.records() {
        let record = record.unwrap();
        let number = |k: usize| record[k].parse::<f64>().unwrap();
        let mate = match number(2) {
            f64::INFINITY => Mate::PLANE,
            radius => Mate::Sphere { radius },
        };
        let angles = [number(5).to_radians(); 2];
        let bridge = Bridge::new(number(1), mate, number(3), angles, number(4)).unwrap();
        let (gap, force) = (number(7), number(8));
        let solved = ExactBridge::new(&bridge).unwrap().solve(gap).unwrap();
        let curve = YoungLaplace.curve(&bridge, Range::Strict).unwrap();
        let table = Tabulated.curve(&bridge, Range::Strict).unwrap();
        let second = if mate.is_wall() { 1.0 } else { solved.half_filling_angles[1] / number(11) };
        let ratios = [
            solved.force / force,
            curve.force(gap) / force,
            solved.neck_radius / number(9),
            solved.half_filling_angles[0] / number(10),
            second,
        ];
        for (worst, ratio) in worst.iter_mut().zip(ratios) {
            *worst = worst.max((ratio - 1.0).abs());
        }
        let error = (table.force(gap) / force - 1.0).abs();
        assert!(error < 1e-3, "tabulated, case {}: {error:e}", &record[0]);
        rows += 1;
    }
    assert_eq!(rows, 210);
    assert!(worst.iter().all(|&error| error < 1e-8), "{worst:?}");
}
