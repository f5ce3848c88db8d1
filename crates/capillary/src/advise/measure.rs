use pendular_pair::{Bridge, Range};

use super::cells::{self, SHAPE, bodies, gaps};
use super::encode;
use crate::young_laplace::{ExactBridge, SolveError};
use crate::{AnyCapillary, CapillaryLaw, ForceCurve};

/// Measures the error of every law in every cell and returns the bytes of the file that
/// [`advise`](super::advise()) reads, laws in the order of [`AnyCapillary::ALL`].
///
/// It takes a minute. The example `make_advice` writes the result to the place from which it is
/// compiled in; nothing else needs it.
///
/// # Errors
/// [`SolveError`] if a bridge of a cell has no exact solution.
pub fn measure_errors() -> Result<Vec<u8>, SolveError> {
    let laws = AnyCapillary::ALL.len();
    let mut file = vec![0; SHAPE.iter().product::<usize>() * laws];
    for body in bodies() {
        for volume in 0..SHAPE[0] {
            let errors = cell_errors(&body.bridges(volume))?;
            for (gap, errors) in errors.iter().enumerate() {
                let start = cells::offset(body, volume, gap, laws);
                for (code, &error) in file[start..start + laws].iter_mut().zip(errors) {
                    *code = encode(error);
                }
            }
        }
    }
    Ok(file)
}

/// Largest errors of all laws over some bridges, for each cell of the gap.
///
/// Where no bridge stands for a cell (a difference of angles that does not fit the mean) no error
/// is known, and none can be: no bridge lies there.
pub(super) fn cell_errors(bridges: &[Bridge]) -> Result<Vec<Vec<f64>>, SolveError> {
    let mut worst = vec![vec![0.0_f64; AnyCapillary::ALL.len()]; SHAPE[4]];
    for bridge in bridges {
        let exact = ExactBridge::coarse(bridge)?;
        let curves = AnyCapillary::ALL.map(|law| measured(law, bridge));
        for (cell, worst) in worst.iter_mut().enumerate() {
            for part in gaps(cell) {
                let gap = part * exact.rupture().distance;
                let force = exact.force(gap)?;
                for (worst, curve) in worst.iter_mut().zip(&curves) {
                    *worst = worst.max(error(curve, gap, force));
                }
            }
        }
    }
    Ok(worst)
}

/// A law's curve and what it refuses; `None` for the exact law, whose error is the reference's own.
type Measured = Option<Result<crate::AnyCurve, pendular_pair::OutOfRange>>;

fn measured(law: AnyCapillary, bridge: &Bridge) -> Measured {
    (law != AnyCapillary::YoungLaplace).then(|| law.curve(bridge, Range::Strict))
}

fn error(measured: &Measured, gap: f64, exact: f64) -> f64 {
    match measured {
        None => 0.0,
        Some(Err(_)) => f64::INFINITY,
        Some(Ok(curve)) => {
            let error = (curve.force(gap) / exact - 1.0).abs();
            if error.is_nan() { f64::INFINITY } else { error }
        }
    }
}
