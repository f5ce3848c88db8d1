use std::f64::consts::{FRAC_PI_2, PI};

use pendular_pair::{Bridge, OutOfRange, Range, Validity};

use super::exact::ExactBridge;
use super::path::Solver;
use super::problem::{Problem, State};
use crate::checked::finite;
use crate::{CapillaryLaw, ForceCurve};

/// The exact force of a bridge: the Young-Laplace equation solved at every call.
///
/// ```text
/// F = 2 π σ y cos α + π σ q y²   (constant along the meridian; q = −Δp/σ)
/// ```
///
/// # Units
/// gap m, volume m³, contact angle rad, surface tension N/m → force N, tension positive.
/// # Range
/// V* from 1e-9 to 0.5, contact angles to 90°, any two spheres and sphere-plane.
/// `Range::Extrapolate` solves any bridge for which a stable one is found. 1e-9 relative.
/// # Limits
/// gap → 0: πRσ(cos θᵢ + cos θⱼ) less a deficit like V*^(1/4). Beyond rupture the force at rupture
/// fades like the small-bridge factor a²/(H(H + S)), a² = 2V/(πR), H = √(S² + a²).
/// # Cost
/// About a millisecond per curve and ten microseconds per force: the reference, not a law for
/// simulations.
/// # References
/// See the [module](crate::young_laplace).
///
/// ```
/// use pendular_capillary::young_laplace::YoungLaplace;
/// use pendular_capillary::{Bridge, CapillaryLaw, ForceCurve, Mate, Range};
/// // Two spheres of 2.381 mm, 13.6 nl, 20.6 mN/m, θ = 0 at S = 120.5 µm: 39.067 µN by an
/// // independent solver.
/// let mate = Mate::Sphere { radius: 2.381e-3 };
/// let bridge = Bridge::new(2.381e-3, mate, 13.6e-12, [0.0; 2], 20.6e-3)?;
/// let curve = YoungLaplace.curve(&bridge, Range::Strict)?;
/// assert!((curve.force(1.20544793052e-4) / 3.906676002e-5 - 1.0).abs() < 1e-9);
/// # Ok::<(), pendular_capillary::OutOfRange>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct YoungLaplace;

/// Coefficients of the polynomial that starts Newton's method.
const TERMS: usize = 6;

/// The exact force over the gap of one bridge.
///
/// It holds the dimensionless problem and, in single precision, a polynomial in √(1 − S/S_rup) from
/// which Newton's method starts; the force itself is solved in full precision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct YoungLaplaceCurve {
    problem: Problem,
    mirror: bool,
    /// Metres per unit of the solver's gap.
    gap_unit: f64,
    /// π σ R, N
    strength: f64,
    /// Rupture distance in units of the solver.
    end: f64,
    start: [[f32; TERMS]; 3],
}

impl CapillaryLaw for YoungLaplace {
    type Curve = YoungLaplaceCurve;

    fn validity(&self) -> Validity {
        Validity { v_star: (1e-9, 0.5), contact_angle: (0.0, FRAC_PI_2), ..Validity::ALL }
    }

    fn curve(&self, bridge: &Bridge, range: Range) -> Result<Self::Curve, OutOfRange> {
        self.validity().admit(bridge, range)?;
        let none = OutOfRange {
            quantity: "dimensionless volume V/R^3 of a stable bridge",
            value: bridge.v_star(),
            allowed: self.validity().v_star,
        };
        let curve = YoungLaplaceCurve::new(bridge).ok_or(none)?;
        // F/(πσR) stays below some tens.
        finite("force scale π σ R", 1e3 * curve.strength)?;
        Ok(curve)
    }
}

impl YoungLaplaceCurve {
    fn new(bridge: &Bridge) -> Option<Self> {
        let exact = ExactBridge::new(bridge).ok()?;
        let setup = exact.setup();
        let mut curve = Self {
            problem: setup.solver.problem,
            mirror: setup.solver.mirror,
            gap_unit: setup.gap_unit(),
            strength: PI * setup.scale * bridge.surface_tension(),
            end: exact.rupture().distance / setup.gap_unit(),
            start: [[0.0; TERMS]; 3],
        };
        let mut rows = [[0.0; TERMS]; TERMS];
        let mut values = [[0.0; TERMS]; 3];
        for (k, row) in rows.iter_mut().enumerate() {
            // Chebyshev-Lobatto points in τ, both ends included.
            let tau = 0.5 - 0.5 * (PI * k as f64 / (TERMS - 1) as f64).cos();
            let gap = curve.end * (1.0 - tau * tau);
            let state = exact.scaled_state(gap)?;
            let torus = curve.torus(gap);
            for (n, entry) in row.iter_mut().enumerate() {
                *entry = tau.powi(n as i32);
            }
            for (value, (s, t)) in values.iter_mut().zip(state.iter().zip(torus)) {
                value[k] = s - t;
            }
        }
        for (terms, value) in curve.start.iter_mut().zip(values) {
            *terms = super::newton::solve_linear(rows, value)?.map(|c| c as f32);
        }
        Some(curve)
    }

    fn solver(&self) -> Solver {
        Solver { problem: self.problem, mirror: self.mirror }
    }

