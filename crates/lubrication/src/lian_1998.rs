use std::f64::consts::PI;

use pendular_pair::{Bridge, OutOfRange};

use crate::gap::Clearance;
use crate::popov_2010::scale;
use crate::{Regularisation, Resistance, TangentialCurve, TangentialDrag};

/// A plane's translation coefficient applied to the slip of a pair, as Lian and Nase use it.
///
/// ```text
/// A = 6 π η R* max(0, 8/15 ln(R*/s) + 0.9588),   B = D = 0,   s = S + s_r or max(S, h_min)
/// ```
///
/// It acts on the single slip of the two surfaces. Its leading term is a plane's: between equal
/// spheres the exact one is 1.6 times smaller ([`crate::JeffreyOnishi1984`]).
///
/// # Units
/// Gap m, viscosity Pa s → N s/m.
///
/// # Range
/// S ≪ R*. As printed the coefficient turns negative, a push, at s = R* exp(0.9588 · 15/8) ≈
/// 6.04 R*: it is 0 from there on.
///
/// # Example
/// ```
/// use pendular_lubrication::{Bridge, Gap, Lian1998, Mate, TangentialCurve, TangentialDrag};
/// let bridge = Bridge::new(2e-3, Mate::Sphere { radius: 2e-3 }, 1e-11, [0.0; 2], 0.07)?;
/// let law = Lian1998 { near: Gap::CutOff { length: 1e-6 }.into() };
/// let drag = law.curve(&bridge, 1.0)?;
/// // at s = R* the logarithm is 0: 6 π · 1 · 1e-3 · 0.9588
/// assert!((drag.resistance(1e-3).slip - 0.018072953).abs() < 1e-8);
/// assert_eq!(drag.resistance(7e-3).slip, 0.0);
/// # Ok::<(), pendular_lubrication::OutOfRange>(())
/// ```
///
/// # References
/// Lian, Adams & Thornton (1998), AIChE J. 44, 1453; Nase, Vargas, Abatan & McCarthy (2001),
/// Powder Technol. 116, 214. Elskamp & Kruggel-Emden (2018), eq. (27).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Lian1998 {
    /// How gap and overlap are treated.
    pub near: Regularisation,
}

/// [`Lian1998`] over the gap of one bridge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lian1998Curve {
    scale: f64,
    reduced_radius: f64,
    clearance: Clearance,
}

impl TangentialDrag for Lian1998 {
    type Curve = Lian1998Curve;

    fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<Self::Curve, OutOfRange> {
        let clearance = self.near.fold(bridge)?;
        let scale = 6.0 * PI * scale(bridge, viscosity, &clearance)?;
        Ok(Lian1998Curve { scale, reduced_radius: bridge.reduced_radius(), clearance })
    }
}

impl TangentialCurve for Lian1998Curve {
    #[inline]
    fn resistance(&self, gap: f64) -> Resistance {
        let logarithm = (self.reduced_radius / self.clearance.at(gap)).ln();
        let strength = (8.0 / 15.0 * logarithm + 0.9588).max(0.0);
        let slip = self.scale * strength * self.clearance.weight(gap);
        Resistance { slip, coupling: 0.0, rolling: 0.0 }
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
    fn never_pushes() {
        let bridge = Bridge::new(1.0, Mate::PLANE, 1.0, [0.0; 2], 1.0).unwrap();
        let law = Lian1998 { near: Gap::CutOff { length: 1e-6 }.into() };
        let drag = law.curve(&bridge, 1.0).unwrap();
        assert!(drag.resistance(6.03).slip > 0.0);
        assert!(drag.resistance(6.03).slip < 2e-2);
        for gap in [6.04, 10.0, 1e300] {
            assert_eq!(drag.resistance(gap).slip, 0.0);
        }
    }
}
