use std::f64::consts::PI;

use pendular_pair::{Bridge, OutOfRange, Range, Validity};

use crate::checked::{finite, positive};
use crate::{CapillaryLaw, ForceCurve};

/// Bagheri's rational fit to the Young-Laplace bridge of equal spheres; unequal spheres and a plane
/// through the harmonic radius.
///
/// ```text
/// F = σ R f_t (1 + a_s x) / (1 + a_t b_s a_s x + a_t b_s x²),   x = S/S_rup,   v = V/R³
/// S_rup = R (1 + θ/2) (v^(1/3) + v^(2/3)/10),   θ = (θᵢ + θⱼ)/2,   L = ln v
/// f₀ = 2 π (1 − 0.3823 v^0.2586)
/// f_t = f₀ (1 − (0.4158 v^0.2835 + 0.6474) (sin θ)^(2.267 − 0.2087 v^0.3113))
/// a_s = 0.6717 v^0.1995 − 0.3319 v^0.4974,   b_s = 13.84 v^−0.3909 − 12.11 v^−0.3945
/// a_t = 1 + (0.6669 v^−0.01391 − 1.78 v^0.8351) θ + (−0.007815 L² − 0.2105 L − 1.426) θ³
/// ```
///
/// # Units
/// Gap m, volume m³, contact angle rad, surface tension N/m; force N, tension positive.
///
/// # Range
/// 1e-4 ≤ V* ≤ 0.1, angles up to 50°, at most 40° apart. Against the exact bridge of equal spheres:
/// within 1 % at contact (2 % for 50°), 6 % at half the rupture gap (11 %), 20 % at 0.9 of it
/// (32 %). The harmonic radius adds 2 to 4 % at a radius ratio of 2 and 7 % on a plane at V* = 0.1.
/// Even extrapolated it refuses a bridge whose denominator has a zero: from about 55°, V* = 0.36 on.
///
/// # Limits
/// Gap → 0 and V → 0: `2 π R σ (1 − 0.6474 sin^2.267 θ)`, within 1 % of `2 π R σ cos θ` up to 40°.
/// Against a plane R = 2 rᵢ. In the range never increases with the gap.
///
/// # Example
/// ```
/// use pendular_capillary::{Bagheri2024, Bridge, CapillaryLaw, Mate, Range};
/// let mate = Mate::Sphere { radius: 2.381e-3 };
/// let bridge = Bridge::new(2.381e-3, mate, 13.6e-12, [0.0; 2], 20.6e-3)?;
/// let force = Bagheri2024.force(&bridge, 4.82e-7, Range::Strict)?;
/// // The exact Young-Laplace force is 0.2864 mN.
/// assert!((force / 0.2864e-3 - 1.0).abs() < 0.01);
/// # Ok::<(), pendular_capillary::OutOfRange>(())
/// ```
///
/// # References
/// Bagheri, Roy, Pöschel (2024), Approximate expressions for the capillary force and the surface
/// area of a liquid bridge between identical spheres, Comput. Part. Mech.; coefficients as in the
/// authors' implementation in MercuryDPM (arXiv:2411.02042).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Bagheri2024;

/// The force of [`Bagheri2024`] over the gap: one division per call.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bagheri2024Curve {
    /// σ R f_t, N.
    contact: f64,
    /// 1/S_rup, 1/m.
    scale: f64,
    /// a_s.
    numerator: f64,
    /// a_t b_s a_s and a_t b_s.
    denominator: [f64; 2],
}

/// The ratio S/S_rup at which the curve stops: its square is finite and the force long gone.
const FAR: f64 = 1e150;

/// [f_t, a_s, b_s, a_t] of dimensionless volume v and angle θ.
fn coefficients(v: f64, theta: f64) -> [f64; 4] {
    let log_v = v.ln();
    let f0 = 2.0 * PI * (1.0 - 0.3823 * v.powf(0.2586));
    let wetting = theta.sin().powf(2.267 - 0.2087 * v.powf(0.3113));
    let ft = f0 * (1.0 - (0.4158 * v.powf(0.2835) + 0.6474) * wetting);
    let a_s = 0.6717 * v.powf(0.1995) - 0.3319 * v.powf(0.4974);
    let b_s = 13.84 * v.powf(-0.3909) - 12.11 * v.powf(-0.3945);
    let a_t = 1.0
        + (0.6669 * v.powf(-0.01391) - 1.78 * v.powf(0.8351)) * theta
        + (-0.007815 * log_v * log_v - 0.2105 * log_v - 1.426) * theta.powi(3);
    [ft, a_s, b_s, a_t]
}

