//! What acts in bridges, one at a time or several side by side.

use std::borrow::Borrow;

use pendular_capillary::ForceCurve;
use pendular_dem_core::{Geometry, Lane, Loads, Resist};
use pendular_lubrication::{NormalCurve, Resistance, TangentialCurve};

use super::shelf::Open;

/// The forces of one bridge at one gap, before any velocity is looked at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pull {
    /// Capillary tension, N.
    tension: f64,
    /// Drag along the line of centres, N s/m, before the fade.
    drag: f64,
    /// Drag across it, N s/m, before the fade.
    resistance: Resistance,
    /// In overlap drags fade by exp of this times the gap, 1/m.
    fade: f64,
}

impl Pull {
    /// What three curves give at a gap.
    #[inline(always)]
    pub(super) fn at(
        (capillary, normal, tangential): &(impl ForceCurve, impl NormalCurve, impl TangentialCurve),
        gap: f64,
    ) -> Self {
        Self {
            tension: capillary.force(gap),
            drag: normal.coefficient(gap),
            resistance: tangential.resistance(gap),
            fade: 0.0,
        }
    }

    /// The forces at contact: all that overlap needs. `None` if the curves do not fade alike.
    pub(super) fn contact(
        curves: &(impl ForceCurve, impl NormalCurve, impl TangentialCurve),
    ) -> Option<Self> {
        let (normal, tangential) = (curves.1.fade(), curves.2.fade());
        let at = Self::at(curves, 0.0);
        // What is nothing at contact and fades is nothing in overlap: the other one decides.
        let fade = if at.drag == 0.0 && normal.is_some() {
            tangential
        } else if at.resistance == Resistance::default() && tangential.is_some() {
            normal
        } else {
            normal.filter(|_| normal == tangential)
        };
        fade.map(|fade| Self { fade, ..at })
    }

    /// What each bridge has for itself of it: tension and drag along the line of centres.
    pub(super) fn own(&self) -> [f64; 2] {
        [self.tension, self.drag]
    }

    /// How drags fade in overlap, 1/m.
    pub(super) fn fade(&self) -> f64 {
        self.fade
    }
}

/// The same of bridges side by side.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Pulls<L> {
    tension: L,
    drag: L,
    slip: L,
    coupling: L,
    rolling: L,
}

impl<L: Lane> Pulls<L> {
    #[inline(always)]
    pub(super) fn pack<P: Borrow<Pull>>(permit: L::Permit, pulls: &L::Each<P>) -> Self {
        Self {
            tension: L::pack(permit, pulls, |p| p.borrow().tension),
            drag: L::pack(permit, pulls, |p| p.borrow().drag),
            slip: L::pack(permit, pulls, |p| p.borrow().resistance.slip),
            coupling: L::pack(permit, pulls, |p| p.borrow().resistance.coupling),
            rolling: L::pack(permit, pulls, |p| p.borrow().resistance.rolling),
        }
    }

    /// What the curves give at a gap.
    #[inline(always)]
    pub(super) fn apart<C: ForceCurve, N: NormalCurve, S: TangentialCurve>(
        open: &L::Each<Open<'_, C, N, S>>,
        gap: L,
    ) -> Self {
        let [slip, coupling, rolling] = S::resistances(&L::each(|k| &open[k].1.tangential), gap);
        Self {
            tension: C::forces(&L::each(|k| &open[k].0.capillary), gap),
            drag: N::coefficients(&L::each(|k| &open[k].0.normal), gap),
            slip,
            coupling,
            rolling,
        }
    }

    /// Puts single bridges side by side.
    #[inline(always)]
    pub(super) fn side_by_side(permit: L::Permit, one: &L::Each<Pulls<f64>>) -> Self {
        Self {
            tension: L::pack(permit, one, |p| p.tension),
            drag: L::pack(permit, one, |p| p.drag),
            slip: L::pack(permit, one, |p| p.slip),
            coupling: L::pack(permit, one, |p| p.coupling),
            rolling: L::pack(permit, one, |p| p.rolling),
        }
    }

    /// Tension, and drags that have faded in overlap by exp of `exponent`.
    #[inline(always)]
    pub(super) fn faded(
        [tension, drag, slip]: [L; 3],
        [coupling, rolling]: [L; 2],
        exponent: L,
    ) -> Self {
        let weight = fade(exponent);
        Self {
            tension,
            drag: drag * weight,
            slip: slip * weight,
            coupling: coupling * weight,
            rolling: rolling * weight,
        }
    }

