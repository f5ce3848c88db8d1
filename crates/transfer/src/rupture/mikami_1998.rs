use std::f64::consts::PI;

use pendular_pair::{Bridge, Mate, OutOfRange, Range, Validity};

use super::distance;
use crate::RuptureLaw;

/// Rupture distance of Mikami, Kamiya & Horio (1998), fitted to Young-Laplace shapes.
///
/// ```text
/// two spheres       S_rup = R  (0.99 + 0.62 θ) (V/R³)^0.34
/// sphere and wall   S_rup = rᵢ (0.95 + 0.22 θ) (V/rᵢ³)^0.32
/// ```
/// R is the harmonic radius, rᵢ the sphere's own, θ the mean contact angle. The fits were made
/// for equal spheres; R carries the first one to unequal ones.
///
/// # Range
/// The two formulas have a range each; [`Mikami1998::validity`] gives that of the spheres and
/// [`Mikami1998::WALL`] that of the wall. Equal spheres, θ ≤ 50°, 1e-4 ≤ V* ≤ 0.1: −7.4 to +4.9 % off
/// the exact bridge. Sphere and wall, θ ≤ 50°, 1e-6 ≤ V* ≤ 0.03 (V/R³ with R = 2 rᵢ): −2.1 to +12.3 %.
/// Outside: unequal spheres (23 % too long at a ratio of 2, 40 % at 10, by V* = 0.1) and unequal
/// contact angles.
///
/// # Limits
/// Powers of V: grows without end. As V → 0 the exponents, not 1/3, make it 4.5 % smaller (two
/// spheres) or 10 % larger (wall) against ∛V per three decades.
///
/// # Example
/// ```
/// use pendular_transfer::{Bridge, Mate, Range, RuptureLaw, rupture::Mikami1998};
/// let bridge = Bridge::new(1e-3, Mate::PLANE, 1e-9, [0.5, 0.5], 0.07275)?;
/// // By hand: V = rᵢ³, so rᵢ (0.95 + 0.11).
/// assert!((Mikami1998.distance(&bridge, Range::Extrapolate)? - 1.06e-3).abs() < 1e-15);
/// # Ok::<(), pendular_transfer::OutOfRange>(())
/// ```
///
/// # References
/// Mikami, Kamiya & Horio (1998), Chem. Eng. Sci. 53, 1927; Krull, Strohner & Antonyuk (2025),
/// KONA, eqs. (27) and (28) without the factor of the velocity.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Mikami1998;

impl Mikami1998 {
    /// The bridges between a sphere and a wall over which the law holds.
    pub const WALL: Validity = Validity {
        v_star: (1e-6, 0.03),
        contact_angle: (0.0, 50.0 / 180.0 * PI),
        angle_difference: 0.0,
        radius_ratio: (f64::INFINITY, f64::INFINITY),
    };
}

impl RuptureLaw for Mikami1998 {
    /// The range of the formula for two spheres; a wall has [`Mikami1998::WALL`].
    fn validity(&self) -> Validity {
        Validity {
            v_star: (1e-4, 0.1),
            contact_angle: (0.0, 50.0 / 180.0 * PI),
            angle_difference: 0.0,
            radius_ratio: (1.0, 1.0),
        }
    }

    fn wall_validity(&self) -> Validity {
        Self::WALL
    }

    fn distance(&self, bridge: &Bridge, range: Range) -> Result<f64, OutOfRange> {
        self.validity_of(bridge).admit(bridge, range)?;
        let theta = bridge.mean_contact_angle();
        let (radius, factor, exponent) = match bridge.mate() {
            Mate::Sphere { .. } => (bridge.harmonic_radius(), 0.99 + 0.62 * theta, 0.34),
            Mate::Wall { .. } => (bridge.radius(), 0.95 + 0.22 * theta, 0.32),
        };
        let x = bridge.volume().cbrt() / radius;
        distance(radius * factor * x.powf(3.0 * exponent))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rupture::Lian1993;
    use approx::assert_relative_eq;

    #[test]
    fn both_formulas_by_hand() {
        let with = |mate, v| {
            let b = Bridge::new(1.0, mate, v, [0.3, 0.5], 1.0).unwrap();
            Mikami1998.distance(&b, Range::Extrapolate).unwrap()
        };
        let sphere = with(Mate::Sphere { radius: 3.0 }, 1.5f64.powi(3) * 1e-2);
        let by_hand = 1.5 * (0.99 + 0.62 * 0.4) * 1e-2f64.powf(0.34);
        assert_relative_eq!(sphere, by_hand, max_relative = 1e-13);
        let wall = with(Mate::PLANE, 1e-2);
        let by_hand = (0.95 + 0.22 * 0.4) * 1e-2f64.powf(0.32);
        assert_relative_eq!(wall, by_hand, max_relative = 1e-13);
    }

    /// 1e-5 R³ is in the range of a wall, not in that of two spheres.
    #[test]
    fn a_wall_has_its_own_range() {
        let fits = |mate| {
            let b = Bridge::new(1.0, mate, 1e-5, [0.3; 2], 1.0).unwrap();
            let checked = Mikami1998.validity_of(&b).check(&b).is_ok();
            assert_eq!(checked, Mikami1998.distance(&b, Range::Strict).is_ok());
            assert_eq!(checked, crate::AnyRupture::Mikami.validity_of(&b).check(&b).is_ok());
            checked
        };
        assert!(fits(Mate::PLANE) && !fits(Mate::Sphere { radius: 1.0 }));
    }

    /// Two fits to the same exact shapes agree: within 7 % of Lian over the range.
    #[test]
    fn agrees_with_lian_over_the_range() {
        for v in [1e-4, 1e-3, 1e-2, 0.1] {
            for theta in [0.0, 0.4, 0.8] {
                let b = Bridge::new(1.0, Mate::Sphere { radius: 1.0 }, v, [theta; 2], 1.0).unwrap();
                let mikami = Mikami1998.distance(&b, Range::Strict).unwrap();
                let lian = Lian1993.distance(&b, Range::Strict).unwrap();
                assert_relative_eq!(mikami, lian, max_relative = 0.07);
            }
        }
    }
}
