use std::f64::consts::PI;

use pendular_pair::{Bridge, Mate, OutOfRange};

use crate::gap::Clearance;
use crate::popov_2010::scale;
use crate::{Regularisation, Resistance, TangentialCurve, TangentialDrag};

/// The exact leading logarithm of the tangential resistance, two spheres of any radii or a plane.
///
/// ```text
/// (A, B, D) = π η R* ln(R*/s) · ( 8/5 (2 − 3 x y),  12/5 (x − y),  24/5 )     0 for s ≥ R*
/// x = r_i/(r_i + r_j),  y = r_j/(r_i + r_j)  (plane: x = 0, y = 1),  s = S + s_r or max(S, h_min)
/// ```
///
/// The determinant A D − B² is 48/5 (π η R* ln)² for every ratio, so the law is passive. Equal
/// spheres have A = 2 π η R* ln and no coupling; a plane has A = 3.2 π η R* ln.
///
/// # Units
/// Gap m, viscosity Pa s → N s/m.
///
/// # Range
/// S ≪ R*: the terms that stay finite as S → 0 are left out.
///
/// # Example
/// ```
/// use pendular_lubrication::{Bridge, Gap, JeffreyOnishi1984, Mate};
/// use pendular_lubrication::{TangentialCurve, TangentialDrag};
/// let bridge = Bridge::new(1e-3, Mate::Sphere { radius: 2e-3 }, 1e-11, [0.0; 2], 0.07)?;
/// let law = JeffreyOnishi1984 { near: Gap::CutOff { length: 1e-6 }.into() };
/// let drag = law.curve(&bridge, 1.0)?.resistance(0.0);
/// // radii 1:2, by hand: A = 32/15, B = −4/5 times π · 1 · 2e-3/3 · ln(2000/3)
/// assert!((drag.slip - 0.029052511).abs() < 1e-8);
/// assert!((drag.coupling + 0.010894692).abs() < 1e-8);
/// # Ok::<(), pendular_lubrication::OutOfRange>(())
/// ```
///
/// # References
/// Jeffrey & Onishi (1984), J. Fluid Mech. 139, 261: the logarithms of Y^A, Y^B and Y^C, brought
/// into slip and rolling.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JeffreyOnishi1984 {
    /// How gap and overlap are treated.
    pub near: Regularisation,
}

/// [`JeffreyOnishi1984`] over the gap of one bridge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JeffreyOnishi1984Curve {
    /// A, B and D over ln(R*/s).
    factors: Resistance,
    reduced_radius: f64,
    clearance: Clearance,
}

impl TangentialDrag for JeffreyOnishi1984 {
    type Curve = JeffreyOnishi1984Curve;

    fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<Self::Curve, OutOfRange> {
        let clearance = self.near.fold(bridge)?;
        let scale = PI * scale(bridge, viscosity, &clearance)?;
        let (x, y) = match bridge.mate() {
            Mate::Wall { .. } => (0.0, 1.0),
            Mate::Sphere { radius } => {
                (bridge.radius() / (bridge.radius() + radius), radius / (bridge.radius() + radius))
            }
        };
        let factors = Resistance {
            slip: 1.6 * (2.0 - 3.0 * x * y) * scale,
            coupling: 2.4 * (x - y) * scale,
            rolling: 4.8 * scale,
        };
        Ok(JeffreyOnishi1984Curve { factors, reduced_radius: bridge.reduced_radius(), clearance })
    }
}

impl TangentialCurve for JeffreyOnishi1984Curve {
    #[inline]
    fn resistance(&self, gap: f64) -> Resistance {
        let logarithm = (self.reduced_radius / self.clearance.at(gap)).ln().max(0.0);
        let strength = logarithm * self.clearance.weight(gap);
        Resistance {
            slip: self.factors.slip * strength,
            coupling: self.factors.coupling * strength,
            rolling: self.factors.rolling * strength,
        }
    }

    fn fade(&self) -> Option<f64> {
        Some(self.clearance.fade())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Gap;

    /// A, B, D over π η R* ln(R*/s), and r_i/R*.
    fn factors(ratio: f64) -> ([f64; 3], f64) {
        let mate = Mate::Sphere { radius: 2.0 * ratio };
        let bridge = Bridge::new(2.0, mate, 1.0, [0.0; 2], 1.0).unwrap();
        let law = JeffreyOnishi1984 { near: Gap::CutOff { length: 1e-12 }.into() };
        let r = law.curve(&bridge, 1.0).unwrap().resistance(bridge.reduced_radius() * 1e-6);
        let unit = PI * bridge.reduced_radius() * 1e6_f64.ln();
        ([r.slip / unit, r.coupling / unit, r.rolling / unit], 2.0 / bridge.reduced_radius())
    }

    /// The published functions, Kim & Karrila (1991) table 11.2, λ = r_j/r_i, coefficient of the
    /// logarithm: force by translation, force by own rotation, torque by own and by the other's.
    #[test]
    fn published_resistance_functions() {
        for ratio in [1e-3, 0.1, 0.5, 1.0, 2.0, 30.0, 1e4] {
            let l: f64 = ratio;
            let ([a, b, d], radius) = factors(l);
            let near = |ours: f64, theirs: f64| {
                assert!(
                    (ours - theirs).abs() < 1e-9 * theirs.abs().max(1e-3),
                    "{l} {ours} {theirs}"
                );
            };
            // units: π η R* for force, lengths in R*
            let (ri, rj) = (radius, radius * l);
            near(a, 6.0 * ri * 4.0 * l * (2.0 + l + 2.0 * l * l) / (15.0 * (1.0 + l).powi(3)));
            // v = 0, ω_i = 1, ω_j = 0: u = r_i, q = R* = 1
            let (force, rolling) = (a * ri + b, b * ri + d);
            near(force, 4.0 * ri * ri * l * (4.0 + l) / (5.0 * (1.0 + l).powi(2)));
            near(ri * force + rolling, 8.0 * ri.powi(3) * 2.0 * l / (5.0 * (1.0 + l)));
            // ω_j = 1 alone: u = r_j, q = −1, torque on i
            let other = ri * (a * rj - b) + (b * rj - d);
            near(other, (ri + rj).powi(3) * 4.0 * l * l / (5.0 * (1.0 + l).powi(4)));
        }
    }

    #[test]
    fn limits_and_symmetry() {
        let close = |got: [f64; 3], want: [f64; 3]| {
            assert!(got.iter().zip(want).all(|(g, w)| (g - w).abs() < 1e-5), "{got:?}");
        };
        close(factors(1.0).0, [2.0, 0.0, 4.8]);
        // Goldman's plane: 6 (8/15, 2/15 − 8/15, 8/15 − 4/15 + 8/15)
        close(factors(1e7).0, [3.2, -2.4, 4.8]);
        let [a, b, d] = factors(3.0).0;
        close(factors(1.0 / 3.0).0, [a, -b, d]);
        assert!((a * d - b * b - 9.6).abs() < 1e-9);
    }
}
