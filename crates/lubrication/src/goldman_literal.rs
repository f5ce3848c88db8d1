use std::f64::consts::PI;

use pendular_pair::{Bridge, Mate, OutOfRange};

use crate::Regularisation;
use crate::gap::Clearance;
use crate::popov_2010::scale;

/// Elskamp & Kruggel-Emden's tangential law as printed. **Not a drag**: for comparison only.
///
/// With v the relative velocity of the centres and w = (r_i ω_i + r_j ω_j) × n, both across the
/// line of centres:
///
/// ```text
/// F = −(a v + b w)         on body i;  torques r_i n × F on i, r_j n × F on j
/// a = 6 π η R* (8/15 ln(R*/s) + 0.9588)
/// b = 6 π η R* (2/15 ln(R*/s) − 0.2526)                          s < 0.1 R*
/// b = 6 π η R*/8 (R*/(s + R*))⁴ (1 − 3 R*/(8 (s + R*)))          s ≥ 0.1 R*
/// ```
///
/// It is no [`crate::Resistance`], because a ≠ b with one torque row breaks both of its promises:
/// - it brakes a pair that rotates as one rigid body (v = −w, so F = (a − b) w);
/// - it can feed energy: the power F (v + w) is positive for v between −w and −(b/a) w. A pair of
///   equal solid spheres can double its kinetic energy at s = 0.001 R*.
///
/// Besides, b jumps by 3 % at s = 0.1 R* and a is negative beyond 6.04 R*.
/// [`crate::Goldman1967`] and [`crate::JeffreyOnishi1984`] are the passive forms.
///
/// # Units
/// Gap m, viscosity Pa s, velocities m/s → N, N m.
///
/// # References
/// Elskamp & Kruggel-Emden (2018), Chem. Eng. Res. Des. 136, 593, eqs. (28), (29), after Goldman,
/// Cox & Brenner (1967).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GoldmanLiteral {
    /// How gap and overlap are treated.
    pub near: Regularisation,
}

/// [`GoldmanLiteral`] over the gap of one bridge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GoldmanLiteralCurve {
    scale: f64,
    reduced_radius: f64,
    radii: [f64; 2],
    clearance: Clearance,
}

/// What [`GoldmanLiteral`] puts on a pair, along one direction across the line of centres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LiteralLoad {
    /// Force on body i, N; the opposite acts on j.
    pub force: f64,
    /// Torques on i and j, N m, about n × (the direction); 0 on a wall.
    pub torques: [f64; 2],
}

impl GoldmanLiteral {
    /// The law's name, beside [`crate::TangentialModel::NAMES`].
    pub const NAME: &'static str = "goldman-literal";

    /// Folds a bridge and the liquid's `viscosity` η, Pa s.
    ///
    /// # Errors
    /// [`OutOfRange`] unless the viscosity and the regularisation are positive and finite.
    pub fn curve(
        &self,
        bridge: &Bridge,
        viscosity: f64,
    ) -> Result<GoldmanLiteralCurve, OutOfRange> {
        let clearance = self.near.fold(bridge)?;
        let other = match bridge.mate() {
            Mate::Sphere { radius } => radius,
            Mate::Wall { .. } => 0.0,
        };
        Ok(GoldmanLiteralCurve {
            scale: 6.0 * PI * scale(bridge, viscosity, &clearance)?,
            reduced_radius: bridge.reduced_radius(),
            radii: [bridge.radius(), other],
            clearance,
        })
    }
}

impl GoldmanLiteralCurve {
    /// The printed coefficients [a, b] of translation and rotation at `gap` (m), N s/m.
    #[must_use]
    pub fn coefficients(&self, gap: f64) -> [f64; 2] {
        let closeness = self.reduced_radius / self.clearance.at(gap);
        let logarithm = closeness.ln();
        let rotation = if closeness > 10.0 {
            2.0 / 15.0 * logarithm - 0.2526
        } else {
            let near = closeness / (1.0 + closeness);
            near.powi(4) * (1.0 - 0.375 * near) / 8.0
        };
        let scale = self.scale * self.clearance.weight(gap);
        [scale * (8.0 / 15.0 * logarithm + 0.9588), scale * rotation]
    }

