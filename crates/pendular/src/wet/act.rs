//! What acts in bridges, one at a time or several side by side.

use pendular_capillary::ForceCurve;
use pendular_dem_core::{Geometry, Lane, Loads};
use pendular_lubrication::{NormalCurve, Resistance, TangentialCurve};

use super::Hold;

/// The forces of one bridge at one gap, before any velocity is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Pull {
    /// Capillary tension, N.
    tension: f64,
    /// Drag along the line of centres, N s/m, before the fade.
    drag: f64,
    /// Drag across it, N s/m, before the fade.
    resistance: Resistance,
    /// Drags fade in overlap by exp of this, at most 0.
    exponent: f64,
}

impl Pull {
    /// In place of the forces at contact where the curves have to be asked.
    pub(super) const UNKNOWN: Self = Self {
        tension: 0.0,
        drag: 0.0,
        resistance: Resistance { slip: 0.0, coupling: 0.0, rolling: 0.0 },
        exponent: -1.0,
    };

    /// What three curves give at a gap.
    #[inline(always)]
    fn at(
        (capillary, normal, tangential): &(impl ForceCurve, impl NormalCurve, impl TangentialCurve),
        gap: f64,
    ) -> Self {
        Self {
            tension: capillary.force(gap),
            drag: normal.coefficient(gap),
            resistance: tangential.resistance(gap),
            exponent: 0.0,
        }
    }

    /// The forces at contact, with the inverse fading length in place of the exponent: all that
    /// overlap needs. [`Self::UNKNOWN`] if the curves do not fade alike.
    pub(super) fn contact(
        curves: &(impl ForceCurve, impl NormalCurve, impl TangentialCurve),
    ) -> Self {
        let (normal, tangential) = (curves.1.fade(), curves.2.fade());
        match normal.filter(|_| normal == tangential) {
            Some(exponent) => Self { exponent, ..Self::at(curves, 0.0) },
            None => Self::UNKNOWN,
        }
    }
}

impl<C: ForceCurve, N: NormalCurve, S: TangentialCurve> Hold<C, N, S> {
    /// The forces at a gap below the static rupture distance; `None` above it or without a bridge.
    #[inline(always)]
    pub(super) fn near(&self, gap: f64) -> Option<Pull> {
        let exponent = gap * self.contact.exponent;
        if exponent <= 0.0 && gap < 0.0 {
            return Some(Pull { exponent, ..self.contact });
        }
        // A pair without bridge has no rupture distance.
        if gap <= self.rupture { self.far(gap) } else { None }
    }

    /// The forces by the curves; `None` without a bridge.
    #[inline(always)]
    pub(super) fn far(&self, gap: f64) -> Option<Pull> {
        self.curves.as_ref().map(|curves| Pull::at(curves, gap))
    }
}

/// What bridges do, given their forces.
#[inline(always)]
pub(super) fn act<L: Lane>(pulls: &L::Each<Pull>, pairs: &Geometry<L>) -> Loads<L> {
    let weight = fade::<L>(pulls);
    let slip = L::pack(pulls, |p| p.resistance.slip) * weight;
    let drag = L::pack(pulls, |p| p.drag) * weight;
    let mut loads = Loads {
        tension: L::pack(pulls, |p| p.tension) + drag * pairs.separation_speed,
        shear: -(pairs.slip * slip),
        ..Loads::none()
    };
    let coupled = |p: &Pull| p.resistance.coupling != 0.0 || p.resistance.rolling != 0.0;
    if (0..L::WIDTH).any(|k| coupled(&pulls[k])) {
        let coupling = L::pack(pulls, |p| p.resistance.coupling) * weight;
        let rolling = L::pack(pulls, |p| p.resistance.rolling) * weight;
        let reduced = reduced_radius(pairs.radii);
        let turning = pairs.spin.cross(pairs.half_step_normal) * reduced;
        loads.shear = loads.shear - turning * coupling;
        let force = -(pairs.slip * coupling + turning * rolling);
        loads.couple = pairs.normal.cross(force) * reduced;
    }
    loads
}

/// Below this exponent the series is not used.
const SERIES: f64 = -1.4;

/// exp of the exponents, 1 to the bit at 0.
#[inline(always)]
fn fade<L: Lane>(pulls: &L::Each<Pull>) -> L {
    let exponent = L::pack(pulls, |p| p.exponent);
    let mut weight = series(exponent);
    if exponent.any_less(L::splat(SERIES)) {
        let exact = exponent.unpack();
        let exact = L::each(|k| if exact[k] < SERIES { exact[k].exp() } else { 0.0 });
        weight = exponent.if_less(L::splat(SERIES), L::pack(&exact, |e| *e), weight);
    }
    weight
}

/// exp x = (exp x/4)⁴ for −1.4 <= x <= 0, by its Taylor series: the first term left out is below
/// 1e-17.
#[inline(always)]
fn series<L: Lane>(x: L) -> L {
    const TERMS: [f64; 13] = [
        1.0 / 6_227_020_800.0,
        1.0 / 479_001_600.0,
        1.0 / 39_916_800.0,
        1.0 / 3_628_800.0,
        1.0 / 362_880.0,
        1.0 / 40_320.0,
        1.0 / 5_040.0,
        1.0 / 720.0,
        1.0 / 120.0,
        1.0 / 24.0,
        1.0 / 6.0,
        0.5,
        1.0,
    ];
    let x = x * L::splat(0.25);
    let mut sum = L::splat(TERMS[0]);
    for &term in &TERMS[1..] {
        sum = sum * x + L::splat(term);
    }
    let root = sum * x + L::splat(1.0);
    let square = root * root;
    square * square
}

/// r_i r_j/(r_i + r_j), against a wall r_i.
#[inline(always)]
fn reduced_radius<L: Lane>([first, second]: [L; 2]) -> L {
    let both = first * second / (first + second);
    second.if_less(L::splat(f64::INFINITY), both, first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pendular_dem_core::Four;

    #[test]
    fn the_fade_is_the_exponential() {
        let pull = |exponent: f64| Pull { exponent, ..Pull::default() };
        for k in 0..4000 {
            let exponent = -1e-3 * f64::from(k);
            let four = [pull(exponent), pull(0.0), pull(f64::NEG_INFINITY), pull(-1.5)];
            let weights = fade::<Four>(&four).unpack();
            assert!((weights[0] / exponent.exp() - 1.0).abs() < 1e-15, "{exponent}");
            assert_eq!(weights[0], fade::<f64>(&[pull(exponent)]));
            assert_eq!((weights[1], weights[2]), (1.0, 0.0));
        }
    }
}
