use std::f64::consts::PI;

use pendular_pair::{Bridge, OutOfRange};

use crate::gap::Clearance;
use crate::{NormalCurve, NormalDrag, Regularisation};

/// Reynolds lubrication between two spheres immersed in liquid, or a sphere and a plane.
///
/// ```text
/// c_n = K/s,   K = 6 π η R*²,   s = S + s_r or max(S, h_min)
/// G   = K ln(s/s(0))                                           for added roughness, S ≥ 0
/// ```
///
/// # Units
/// Gap m, viscosity Pa s → coefficient N s/m, impulse N s.
///
/// # Range
/// S ≪ R*, liquid wider than √(2 R* S). A finite bridge drags less: see [`crate::Pitois2000`].
///
/// # Example
/// ```
/// use pendular_lubrication::{AdamsPerchard1985, Bridge, Gap, Mate, NormalCurve, NormalDrag};
/// let bridge = Bridge::new(4e-3, Mate::Sphere { radius: 4e-3 }, 5e-10, [0.17; 2], 0.021)?;
/// let law = AdamsPerchard1985 { near: Gap::Roughness { length: 4e-6 }.into() };
/// let drag = law.curve(&bridge, 0.1)?;
/// // by hand: 6 π · 0.1 · 0.002² / 1e-4
/// assert!((drag.coefficient(96e-6) - 0.0753982236862).abs() < 1e-12);
/// # Ok::<(), pendular_lubrication::OutOfRange>(())
/// ```
///
/// # References
/// Adams & Perchard (1985), Inst. Chem. Eng. Symp. Ser. 91, 147. Elskamp & Kruggel-Emden (2018),
/// eq. (25); Krull, Strohner & Antonyuk (2025), eqs. (22), (24).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AdamsPerchard1985 {
    /// How gap and overlap are treated.
    pub near: Regularisation,
}

/// [`AdamsPerchard1985`] over the gap of one bridge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AdamsPerchard1985Curve {
    strength: f64,
    clearance: Clearance,
}

/// K = 6 π η R*², N m s, checked together with K/s(0).
pub(crate) fn strength(
    bridge: &Bridge,
    viscosity: f64,
    clearance: &Clearance,
) -> Result<f64, OutOfRange> {
    OutOfRange::positive("viscosity", viscosity)?;
    let strength = 6.0 * PI * viscosity * bridge.reduced_radius() * bridge.reduced_radius();
    let greatest = strength / clearance.contact;
    OutOfRange::within("drag coefficient at contact", greatest, (0.0, f64::MAX))?;
    Ok(strength)
}

impl NormalDrag for AdamsPerchard1985 {
    type Curve = AdamsPerchard1985Curve;

    fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<Self::Curve, OutOfRange> {
        let clearance = self.near.fold(bridge)?;
        Ok(AdamsPerchard1985Curve { strength: strength(bridge, viscosity, &clearance)?, clearance })
    }
}

impl NormalCurve for AdamsPerchard1985Curve {
    #[inline]
    fn coefficient(&self, gap: f64) -> f64 {
        self.strength / self.clearance.at(gap) * self.clearance.weight(gap)
    }

    #[inline]
    fn impulse(&self, gap: f64) -> f64 {
        let (contact, floor) = (self.clearance.contact, self.clearance.floor());
        if gap < 0.0 {
            return self.strength / contact * self.clearance.weight_integral(gap);
        }
        // ln(s/s(0)) where s changes, a constant coefficient below a cut-off
        let logarithm = ((gap - floor).max(0.0) / contact).min(f64::MAX).ln_1p();
        self.strength * (gap.min(floor) / contact + logarithm)
    }

    #[inline]
    fn clearance(&self, gap: f64) -> f64 {
        self.clearance.at(gap)
    }

    fn fade(&self) -> Option<f64> {
        Some(self.clearance.fade())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Gap, Mate, Overlap};

    fn curve(gap: Gap, overlap: Overlap, mate: Mate) -> AdamsPerchard1985Curve {
        let bridge = Bridge::new(3e-3, mate, 1e-10, [0.0; 2], 0.07).unwrap();
        AdamsPerchard1985 { near: Regularisation { gap, overlap } }.curve(&bridge, 0.2).unwrap()
    }

    #[test]
    fn a_plane_drags_four_times_an_equal_sphere() {
        let gap = Gap::Roughness { length: 1e-6 };
        let plane = curve(gap, Overlap::Fade, Mate::PLANE);
        let equal = curve(gap, Overlap::Fade, Mate::Sphere { radius: 3e-3 });
        assert!((plane.coefficient(1e-5) / equal.coefficient(1e-5) - 4.0).abs() < 1e-13);
        // 6 π · 0.2 · 9e-6 / 11e-6 by hand
        assert!((plane.coefficient(1e-5) - 3.084472787).abs() < 1e-8);
    }

    #[test]
    fn a_whole_contact_costs_k_each_way_when_it_fades() {
        let c = curve(Gap::Roughness { length: 1e-6 }, Overlap::Fade, Mate::PLANE);
        let k = 6.0 * PI * 0.2 * 9e-6;
        assert!((c.impulse(0.0) - c.impulse(-1e-4) - k).abs() < 1e-14 * k);
    }

    #[test]
    fn impulse_by_hand() {
        let k = 6.0 * PI * 0.2 * 9e-6;
        let e = std::f64::consts::E;
        let rough = curve(Gap::Roughness { length: 1e-6 }, Overlap::Full, Mate::PLANE);
        assert!((rough.impulse(1e-6 * (e - 1.0)) / k - 1.0).abs() < 1e-14);
        assert!((rough.impulse(-3e-6) / k + 3.0).abs() < 1e-14);
        let cut = curve(Gap::CutOff { length: 1e-6 }, Overlap::Off, Mate::PLANE);
        assert!((cut.impulse(0.25e-6) / k - 0.25).abs() < 1e-14);
        assert!((cut.impulse(1e-6 * e) / k - 2.0).abs() < 1e-14);
        assert_eq!(cut.impulse(-3e-6), 0.0);
    }

    #[test]
    fn bad_viscosity_is_named() {
        let bridge = Bridge::new(3e-3, Mate::PLANE, 1e-10, [0.0; 2], 0.07).unwrap();
        for viscosity in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = AdamsPerchard1985::default().curve(&bridge, viscosity).unwrap_err();
            assert_eq!(error.quantity, "viscosity");
        }
        let error = AdamsPerchard1985::default().curve(&bridge, 1e308).unwrap_err();
        assert_eq!(error.quantity, "drag coefficient at contact");
    }
}
