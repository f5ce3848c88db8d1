use std::f64::consts::PI;

use pendular_lane::Lane;
use pendular_pair::{Bridge, OutOfRange};

use crate::adams_perchard_1985::strength;
use crate::gap::Clearance;
use crate::{NormalCurve, NormalDrag, Regularisation};

/// Reynolds lubrication in a bridge of finite volume, two spheres or a sphere and a plane.
///
/// ```text
/// c_n = K X²/s,   K = 6 π η R*²,   X = 1 − s/√(s² + b²),   b² = V/(π R*)
/// G   = K ln[ f(s)/f(s(0)) ],   f = ρ/(1 + ρ)²,   ρ = s/√(s² + b²)      for S ≥ 0, added roughness
/// s   = S + s_r or max(S, h_min)
/// ```
///
/// # Units
/// Gap m, volume m³, viscosity Pa s → coefficient N s/m, impulse N s.
///
/// # Range
/// S ≪ R*; the bridge is a disc of liquid with a straight edge.
///
/// # Limits
/// b → ∞: [`crate::AdamsPerchard1985`]. s ≫ b: falls off like s⁻⁵, so the impulse of a separation
/// to any distance is finite, K ln[(1 + ρ(0))²/(4 ρ(0))].
///
/// # Example
/// ```
/// use pendular_lubrication::{Bridge, Gap, Mate, NormalCurve, NormalDrag, Pitois2000};
/// let bridge = Bridge::new(4e-3, Mate::Sphere { radius: 4e-3 }, 5e-10, [0.17; 2], 0.021)?;
/// let law = Pitois2000 { near: Gap::Roughness { length: 4e-6 }.into() };
/// let drag = law.curve(&bridge, 0.1)?;
/// // the printed equation: the immersed 0.0753982 N s/m times (1 − 1/√(1 + 5e-10/(π · 0.002 · 1e-8)))²
/// assert!((drag.coefficient(96e-6) - 0.03343143).abs() < 1e-6);
/// # Ok::<(), pendular_lubrication::OutOfRange>(())
/// ```
///
/// # References
/// Pitois, Moucheront & Chateau (2000), J. Colloid Interface Sci. 231, 26. Elskamp &
/// Kruggel-Emden (2018), eq. (26).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pitois2000 {
    /// How gap and overlap are treated. The same clearance s enters K/s and X.
    pub near: Regularisation,
}

/// [`Pitois2000`] over the gap of one bridge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pitois2000Curve {
    strength: f64,
    /// b², m².
    width_squared: f64,
    clearance: Clearance,
}

impl NormalDrag for Pitois2000 {
    type Curve = Pitois2000Curve;

    fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<Self::Curve, OutOfRange> {
        let clearance = self.near.fold(bridge)?;
        let strength = strength(bridge, viscosity, &clearance)?;
        let width_squared = bridge.volume() / (PI * bridge.reduced_radius());
        OutOfRange::positive("bridge volume over reduced radius", width_squared)?;
        let contact_ratio = clearance.contact / clearance.contact.hypot(width_squared.sqrt());
        let allowed = (f64::MIN_POSITIVE, 1.0);
        OutOfRange::within("clearance over bridge width", contact_ratio, allowed)?;
        Ok(Pitois2000Curve { strength, width_squared, clearance })
    }
}

impl Pitois2000Curve {
    /// ρ at a clearance.
    fn ratio(&self, clearance: f64) -> f64 {
        let slant = (clearance * clearance + self.width_squared).sqrt();
        // So far away that the square is not a number any more, both are the same.
        if slant < f64::INFINITY { clearance / slant } else { 1.0 }
    }

    /// ρ at the clearance of contact.
    fn contact_ratio(&self) -> f64 {
        self.ratio(self.clearance.contact)
    }

    /// c_n at contact, N s/m.
    fn contact_coefficient(&self) -> f64 {
        self.open(self.clearance.contact)
    }

    /// K X²/s at the clearance s > 0; X written without cancellation.
    #[inline(always)]
    fn open(&self, clearance: f64) -> f64 {
        Self::open_gaps::<f64>(&[self], clearance)
    }

    #[inline(always)]
    fn open_gaps<L: Lane>(curves: &L::Each<&Self>, clearance: L) -> L {
        let permit = clearance.permit();
        let [strength, width_squared, ..] =
            L::rows(permit, curves, |curve| [curve.strength, curve.width_squared, 0.0, 0.0]);
        let slant = (clearance * clearance + width_squared).sqrt();
        let wetted = width_squared / (slant * (slant + clearance));
        strength / clearance * wetted * wetted
    }
}

