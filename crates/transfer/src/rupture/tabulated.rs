use pendular_capillary::{CapillaryLaw, tabulated};
use pendular_pair::{Bridge, OutOfRange, Range, Validity};

use crate::RuptureLaw;

/// Exact rupture distance of the Young-Laplace bridge, from the table of `pendular-capillary`.
///
/// The bridge breaks where it loses stability: at the fold of the force curve, or before it at the
/// pitchfork to a lopsided shape (above about 31° of contact angle).
///
/// # Units
/// Lengths m, volume m³, contact angles rad → S_rup m.
///
/// # Range
/// That of the table: any size ratio and plane, each contact angle on its own; within 1e-3 of the
/// exact value. Beyond it the exact solver answers where it can.
///
/// # Example
/// ```
/// use pendular_transfer::{Bridge, Mate, Range, RuptureLaw, rupture::Tabulated};
/// let bridge = Bridge::new(1e-3, Mate::Sphere { radius: 1e-3 }, 1e-12, [0.0; 2], 0.07)?;
/// // Willett's fit gives 1.01e-4 m here, and is good to 4 %.
/// let distance = Tabulated.distance(&bridge, Range::Strict)?;
/// assert!((distance / 1.01e-4 - 1.0).abs() < 0.04);
/// # Ok::<(), pendular_transfer::OutOfRange>(())
/// ```
///
/// # References
/// See [`pendular_capillary::tabulated`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tabulated;

impl RuptureLaw for Tabulated {
    fn validity(&self) -> Validity {
        CapillaryLaw::validity(&tabulated::Tabulated)
    }

    fn distance(&self, bridge: &Bridge, range: Range) -> Result<f64, OutOfRange> {
        self.validity().admit(bridge, range)?;
        tabulated::rupture_distance(bridge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pendular_capillary::young_laplace;
    use pendular_pair::Mate;

    #[test]
    fn is_the_exact_distance_also_where_the_fits_are_far_off() {
        let plane = (Mate::PLANE, [15_f64, 45.0]);
        let pair = (Mate::Sphere { radius: 2e-3 }, [40.0, 40.0]);
        for (mate, degrees) in [plane, pair] {
            let angles = degrees.map(f64::to_radians);
            let bridge = Bridge::new(1e-3, mate, 2e-11, angles, 0.07).unwrap();
            let exact = young_laplace::rupture(&bridge).unwrap().distance;
            let table = Tabulated.distance(&bridge, Range::Strict).unwrap();
            assert!((table / exact - 1.0).abs() < 1e-3, "{table} {exact}");
        }
    }
}
