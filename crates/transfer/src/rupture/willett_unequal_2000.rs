use std::f64::consts::PI;

use pendular_pair::{Bridge, OutOfRange, Range, Validity};

use super::distance;
use crate::RuptureLaw;

/// Rupture distance of Willett et al. (2000) for spheres of different size.
///
/// ```text
/// S_rup = R (1 + (θᵢ + θⱼ)/8 (1 + q)) (V*^(1/3) + (q/2 − 2/5) V*^(2/3)),   q = r_small/r_large
/// ```
/// R is the harmonic radius, V* = V/R³. The bodies are ordered inside, so either may come first.
/// A wall is the limit q → 0 with R = 2 rᵢ.
///
/// # Range
/// Any radius ratio and walls, θ ≤ 50°, 1e-7 ≤ V* ≤ 0.3, equal contact angles: −10.4 to +4.1 % off
/// the exact bridge, most for walls with little liquid; −6.7 to +4.0 % for 1e-4 ≤ V* ≤ 0.1.
/// Contact angles that differ by up to 5° are inside, too: −13.1 to +12.2 %. Beyond, the smaller angle's
/// neck gives way and the mean angle is the wrong measure (35 % at 15°/45°).
///
/// # Limits
/// q = 1: [`Willett2000`](super::Willett2000). For q < 0.8 the second term is negative and the
/// distance would fall again beyond V* = (4/5 − q)⁻³ (1.95 against a wall). There a larger bridge
/// would break earlier: with any [`Range`] that is an error.
///
/// # Example
/// ```
/// use pendular_transfer::{Bridge, Mate, Range, RuptureLaw, rupture::WillettUnequal2000};
/// let mate = Mate::Sphere { radius: 2e-3 };
/// let bridge = Bridge::new(2e-3 / 3.0, mate, 1e-12, [0.3, 0.3], 0.07275)?;
/// // By hand: q = 1/3, R = 1 mm, V* = 1e-3: 1 mm (1 + 0.1) (0.1 − 0.01·7/30).
/// let s = WillettUnequal2000.distance(&bridge, Range::Strict)?;
/// assert!((s - 1.1e-3 * (0.1 - 0.07 / 30.0)).abs() < 1e-16);
/// # Ok::<(), pendular_transfer::OutOfRange>(())
/// ```
///
/// # References
/// Willett, Adams, Johnson & Seville (2000), Langmuir 16, 9396; Elskamp & Kruggel-Emden (2018),
/// eq. (32).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct WillettUnequal2000;

impl RuptureLaw for WillettUnequal2000 {
    fn validity(&self) -> Validity {
        Validity {
            v_star: (1e-7, 0.3),
            contact_angle: (0.0, 50.0 / 180.0 * PI),
            // A little more than 5°, so that 40° and 45° in radians differ by no more.
            angle_difference: 5.000001 / 180.0 * PI,
            radius_ratio: (1.0, f64::INFINITY),
        }
    }

    fn distance(&self, bridge: &Bridge, range: Range) -> Result<f64, OutOfRange> {
        self.validity().admit(bridge, range)?;
        let q = 1.0 / bridge.radius_ratio();
        let second = 0.5 * q - 0.4;
        if second < 0.0 {
            let turn = (-0.5 / second).powi(3);
            OutOfRange::within("dimensionless volume V/R^3", bridge.v_star(), (0.0, turn))?;
        }
        let radius = bridge.harmonic_radius();
        let x = bridge.volume().cbrt() / radius;
        let angle = 1.0 + 0.25 * bridge.mean_contact_angle() * (1.0 + q);
        distance(radius * angle * (x + second * x * x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use pendular_pair::Mate;

    fn at(bridge: &Bridge) -> Result<f64, OutOfRange> {
        WillettUnequal2000.distance(bridge, Range::Extrapolate)
    }

    #[test]
    fn unequal_case_by_hand() {
        // r = 3 and 1, θ = 0.2 and 0.6: q = 1/3, R = 1.5, V = 0.027 → x = 0.2.
        let b = Bridge::new(3.0, Mate::Sphere { radius: 1.0 }, 0.027, [0.2, 0.6], 1.0).unwrap();
        let by_hand = 1.5 * (1.0 + 0.1 * 4.0 / 3.0) * (0.2 + (1.0 / 6.0 - 0.4) * 0.04);
        assert_relative_eq!(at(&b).unwrap(), by_hand, max_relative = 1e-14);
        assert_relative_eq!(at(&b.swapped().unwrap()).unwrap(), by_hand, max_relative = 1e-14);
    }

    #[test]
    fn a_wall_is_the_limit_of_a_large_sphere() {
        let with = |mate| at(&Bridge::new(1.0, mate, 0.01, [0.2, 0.6], 1.0).unwrap()).unwrap();
        let huge = with(Mate::Sphere { radius: 1e12 });
        assert_relative_eq!(with(Mate::PLANE), huge, max_relative = 1e-11);
    }

    /// Gaps at 0.002 of this distance in an independent table (θ = 0): W21 and a sphere on a plane.
    #[test]
    fn gaps_of_an_independent_table() {
        let r = 2.381e-3;
        let at = |mate, v| at(&Bridge::new(r, mate, v, [0.0; 2], 0.0206).unwrap()).unwrap();
        let w21 = at(Mate::Sphere { radius: 1.588e-3 }, 9.6e-12);
        assert_relative_eq!(0.002 * w21, 4.21909044292e-07, max_relative = 1e-11);
        let plane = at(Mate::PLANE, 1.624e-10);
        assert_relative_eq!(0.002 * plane, 1.04116267426e-06, max_relative = 1e-11);
    }

    #[test]
    fn it_stops_where_it_would_turn_over() {
        let on_plane =
            |v_star: f64| at(&Bridge::new(0.5, Mate::PLANE, v_star, [0.0; 2], 1.0).unwrap());
        assert!(on_plane(1.95).is_ok());
        let refused = on_plane(1.96).unwrap_err();
        assert_relative_eq!(refused.allowed.1, 1.953125, max_relative = 1e-12);
        // The error stands at the greatest value the formula takes.
        assert!(on_plane(1.95).unwrap() > on_plane(1.9).unwrap());
        let printed = |v: f64| v.cbrt() - 0.4 * v.cbrt().powi(2);
        assert!(printed(2.0) < printed(1.953125));
    }

    #[test]
    fn nearly_equal_spheres_never_turn_over() {
        let b = Bridge::new(1.0, Mate::Sphere { radius: 0.8 }, 1e3, [0.0; 2], 1.0).unwrap();
        assert!(at(&b).is_ok());
    }
}
