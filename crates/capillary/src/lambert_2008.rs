use std::f64::consts::PI;

use pendular_lane::Lane;
use pendular_pair::{Bridge, OutOfRange, Range, Validity};

use crate::checked::{finite, positive};
use crate::{CapillaryLaw, ForceCurve};

/// Rabinovich's force with Lambert's correction: two spheres, or a sphere and a plane.
///
/// ```text
/// F = π σ R (cos θᵢ + cos θⱼ) / (1 + S/(2d)),   d = (S/2) (−1 + √(1 + 2V/(π R S²)))
/// ```
///
/// The code uses the same force as `π σ R (cos θᵢ + cos θⱼ) a²/(H (H + S))` with `a² = 2V/(π R)` and
/// `H = √(S² + a²)`, which has no 0/0 at contact and no cancellation far away. With
/// `R* = R/2` it is also the particle-particle formula of Israelachvili: see
/// [`Israelachvili2011`](crate::Israelachvili2011).
///
/// # Units
/// Gap m, volume m³, contact angle rad, surface tension N/m; force N, tension positive.
///
/// # Range
/// V* = V/R³ ≤ 0.1 and angles up to 50°, at most 40° apart. Against the exact bridge of equal
/// spheres it is too large at contact, by 7 % at V* = 1e-3 and 27 % at 0.1 for θ = 0 (10 and 45 %
/// for 40°; on a plane 8 and 36 %), and too small from mid-gap on, by up to 25 % for θ = 0 and
/// 54 % for 40°. Extrapolated it has a value for every bridge; above 90° it turns repulsive.
///
/// # Limits
/// Gap → 0: `π R σ (cos θᵢ + cos θⱼ)` for any volume. Against a plane R = 2 rᵢ, which is
/// [`RabinovichPlane`](crate::RabinovichPlane). Never increases with the gap.
///
/// # Example
/// ```
/// use pendular_capillary::{Bridge, CapillaryLaw, Lambert2008, Mate, Range};
/// let bridge = Bridge::new(1e-3, Mate::Sphere { radius: 1e-3 }, 1e-11, [0.0; 2], 0.07)?;
/// let contact = Lambert2008.force(&bridge, 0.0, Range::Strict)?;
/// // By hand: 2 π R σ.
/// assert!((contact / (2.0 * std::f64::consts::PI * 1e-3 * 0.07) - 1.0).abs() < 1e-14);
/// # Ok::<(), pendular_capillary::OutOfRange>(())
/// ```
///
/// # References
/// Rabinovich, Esayanur, Moudgil (2005), Langmuir 21, 10992; correction: Lambert, Chau, Delchambre,
/// Régnier (2008), Langmuir 24, 3157. As in Gladkyy & Schwarze (2014), Granul. Matter 16, 911,
/// eq. (12).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Lambert2008;

/// The force of [`Lambert2008`] over the gap: one root and one division per call.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lambert2008Curve {
    /// π σ R (cos θ_i + cos θ_j), N.
    contact: f64,
    /// a² = 2V/(π R), m².
    a_squared: f64,
}

impl Lambert2008Curve {
    /// The curve of a bridge, wherever its constants are finite.
    pub(crate) fn new(bridge: &Bridge) -> Result<Self, OutOfRange> {
        let radius = positive("harmonic radius", bridge.harmonic_radius())?;
        let contact = PI * bridge.surface_tension() * radius * bridge.cosine_sum();
        Ok(Self {
            contact: finite("contact force", contact)?,
            a_squared: positive(
                "squared bridge length 2V/(pi R)",
                2.0 * bridge.volume() / (PI * radius),
            )?,
        })
    }
}

impl CapillaryLaw for Lambert2008 {
    type Curve = Lambert2008Curve;

    fn validity(&self) -> Validity {
        Validity {
            v_star: (0.0, 0.1),
            contact_angle: (0.0, 50f64.to_radians()),
            angle_difference: 40f64.to_radians(),
            radius_ratio: (1.0, f64::INFINITY),
        }
    }

    fn curve(&self, bridge: &Bridge, range: Range) -> Result<Lambert2008Curve, OutOfRange> {
        self.validity().admit(bridge, range)?;
        Lambert2008Curve::new(bridge)
    }
}

impl ForceCurve for Lambert2008Curve {
    #[inline(always)]
    fn force(&self, gap: f64) -> f64 {
        Self::forces::<f64>(&[self], gap)
    }

    #[inline(always)]
    fn forces<L: Lane>(curves: &L::Each<&Self>, gap: L) -> L {
        let permit = gap.permit();
        let [contact, a_squared, ..] =
            L::rows(permit, curves, |curve| [curve.contact, curve.a_squared, 0.0, 0.0]);
        let gap = gap.most(L::splat(permit, 0.0));
        let reach = (gap * gap + a_squared).sqrt();
        contact * (a_squared / (reach * (reach + gap)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Israelachvili2011;
    use crate::checked::bridges::{spheres, w11};

    #[test]
    fn equals_the_printed_formula() {
        let b = w11();
        let curve = Lambert2008.curve(&b, Range::Strict).unwrap();
        for s in [1e-7, 1e-5, 1e-4, 3e-4] {
            let (r, v, sigma) = (b.harmonic_radius(), b.volume(), b.surface_tension());
            let d = 0.5 * s * (-1.0 + (1.0 + 2.0 * v / (PI * r * s * s)).sqrt());
            let printed = 2.0 * PI * sigma * r / (1.0 + s / (2.0 * d));
            assert!((curve.force(s) / printed - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn contact_limit_overlap_and_far_gaps() {
        let b = spheres(1e-3, 3e-3, 1e-12, [0.2, 0.5], 0.05);
        let curve = Lambert2008.curve(&b, Range::Strict).unwrap();
        let contact = PI * 1.5e-3 * 0.05 * (0.2f64.cos() + 0.5f64.cos());
        assert!((curve.force(0.0) / contact - 1.0).abs() < 1e-14);
        assert_eq!(curve.force(-1.0), curve.force(0.0));
        // Far away F → contact a²/(2 S²); at the end of the reals 0, not NaN.
        let far = contact * (2.0 * 1e-12 / (PI * 1.5e-3)) / 2.0;
        assert!((curve.force(1.0) / far - 1.0).abs() < 1e-8);
        assert_eq!(curve.force(f64::MAX), 0.0);
    }

    #[test]
    fn krull_25_in_its_own_form_is_the_same() {
        // K25 (25) with the reduced radius R* = R/2, tension positive.
        let b = spheres(0.4e-3, 0.7e-3, 2e-13, [0.3; 2], 0.0728);
        let (reduced, h) = (b.reduced_radius(), 1.3e-5);
        let root = (1.0 + b.volume() / (PI * reduced * h * h)).sqrt();
        let k25 = 4.0 * PI * reduced * 0.0728 * 0.3f64.cos() / (1.0 + 1.0 / (root - 1.0));
        let ours = Israelachvili2011.force(&b, h, Range::Strict).unwrap();
        assert!((ours / k25 - 1.0).abs() < 1e-12);
    }
}