impl NormalCurve for Pitois2000Curve {
    #[inline(always)]
    fn coefficient(&self, gap: f64) -> f64 {
        if gap < 0.0 {
            return self.contact_coefficient() * self.clearance.weight(gap);
        }
        self.open(self.clearance.at(gap))
    }

    #[inline(always)]
    fn coefficients<L: Lane>(curves: &L::Each<&Self>, gap: L) -> L {
        if gap.any_less(L::splat(gap.permit(), 0.0)) {
            let gaps = gap.unpack();
            return L::pack(gap.permit(), &L::each(|k| curves[k].coefficient(gaps[k])), |c| *c);
        }
        Self::open_gaps(curves, Clearance::of(&L::each(|k| &curves[k].clearance), gap))
    }

    #[inline]
    fn impulse(&self, gap: f64) -> f64 {
        let [impulse, _] = self.charge(gap);
        impulse
    }

    #[inline]
    fn charge(&self, gap: f64) -> [f64; 2] {
        let (s, contact) = (self.clearance.at(gap), self.contact_ratio());
        if gap < 0.0 {
            let drag = self.contact_coefficient();
            return self.clearance.weighted(gap).map(|weighted| drag * weighted);
        }
        let ratio = self.ratio(s);
        // X = 1 − ρ without cancellation: b²/(s² + b²) = 1 − ρ².
        let wetted = self.width_squared / (s * s + self.width_squared) / (1.0 + ratio);
        let edge = (1.0 + contact) / (1.0 + ratio);
        let mut impulse = self.strength * (ratio / contact * edge * edge).ln();
        let floor = self.clearance.floor();
        if floor > 0.0 {
            impulse += self.contact_coefficient() * gap.min(floor);
        }
        [impulse, self.strength / s * wetted * wetted]
    }

    #[inline]
    fn clearance(&self, gap: f64) -> f64 {
        self.clearance.at(gap)
    }

    #[inline(always)]
    fn clearances<L: Lane>(curves: &L::Each<&Self>, gap: L) -> L {
        Clearance::of(&L::each(|k| &curves[k].clearance), gap)
    }

    fn fade(&self) -> Option<f64> {
        Some(self.clearance.fade())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{AdamsPerchard1985, Gap, Mate};

    fn bridge(volume: f64) -> Bridge {
        Bridge::new(4e-3, Mate::Sphere { radius: 4e-3 }, volume, [0.0; 2], 0.021).unwrap()
    }

    #[test]
    fn the_printed_form() {
        let law = Pitois2000 { near: Gap::CutOff { length: 1e-7 }.into() };
        let drag = law.curve(&bridge(5e-10), 0.1).unwrap();
        for s in [1e-7, 1e-5, 1e-4, 1e-3] {
            let x: f64 = 1.0 - 1.0 / (1.0 + 5e-10 / (PI * 2e-3 * s * s)).sqrt();
            let printed = 6.0 * PI * 0.1 * 4e-6 / s * x * x;
            assert!((drag.coefficient(s) / printed - 1.0).abs() < 1e-11, "{s}");
        }
    }

    #[test]
    fn a_wide_bridge_is_an_immersed_pair() {
        let near: Regularisation = Gap::Roughness { length: 1e-6 }.into();
        let wide = Pitois2000 { near }.curve(&bridge(1e12), 0.1).unwrap();
        let immersed = AdamsPerchard1985 { near }.curve(&bridge(1e12), 0.1).unwrap();
        for gap in [-1e-6, 0.0, 1e-5, 1e-3] {
            assert!((wide.coefficient(gap) / immersed.coefficient(gap) - 1.0).abs() < 1e-9);
            assert!((wide.impulse(gap) - immersed.impulse(gap)).abs() < 1e-9 * wide.strength);
        }
    }

    #[test]
    fn far_away_it_falls_like_the_fifth_power_and_keeps_its_digits() {
        let drag = Pitois2000::default().curve(&bridge(5e-10), 0.1).unwrap();
        // X → b²/(2 s²): naive 1 − s/√(s² + b²) is 0 here
        let s: f64 = 1e5 + 4e-6;
        let b2 = 5e-10 / (PI * 2e-3);
        let far = 6.0 * PI * 0.1 * 4e-6 * b2 * b2 / (4.0 * s.powi(5));
        assert!((drag.coefficient(1e5) / far - 1.0).abs() < 1e-9);
        let all = drag.strength
            * ((1.0 + drag.contact_ratio()).powi(2) / 4.0 / drag.contact_ratio()).ln();
        assert!((drag.impulse(1e200) - all).abs() < 1e-13 * drag.strength);
    }
}