    /// Their drags alone, with the clearances over which those along the line of centres change.
    #[inline(always)]
    pub(super) fn resist(&self, clearance: L) -> Resist<L> {
        let Self { drag, slip, coupling, rolling, .. } = *self;
        let none = Resist::none(drag.permit());
        Resist { drag, clearance, across: [slip, coupling, rolling], ..none }
    }

    /// What bridges do, given their forces; their pull alone unless they `drag` too.
    #[inline(always)]
    pub(super) fn act(&self, pairs: &Geometry<L>, drag: bool) -> Loads<L> {
        if !drag {
            return Loads { tension: self.tension, ..Loads::none(pairs.gap.permit()) };
        }
        let mut loads = Loads {
            tension: self.tension + self.drag * pairs.separation_speed,
            shear: -(pairs.slip * self.slip),
            ..Loads::none(pairs.gap.permit())
        };
        let (coupling, rolling) = (self.coupling, self.rolling);
        if L::splat(pairs.gap.permit(), 0.0)
            .any_less(coupling.most(-coupling) + rolling.most(-rolling))
        {
            let reduced = reduced_radius(pairs.radii);
            let turning = pairs.spin.cross(pairs.half_step_normal) * reduced;
            loads.shear = loads.shear - turning * coupling;
            let force = -(pairs.slip * coupling + turning * rolling);
            loads.couple = pairs.normal.cross(force) * reduced;
        }
        loads
    }
}

/// Below this exponent the series is not used.
const SERIES: f64 = -1.4;

/// exp of the exponents, 1 to the bit at 0.
#[inline(always)]
fn fade<L: Lane>(exponent: L) -> L {
    let permit = exponent.permit();
    let mut weight = series(exponent);
    if exponent.any_less(L::splat(permit, SERIES)) {
        let exact = exponent.unpack();
        let exact = L::each(|k| if exact[k] < SERIES { exact[k].exp() } else { 0.0 });
        weight =
            exponent.if_less(L::splat(permit, SERIES), L::pack(permit, &exact, |e| *e), weight);
    }
    weight
}

/// exp x = (exp x/4)⁴ for −1.4 <= x <= 0, by its Taylor series: the first term left out is below
/// 1e-17.
#[inline(always)]
fn series<L: Lane>(x: L) -> L {
    /// Of x^12, x^13 down to those of x^2, x^3: the two sums do not wait for each other.
    const TERMS: [[f64; 2]; 6] = [
        [1.0 / 479_001_600.0, 1.0 / 6_227_020_800.0],
        [1.0 / 3_628_800.0, 1.0 / 39_916_800.0],
        [1.0 / 40_320.0, 1.0 / 362_880.0],
        [1.0 / 720.0, 1.0 / 5_040.0],
        [1.0 / 24.0, 1.0 / 120.0],
        [0.5, 1.0 / 6.0],
    ];
    let permit = x.permit();
    let x = x * L::splat(permit, 0.25);
    let square = x * x;
    let [mut even, mut odd] = TERMS[0].map(|term| L::splat(permit, term));
    for [of_even, of_odd] in &TERMS[1..] {
        even = even * square + L::splat(permit, *of_even);
        odd = odd * square + L::splat(permit, *of_odd);
    }
    let one = L::splat(permit, 1.0);
    let root = (x * (odd * square + one) + even * square) + one;
    let square = root * root;
    square * square
}

/// r_i r_j/(r_i + r_j), against a wall r_i.
#[inline(always)]
fn reduced_radius<L: Lane>([first, second]: [L; 2]) -> L {
    let both = first * second / (first + second);
    second.if_less(L::splat(second.permit(), f64::INFINITY), both, first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pendular_dem_core::Four;

    #[test]
    fn the_fade_is_the_exponential() {
        for k in 0..4000 {
            let exponent = -1e-3 * f64::from(k);
            let four = [exponent, 0.0, f64::NEG_INFINITY, -1.5];
            let weights = fade(Four::pack((), &four, |e| *e)).unpack();
            assert!((weights[0] / exponent.exp() - 1.0).abs() < 1e-15, "{exponent}");
            assert_eq!(weights[0], fade(exponent));
            assert_eq!((weights[1], weights[2]), (1.0, 0.0));
        }
    }
}
