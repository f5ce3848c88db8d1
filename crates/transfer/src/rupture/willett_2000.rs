use std::f64::consts::PI;

use pendular_pair::{Bridge, OutOfRange, Range, Validity};

use super::distance;
use crate::RuptureLaw;

/// Rupture distance of Willett et al. (2000) for equal spheres.
///
/// ```text
/// S_rup = R (1 + θ/2) (V*^(1/3) + V*^(2/3)/10),   V* = V/R³
/// ```
/// R is the harmonic radius and θ the mean contact angle. For unequal spheres and walls this is
/// the formula of the equal spheres of radius R (2 rᵢ against a wall);
/// [`WillettUnequal2000`](super::WillettUnequal2000) knows the radii.
///
/// # Range
/// Equal spheres, θ ≤ 50°, 1e-7 ≤ V* ≤ 0.3: −2.7 to +4.1 % off the exact bridge. Outside: unequal
/// spheres (23 % too long at a ratio of 2, 40 % at 10) and walls (45 %), by V* = 0.1; unequal
/// contact angles (35 % at 15°/45°).
///
/// # Limits
/// V* → 0: [`Lian1993`](super::Lian1993).
///
/// # Example
/// ```
/// use pendular_transfer::{Bridge, Mate, Range, RuptureLaw, rupture::Willett2000};
/// let mate = Mate::Sphere { radius: 1e-3 };
/// let bridge = Bridge::new(1e-3, mate, 1e-12, [0.2, 0.2], 0.07275)?;
/// // By hand: V* = 1e-3, so R·1.1·(0.1 + 0.001).
/// assert!((Willett2000.distance(&bridge, Range::Strict)? - 1.111e-4).abs() < 1e-17);
/// # Ok::<(), pendular_transfer::OutOfRange>(())
/// ```
///
/// # References
/// Willett, Adams, Johnson & Seville (2000), Langmuir 16, 9396; Elskamp & Kruggel-Emden (2018),
/// eq. (31).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Willett2000;

impl RuptureLaw for Willett2000 {
    fn validity(&self) -> Validity {
        Validity {
            v_star: (1e-7, 0.3),
            contact_angle: (0.0, 50.0 / 180.0 * PI),
            angle_difference: 0.0,
            radius_ratio: (1.0, 1.0),
        }
    }

    fn distance(&self, bridge: &Bridge, range: Range) -> Result<f64, OutOfRange> {
        self.validity().admit(bridge, range)?;
        let radius = bridge.harmonic_radius();
        let x = bridge.volume().cbrt() / radius;
        distance(radius * (1.0 + 0.5 * bridge.mean_contact_angle()) * (x + 0.1 * x * x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rupture::{Lian1993, WillettUnequal2000};
    use approx::assert_relative_eq;
    use pendular_pair::Mate;

    fn at(law: impl RuptureLaw, v: f64, mate: f64, theta: f64) -> f64 {
        let b = Bridge::new(1.0, Mate::Sphere { radius: mate }, v, [theta; 2], 1.0).unwrap();
        law.distance(&b, Range::Extrapolate).unwrap()
    }

    #[test]
    fn small_volume_limit_is_lian() {
        assert_relative_eq!(
            at(Willett2000, 1e-24, 1.0, 0.4),
            at(Lian1993, 1e-24, 1.0, 0.4),
            max_relative = 2e-9
        );
    }

    #[test]
    fn the_unequal_form_reduces_to_it_for_equal_spheres() {
        for (v, theta) in [(1e-6, 0.0), (1e-3, 0.3), (0.2, 0.8)] {
            assert_relative_eq!(
                at(Willett2000, v, 1.0, theta),
                at(WillettUnequal2000, v, 1.0, theta),
                max_relative = 1e-14
            );
        }
    }

    /// 0.98 of the distance of W11 (r = 2.381 mm, V = 13.6 nl, θ = 0) is a gap of 236.27 µm.
    #[test]
    fn w11() {
        let r = 2.381e-3;
        let b = Bridge::new(r, Mate::Sphere { radius: r }, 13.6e-12, [0.0; 2], 0.0206).unwrap();
        let s = Willett2000.distance(&b, Range::Strict).unwrap();
        assert_relative_eq!(s * 0.98, 0.000236267794382, max_relative = 1e-11);
    }
}
