use std::f64::consts::PI;

use pendular_pair::{Bridge, Mate, OutOfRange};

use crate::gap::Clearance;
use crate::jeffrey_onishi_1984::JeffreyOnishi1984Curve;
use crate::popov_2010::scale;
use crate::{JeffreyOnishi1984, Regularisation, Resistance, TangentialCurve, TangentialDrag};

/// Goldman's sphere near a plane: translation and rotation, force and torque, symmetric.
///
/// With the velocity v of the centre along the plane, w = r ω × n, M the torque over r and
/// L = ln(r/s), s = S + s_r or max(S, h_min):
///
/// ```text
/// F = −(a v + b w)      a = 6 π η r max(0, 8/15 L + 0.9588)
/// M = −(b v + d w)      b = 6 π η r max(0, 2/15 L − 0.2526)
///                       d = 6 π η r max(0, 8/15 L + 0.509)
/// A = a,   B = b − a,   D = d − 2 b + a        in slip u = v + w and rolling q = w
/// ```
///
/// **Two spheres** get [`JeffreyOnishi1984`]: the formulas of a plane are not symmetric in two
/// bodies, and their leading logarithms are that law's at infinite ratio.
///
/// # Units
/// Gap m, viscosity Pa s → N s/m.
///
/// # Range
/// S < 0.1 r. b is 0 from 0.15 r on, d from 2.6 r, a from 6.04 r; all without a jump.
///
/// # Example
/// ```
/// use pendular_lubrication::{Bridge, Gap, Goldman1967, Mate, TangentialCurve, TangentialDrag};
/// let bridge = Bridge::new(1e-3, Mate::PLANE, 1e-11, [0.0; 2], 0.07)?;
/// let law = Goldman1967 { near: Gap::CutOff { length: 1e-6 }.into() };
/// // by hand, L = ln 1000: a = 6 π · 1e-3 · 4.642966
/// assert!((law.curve(&bridge, 1.0)?.resistance(0.0).slip - 0.0875173).abs() < 1e-7);
/// # Ok::<(), pendular_lubrication::OutOfRange>(())
/// ```
///
/// # References
/// Goldman, Cox & Brenner (1967), Chem. Eng. Sci. 22, 637: force and torque of translation and
/// rotation. Departs from Elskamp & Kruggel-Emden (2018), eqs. (28), (29): see
/// [`crate::GoldmanLiteral`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Goldman1967 {
    /// How gap and overlap are treated.
    pub near: Regularisation,
}

/// [`Goldman1967`] over the gap of one bridge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Goldman1967Curve(Kind);

#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Plane { scale: f64, radius: f64, clearance: Clearance },
    Spheres(JeffreyOnishi1984Curve),
}

impl TangentialDrag for Goldman1967 {
    type Curve = Goldman1967Curve;

    fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<Self::Curve, OutOfRange> {
        if let Mate::Sphere { .. } = bridge.mate() {
            let spheres = JeffreyOnishi1984 { near: self.near };
            return Ok(Goldman1967Curve(Kind::Spheres(spheres.curve(bridge, viscosity)?)));
        }
        let clearance = self.near.fold(bridge)?;
        let scale = 6.0 * PI * scale(bridge, viscosity, &clearance)?;
        Ok(Goldman1967Curve(Kind::Plane { scale, radius: bridge.radius(), clearance }))
    }
}

impl TangentialCurve for Goldman1967Curve {
    #[inline]
    fn resistance(&self, gap: f64) -> Resistance {
        match &self.0 {
            Kind::Spheres(curve) => curve.resistance(gap),
            Kind::Plane { scale, radius, clearance } => {
                let logarithm = (radius / clearance.at(gap)).ln();
                let a = (8.0 / 15.0 * logarithm + 0.9588).max(0.0);
                let b = (2.0 / 15.0 * logarithm - 0.2526).max(0.0);
                let d = (8.0 / 15.0 * logarithm + 0.509).max(0.0);
                let scale = scale * clearance.weight(gap);
                Resistance {
                    slip: scale * a,
                    coupling: scale * (b - a),
                    rolling: scale * (d - 2.0 * b + a),
                }
            }
        }
    }

    fn fade(&self) -> Option<f64> {
        match &self.0 {
            Kind::Spheres(curve) => curve.fade(),
            Kind::Plane { clearance, .. } => Some(clearance.fade()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Gap;

    fn plane(gap: f64) -> Resistance {
        let bridge = Bridge::new(1.0, Mate::PLANE, 1.0, [0.0; 2], 1.0).unwrap();
        let law = Goldman1967 { near: Gap::CutOff { length: 1e-12 }.into() };
        law.curve(&bridge, 1.0 / (6.0 * PI)).unwrap().resistance(gap)
    }

    /// The original's asymptotes in its own units, forces over 6 π η r U and torques over 8 π η r² U
    /// (or r³ Ω), δ = S/r.
    #[test]
    fn force_and_torque_rows_of_the_original() {
        let s: f64 = 3.202e-3;
        let r = plane(s);
        // translation alone: v = 1, w = 0, so u = 1, q = 0
        let (force, torque) = (r.slip, r.slip + r.coupling);
        assert!((force - (-8.0 / 15.0 * s.ln() + 0.9588)).abs() < 1e-12);
        // T^t* = −(1/10 ln δ + 0.1895), unit 8 π η r² U = 4/3 of ours
        assert!((torque - 4.0 / 3.0 * (-0.1 * s.ln() - 0.1895)).abs() < 1e-4);
        // rotation alone: v = 0, w = 1, so u = q = 1; the force is the torque of translation
        let (force, torque) = (r.slip + r.coupling, r.slip + 2.0 * r.coupling + r.rolling);
        assert!((force - (-2.0 / 15.0 * s.ln() - 0.2526)).abs() < 1e-12);
        // T^r* = 2/5 ln δ − 0.3817
        assert!((torque - 4.0 / 3.0 * (-0.4 * s.ln() + 0.3817)).abs() < 1e-4);
    }

    #[test]
    fn no_seam_where_a_coefficient_reaches_zero() {
        for edge in [(-0.2526_f64 * 7.5).exp(), (0.509_f64 * 1.875).exp(), 0.1] {
            let (below, above) = (plane(edge * (1.0 - 1e-9)), plane(edge * (1.0 + 1e-9)));
            assert!((below.slip - above.slip).abs() < 1e-8);
            assert!((below.coupling - above.coupling).abs() < 1e-8);
            assert!((below.rolling - above.rolling).abs() < 1e-8);
        }
    }
}