impl CapillaryLaw for Bagheri2024 {
    type Curve = Bagheri2024Curve;

    fn validity(&self) -> Validity {
        Validity {
            v_star: (1e-4, 0.1),
            contact_angle: (0.0, 50f64.to_radians()),
            angle_difference: 40f64.to_radians(),
            radius_ratio: (1.0, f64::INFINITY),
        }
    }

    fn curve(&self, bridge: &Bridge, range: Range) -> Result<Bagheri2024Curve, OutOfRange> {
        self.validity().admit(bridge, range)?;
        let radius = positive("harmonic radius", bridge.harmonic_radius())?;
        let v = positive("dimensionless volume V/R^3", bridge.v_star())?;
        let theta = bridge.mean_contact_angle();
        let [ft, a_s, b_s, a_t] = coefficients(v, theta);
        // 1 + q a_s x + q x² has no zero at x ≥ 0 if q ≥ 0 and q a_s > −2 √q.
        let q = a_t * b_s;
        OutOfRange::within("denominator coefficient a_t b_s", q, (0.0, 1e200))?;
        let linear = q.sqrt() * a_s;
        OutOfRange::within("denominator coefficient a_s sqrt(a_t b_s)", linear, (-1.999, 1e100))?;
        let cube_root = v.cbrt();
        let rupture = radius * (1.0 + 0.5 * theta) * (cube_root + 0.1 * cube_root * cube_root);
        Ok(Bagheri2024Curve {
            contact: finite("contact force", bridge.surface_tension() * radius * ft)?,
            scale: positive("inverse rupture distance", 1.0 / rupture)?,
            numerator: a_s,
            denominator: [finite("denominator coefficient a_t b_s a_s", q * a_s)?, q],
        })
    }
}

impl ForceCurve for Bagheri2024Curve {
    #[inline]
    fn force(&self, gap: f64) -> f64 {
        let x = (gap.max(0.0) * self.scale).min(FAR);
        let [linear, square] = self.denominator;
        self.contact * ((1.0 + self.numerator * x) / (1.0 + x * (linear + square * x)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checked::bridges::{plane, spheres, w11};

    #[test]
    fn close_to_the_exact_bridge() {
        // Exact Young-Laplace forces of W11 at 0.002, 0.3 and 0.8 of the rupture gap.
        let curve = Bagheri2024.curve(&w11(), Range::Strict).unwrap();
        for (gap, exact, band) in [
            (4.82179172208e-7, 2.863996349e-4, 0.01),
            (7.23268758312e-5, 7.732324779e-5, 0.03),
            (1.92871668883e-4, 1.865228915e-5, 0.06),
        ] {
            let error = curve.force(gap) / exact - 1.0;
            assert!(error.abs() < band, "{gap}: {error}");
        }
    }

    #[test]
    fn contact_of_a_vanishing_bridge() {
        let b = spheres(1.0, 1.0, 1e-12, [0.7; 2], 1.0);
        let force = Bagheri2024.force(&b, 0.0, Range::Extrapolate).unwrap();
        assert!((force / (2.0 * PI * 0.7f64.cos()) - 1.0).abs() < 0.01);
    }

    #[test]
    fn a_pole_is_refused_and_the_far_end_is_finite() {
        let pole = spheres(1.0, 1.0, 0.4, [1.0; 2], 1.0);
        assert!(Bagheri2024.curve(&pole, Range::Extrapolate).is_err());
        let b = plane(1e-3, 1e-11, [0.3; 2], 0.07);
        let curve = Bagheri2024.curve(&b, Range::Strict).unwrap();
        assert!(curve.force(f64::MAX).abs() < 1e-100);
        assert_eq!(curve.force(-1.0), curve.force(0.0));
    }
}
