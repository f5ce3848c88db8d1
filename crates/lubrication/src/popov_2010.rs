use std::f64::consts::PI;

use pendular_lane::Lane;
use pendular_pair::{Bridge, OutOfRange};

use crate::gap::Clearance;
use crate::{Regularisation, Resistance, TangentialCurve, TangentialDrag};

/// Viscous resistance to slip between two spheres, or a sphere and a plane, in a liquid film.
///
/// ```text
/// A = 2 π η R* ln(1 + R*/(2 s)),   B = D = 0,   s = S + s_r or max(S, h_min)
/// ```
///
/// It acts on the slip u alone. Its leading term 2 π η R* ln(R*/S) is the exact one for equal
/// spheres; against a plane the exact one is 1.6 times as large.
///
/// # Units
/// Gap m, viscosity Pa s → N s/m.
///
/// # Range
/// S ≪ R*. Positive for every gap.
///
/// # Example
/// ```
/// use pendular_lubrication::{Bridge, Gap, Mate, Popov2010, TangentialCurve, TangentialDrag};
/// let bridge = Bridge::new(2e-3, Mate::Sphere { radius: 2e-3 }, 1e-11, [0.0; 2], 0.07)?;
/// let law = Popov2010 { near: Gap::CutOff { length: 1e-6 }.into() };
/// // by hand: 2 π · 1 · 1e-3 · ln(501)
/// assert!((law.curve(&bridge, 1.0)?.resistance(0.0).slip - 0.0390601).abs() < 1e-7);
/// # Ok::<(), pendular_lubrication::OutOfRange>(())
/// ```
///
/// # References
/// Popov (2010), Contact Mechanics and Friction, Springer. Krull, Strohner & Antonyuk (2025),
/// eq. (23).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Popov2010 {
    /// How gap and overlap are treated.
    pub near: Regularisation,
}

/// [`Popov2010`] over the gap of one bridge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Popov2010Curve {
    scale: f64,
    half_radius: f64,
    clearance: Clearance,
}

/// η R*, N s/m, checked together with R*/s(0).
pub(crate) fn scale(
    bridge: &Bridge,
    viscosity: f64,
    clearance: &Clearance,
) -> Result<f64, OutOfRange> {
    OutOfRange::positive("viscosity", viscosity)?;
    let closeness = bridge.reduced_radius() / clearance.contact;
    OutOfRange::within("reduced radius over clearance", closeness, (0.0, f64::MAX))?;
    let scale = viscosity * bridge.reduced_radius();
    // 2e4 > 6 π times any logarithm of finite numbers
    OutOfRange::within("viscosity times reduced radius", scale, (0.0, f64::MAX / 2e4))?;
    Ok(scale)
}

impl TangentialDrag for Popov2010 {
    type Curve = Popov2010Curve;

    fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<Self::Curve, OutOfRange> {
        let clearance = self.near.fold(bridge)?;
        let scale = 2.0 * PI * scale(bridge, viscosity, &clearance)?;
        let half_radius = 0.5 * bridge.reduced_radius();
        Ok(Popov2010Curve { scale, half_radius, clearance })
    }
}

impl Popov2010Curve {
    /// The slip resistance at a clearance, m, without the fade in overlap.
    #[inline(always)]
    fn open(&self, clearance: f64) -> f64 {
        Self::open_gaps::<f64>(&[self], clearance)
    }

    #[inline(always)]
    fn open_gaps<L: Lane>(curves: &L::Each<&Self>, clearance: L) -> L {
        let permit = clearance.permit();
        let [scale, half_radius, ..] =
            L::rows(permit, curves, |curve| [curve.scale, curve.half_radius, 0.0, 0.0]);
        scale * (L::splat(permit, 1.0) + half_radius / clearance).logarithm()
    }
}

impl TangentialCurve for Popov2010Curve {
    #[inline(always)]
    fn resistance(&self, gap: f64) -> Resistance {
        let slip = if gap < 0.0 {
            self.open(self.clearance.contact) * self.clearance.weight(gap)
        } else {
            self.open(self.clearance.at(gap))
        };
        Resistance { slip, coupling: 0.0, rolling: 0.0 }
    }

    #[inline(always)]
    fn resistances<L: Lane>(curves: &L::Each<&Self>, gap: L) -> [L; 3] {
        let permit = gap.permit();
        let none = L::splat(permit, 0.0);
        if gap.any_less(none) {
            let gaps = gap.unpack();
            let each = L::each(|k| curves[k].resistance(gaps[k]).slip);
            return [L::pack(permit, &each, |slip| *slip), none, none];
        }
        let clearance = Clearance::of(&L::each(|k| &curves[k].clearance), gap);
        [Self::open_gaps(curves, clearance), none, none]
    }

    fn fade(&self) -> Option<f64> {
        Some(self.clearance.fade())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Gap, Mate};

    #[test]
    fn leading_term_of_equal_spheres_and_positive_far_away() {
        let bridge = Bridge::new(2.0, Mate::Sphere { radius: 2.0 }, 1.0, [0.0; 2], 1.0).unwrap();
        let law = Popov2010 { near: Gap::CutOff { length: 1e-300 }.into() };
        let drag = law.curve(&bridge, 1.0).unwrap();
        // per decade of the gap: 2 π R* ln 10
        let decade = drag.resistance(1e-9).slip - drag.resistance(1e-8).slip;
        assert!((decade / (2.0 * PI * 10.0_f64.ln()) - 1.0).abs() < 1e-7);
        assert!(drag.resistance(1e6).slip > 0.0);
    }
}