    /// Force and torques at `gap` (m) for the velocities `translation` v and `rotation` w (m/s).
    #[must_use]
    pub fn load(&self, gap: f64, translation: f64, rotation: f64) -> LiteralLoad {
        let [a, b] = self.coefficients(gap);
        let force = -(a * translation + b * rotation);
        LiteralLoad { force, torques: self.radii.map(|radius| radius * force) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Gap, Goldman1967, TangentialCurve, TangentialDrag};

    const NEAR: Regularisation =
        Regularisation { gap: Gap::CutOff { length: 1e-9 }, overlap: crate::Overlap::Fade };

    fn equal() -> GoldmanLiteralCurve {
        let bridge = Bridge::new(2.0, Mate::Sphere { radius: 2.0 }, 1.0, [0.0; 2], 1.0).unwrap();
        GoldmanLiteral { near: NEAR }.curve(&bridge, 1.0).unwrap()
    }

    #[test]
    fn brakes_a_rigid_rotation() {
        // touching spheres, both turning with Ω = 1: w = (r_i + r_j) Ω, v = −(r_i + r_j) Ω
        let [a, b] = equal().coefficients(1e-3);
        let load = equal().load(1e-3, -4.0, 4.0);
        assert!((load.force - 4.0 * (a - b)).abs() < 1e-12 * a);
        // it loses energy that no relative motion of the surfaces takes
        let torque_power: f64 = load.torques.iter().sum();
        assert!(load.force > 0.5 * a && torque_power > 0.0);
    }

    /// Largest growth of the kinetic energy of two equal solid spheres, mass 1 each, which the law
    /// alone brings to rest (a v + b w = 0). J the impulse: Δv = 2 J, Δw = 2 r · r J/(2 r²/5) = 5 J.
    fn greatest_growth(s: f64) -> f64 {
        let [a, b] = equal().coefficients(s);
        let energy = |v: f64, w: f64| v * v / 4.0 + w * w / 10.0;
        let growth = |g: f64| {
            let impulse = -(a - b * g) / (2.0 * a + 5.0 * b);
            energy(1.0 + 2.0 * impulse, -g + 5.0 * impulse) / energy(1.0, -g)
        };
        (100..400).map(|k| growth(f64::from(k) / 100.0)).fold(0.0, f64::max)
    }

    #[test]
    fn doubles_the_energy_of_a_pair() {
        // found by time integration elsewhere: 1.99 at S = 0.001 R*, 3.1 at 0.1 R*
        assert!((greatest_growth(1e-3) - 1.99).abs() < 0.01, "{}", greatest_growth(1e-3));
        assert!((greatest_growth(0.1) - 3.1).abs() < 0.05, "{}", greatest_growth(0.1));
    }

    #[test]
    fn has_a_seam_and_a_sign_change() {
        let rotation = |s: f64| equal().coefficients(s)[1];
        let seam = rotation(0.1 * (1.0 + 1e-9)) / rotation(0.1 * (1.0 - 1e-9)) - 1.0;
        assert!((0.02..0.05).contains(&seam), "{seam}");
        assert!(equal().coefficients(7.0)[0] < 0.0);
    }

    #[test]
    fn on_a_plane_its_force_is_goldmans_but_its_torque_is_not() {
        let bridge = Bridge::new(1.0, Mate::PLANE, 1.0, [0.0; 2], 1.0).unwrap();
        let literal = GoldmanLiteral { near: NEAR }.curve(&bridge, 1.0).unwrap();
        let passive = Goldman1967 { near: NEAR }.curve(&bridge, 1.0).unwrap().resistance(1e-3);
        let (v, w) = (0.3, -0.8);
        let (u, q) = (v + w, w);
        let force = -(passive.slip * u + passive.coupling * q);
        let torque = force - (passive.coupling * u + passive.rolling * q);
        let load = literal.load(1e-3, v, w);
        assert!((load.force / force - 1.0).abs() < 1e-12);
        assert!((load.torques[0] - torque).abs() > 0.5 * torque.abs());
        assert_eq!(load.torques[1], 0.0);
    }
}
