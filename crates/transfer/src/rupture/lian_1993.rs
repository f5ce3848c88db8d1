use std::f64::consts::PI;

use pendular_pair::{Bridge, OutOfRange, Range, Validity};

use super::distance;
use crate::RuptureLaw;

/// Rupture distance of Lian, Thornton & Adams (1993), from Young-Laplace shapes of equal spheres.
///
/// ```text
/// S_rup = R (1 + θ/2) V*^(1/3) = (1 + θ/2) ∛V,   V* = V/R³
/// ```
/// R is the harmonic radius and θ the mean contact angle. R cancels, so unequal spheres and a
/// wall get the distance of equal spheres with the same volume.
///
/// # Range
/// Equal spheres, θ ≤ 50°, 1e-7 ≤ V* ≤ 0.1: within 5 % of the exact bridge. Outside: unequal
/// spheres (17 % too long at a ratio of 2, 34 % at 10) and walls (39 %), by V* = 0.1; unequal
/// contact angles, because the smaller angle's neck gives way and the mean angle is the wrong
/// measure (33 % at 15°/45°). `Range::Extrapolate` evaluates the same formula everywhere.
///
/// # Limits
/// V → 0: goes to 0 as ∛V. Grows with V and θ without end.
///
/// # Example
/// ```
/// use pendular_transfer::{Bridge, Mate, Range, RuptureLaw, rupture::Lian1993};
/// let mate = Mate::Sphere { radius: 1e-3 };
/// let bridge = Bridge::new(1e-3, mate, 1e-12, [0.2, 0.2], 0.07275)?;
/// // By hand: ∛V = 0.1 mm, 1 + θ/2 = 1.1.
/// assert!((Lian1993.distance(&bridge, Range::Strict)? - 1.1e-4).abs() < 1e-17);
/// # Ok::<(), pendular_transfer::OutOfRange>(())
/// ```
///
/// # References
/// Lian, Thornton & Adams (1993), J. Colloid Interface Sci. 161, 138; Elskamp & Kruggel-Emden
/// (2018), eq. (30).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Lian1993;

impl RuptureLaw for Lian1993 {
    fn validity(&self) -> Validity {
        Validity {
            v_star: (1e-7, 0.1),
            contact_angle: (0.0, 50.0 / 180.0 * PI),
            angle_difference: 0.0,
            radius_ratio: (1.0, 1.0),
        }
    }

    fn distance(&self, bridge: &Bridge, range: Range) -> Result<f64, OutOfRange> {
        self.validity().admit(bridge, range)?;
        distance((1.0 + 0.5 * bridge.mean_contact_angle()) * bridge.volume().cbrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use pendular_pair::Mate;

    /// MercuryDPM's wet collision breaks at (1 + θ/2) ∛V: r = 0.87 mm, 35°, 1.06e-9 m³.
    #[test]
    fn mercury_wet_collision() {
        let theta = 35f64.to_radians();
        let b = Bridge::new(8.7e-4, Mate::Sphere { radius: 8.7e-4 }, 1.06e-9, [theta; 2], 0.0728);
        let s = Lian1993.distance(&b.unwrap(), Range::Extrapolate).unwrap();
        assert_relative_eq!(s, 1.3311e-3, max_relative = 1e-4);
    }

    #[test]
    fn thin_bridges_and_unequal_angles_are_outside() {
        let bridge = |v, angles| Bridge::new(1.0, Mate::Sphere { radius: 1.0 }, v, angles, 1.0);
        let strict = |v, a| Lian1993.distance(&bridge(v, a).unwrap(), Range::Strict);
        assert!(strict(1e-3, [0.3, 0.3]).is_ok());
        assert!(strict(1e-8, [0.3, 0.3]).unwrap_err().quantity.contains("V/R^3"));
        assert!(strict(1e-3, [0.3, 0.4]).unwrap_err().quantity.contains("difference"));
        assert!(Lian1993.distance(&bridge(1e-8, [0.3, 0.4]).unwrap(), Range::Extrapolate).is_ok());
    }
}