    /// The part of a state that a small bridge's torus explains: ln β_i, 0, ln L.
    fn torus(&self, gap: f64) -> State {
        let spread = self.problem.curvature + 1.0 / self.problem.radius;
        let a2 = 2.0 * self.problem.volume * spread / PI;
        let height = (gap * gap + a2).sqrt();
        let depth = a2 / (height + gap);
        [0.5 * (2.0 * depth / spread).ln() - self.problem.radius.ln(), 0.0, height.ln()]
    }

    fn guess(&self, gap: f64) -> State {
        let tau = (1.0 - gap / self.end).max(0.0).sqrt();
        let torus = self.torus(gap);
        let sum = |k: usize| {
            self.start[k].iter().rev().fold(0.0, |sum, &c| sum * tau + f64::from(c)) + torus[k]
        };
        [sum(0), sum(1), sum(2)]
    }

    /// The state at a gap up to rupture: Newton from the guess, else the whole continuation.
    fn state(&self, gap: f64) -> State {
        let (guess, solver) = (self.guess(gap), self.solver());
        let near = |s: &State| (0..3).all(|k| (s[k] - guess[k]).abs() < 0.05);
        solver
            .at_gap(gap, guess)
            .filter(|state| near(state) && solver.stable(state))
            .or_else(|| solver.path().ok()?.state(&solver, gap))
            .unwrap_or(guess)
    }
}

impl ForceCurve for YoungLaplaceCurve {
    fn force(&self, gap: f64) -> f64 {
        let gap = gap.max(0.0) / self.gap_unit;
        // The last part in 1e14 before the fold is rounding.
        let inside = gap.min(self.end * (1.0 - 1e-14));
        let force = self.strength * self.problem.pull(&self.state(inside));
        if gap <= self.end {
            return force;
        }
        let spread = self.problem.curvature + 1.0 / self.problem.radius;
        let a2 = 2.0 * self.problem.volume * spread / PI;
        let small = |s: f64| {
            let height = (s * s + a2).sqrt();
            a2 / (height * (height + s))
        };
        force * small(gap) / small(self.end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pendular_pair::Mate;

    fn bridges() -> Vec<Bridge> {
        let degrees = |a: f64, b: f64| [a.to_radians(), b.to_radians()];
        let sphere = |radius| Mate::Sphere { radius };
        [
            (sphere(1.0), 1e-9, degrees(0.0, 0.0)),
            (sphere(1.0), 0.5, degrees(60.0, 60.0)),
            (sphere(1.0 + 1e-7), 1e-3, degrees(45.0, 45.0)),
            (sphere(0.3), 1e-2, degrees(80.0, 20.0)),
            (sphere(1.0), 1e-3, degrees(90.0, 90.0)),
            (Mate::PLANE, 0.5, degrees(15.0, 45.0)),
            (Mate::PLANE, 1e-6, degrees(0.0, 0.0)),
        ]
        .map(|(mate, v, angles)| {
            let scale = Bridge::new(1.0, mate, 1.0, angles, 1.0).unwrap().harmonic_radius();
            Bridge::new(1.0, mate, v * scale.powi(3), angles, 0.5).unwrap()
        })
        .to_vec()
    }

    #[test]
    fn the_curve_is_the_exact_bridge() {
        for bridge in bridges() {
            let exact = ExactBridge::new(&bridge).unwrap();
            let curve = YoungLaplace.curve(&bridge, Range::Strict).unwrap();
            let distance = exact.rupture().distance;
            for k in 0..=40 {
                let gap = distance * (1.0 - (1.0 - f64::from(k) / 40.0).powi(3)) * (1.0 - 1e-9);
                let (a, b) = (exact.force(gap).unwrap(), curve.force(gap));
                assert!((a / b - 1.0).abs() < 1e-9, "{bridge:?} {k}: {a} {b}");
            }
        }
    }

    #[test]
    fn overlap_is_contact_and_beyond_rupture_the_force_fades_out() {
        for bridge in bridges() {
            let curve = YoungLaplace.curve(&bridge, Range::Strict).unwrap();
            assert_eq!(curve.force(-1.0), curve.force(0.0));
            let end = curve.end * curve.gap_unit;
            let (at, after) = (curve.force(end), curve.force(1.000001 * end));
            assert!((after / at - 1.0).abs() < 1e-2 && curve.force(1e3 * end) < 1e-2 * at);
            assert_eq!(curve.force(f64::INFINITY), 0.0);
        }
    }

    #[test]
    fn the_curve_stays_small() {
        assert!(size_of::<YoungLaplaceCurve>() <= 152);
    }

    #[test]
    fn no_bridge_is_an_error() {
        let mate = Mate::Sphere { radius: 1.0 };
        let fat = Bridge::new(1.0, mate, 3.0, [0.0; 2], 1.0).unwrap();
        assert!(YoungLaplace.curve(&fat, Range::Strict).is_err());
        let drop = Bridge::new(1.0, mate, 1e6, [0.0; 2], 1.0).unwrap();
        assert!(YoungLaplace.curve(&drop, Range::Extrapolate).is_err());
    }
}
