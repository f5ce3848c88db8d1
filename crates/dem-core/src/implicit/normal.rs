//! The impulse along the line of centres that one pair wants.

use crate::lane::Lane;

/// A pair is taken to be linear over a step in which its gap changes by less than this share of
/// its clearance: the error is below 1e-6 of the drag's impulse.
pub(super) const LINEAR: f64 = 1.5e-3;
/// The search for a speed ends with a step that changes the gap by less than this share of its
/// clearance: what is left is the square of it.
pub(super) const STEP: f64 = 1e-5;
/// Of the search between bounds, relative to the speeds before.
const TOLERANCE: f64 = 1e-13;
const MOST_ITERATIONS: u32 = 60;
/// Steps of Newton's method without bounds.
const TRIES: u32 = 4;
/// From this g on a pair is backward Euler's.
const STIFF: f64 = 4.0;
/// Below this g its series is used.
const SMALL: f64 = 0.3;

/// The weight θ of the velocity after the step, from g = h c/m. While g ≤ 1 it is fitted: the decay
/// of a free pair is exp(−g) and its terminal speed is force over drag, both exactly.
///
/// ```text
/// θ = 1/(1 − exp(−g)) − 1/g          1/2 for g → 0
/// ```
///
/// Above that it goes to 1, which it is from g = 4 on (backward Euler): every pass then lowers the
/// energy, however stiff the pairs and however far the passes are from their end.
#[inline(always)]
pub(super) fn weight<L: Lane>(g: L) -> L {
    let number = |value: f64| L::splat(g.permit(), value);
    let (one, stiff, small) = (number(1.0), number(STIFF), number(SMALL));
    let g2 = g * g;
    let series = number(1.0 / 12.0) - g2 * (number(1.0 / 720.0) - g2 * number(1.0 / 30_240.0));
    let weight = g.if_less(small, number(0.5) + g * series, one);
    if g.less_bits(stiff) == g.less_bits(small) {
        return weight;
    }
    let fitted = one / (one - exponential(-g)) - one / g;
    let fade = ((stiff - g) / number(STIFF - 1.0)).least(one);
    let between = g.if_less(stiff, one - (one - fitted) * fade, one);
    g.if_less(small, weight, between)
}

/// exp x = (exp x/16)^16 for −4 <= x <= 0, by its Taylor series.
#[inline(always)]
fn exponential<L: Lane>(x: L) -> L {
    let x = x * L::splat(x.permit(), 1.0 / 16.0);
    let mut sum = L::splat(x.permit(), 1.0);
    for k in (1..=11).rev() {
        sum = sum * x * L::splat(x.permit(), 1.0 / f64::from(k)) + L::splat(x.permit(), 1.0);
    }
    for _ in 0..4 {
        sum = sum * sum;
    }
    sum
}

/// The impulse p = −(offset + slope a) of a pair along its line of centres, a the speed at which it
/// separates; p > 0 drives the bodies apart.
#[derive(Debug, Clone, Copy)]
pub(super) struct Normal<L> {
    pub(super) offset: L,
    pub(super) slope: L,
    /// 1/(1 + slope (1/m_i + 1/m_j)).
    pub(super) answer: L,
}

impl<L: Lane> Normal<L> {
    /// The impulse that fits the speed of separation, which `now` is a part of.
    #[inline(always)]
    pub(super) fn fit(&self, speed: L, now: L) -> L {
        now - (self.offset + self.slope * speed + now) * self.answer
    }

    /// The terms of the sums that scale a start: p (a + offset/slope) and p²/slope.
    #[inline(always)]
    pub(super) fn start(&self, now: L, speed: L) -> [L; 2] {
        let soft = softness(self.slope);
        [now * (speed + soft * self.offset), soft * now * now]
    }
}

/// 1/slope, 0 where nothing resists.
#[inline(always)]
pub(super) fn softness<L: Lane>(slope: L) -> L {
    let (zero, one) = (L::splat(slope.permit(), 0.0), L::splat(slope.permit(), 1.0));
    zero.if_less(slope, one / slope, zero)
}

/// What decides that impulse, whatever the gap does in the step:
///
/// ```text
/// p = −[G(S + θ h u) − G(charged)] − h min(γ ((1 − θ) u₀ + θ u), pull)      u = a + κ
/// ```
///
/// u is the rate of the gap after the step, u₀ before it; κ is what the turning line of centres adds
/// to the speed of separation along the normal at the step's start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Along {
    pub(super) gap: f64,
    /// G(charged).
    pub(super) paid: f64,
    pub(super) rate: f64,
    pub(super) turn: f64,
    pub(super) weight: f64,
    pub(super) duration: f64,
    pub(super) dashpot: f64,
    pub(super) pull: f64,
    /// 1/m_i + 1/m_j, 1/kg.
    pub(super) mobility: f64,
}

impl Along {
    /// The impulse that fits the speed of separation `speed`, which `now` is a part of; `charge`
    /// gives the drag's impulse from contact to a gap, and the drag there.
    ///
    /// Newton's method from that speed, whose error is squared in every step, until a step is at
    /// most `small`. Where that does not do, between bounds: what is searched for grows with the
    /// speed, by 1/mobility at least.
    pub(super) fn search(
        &self,
        speed: f64,
        now: f64,
        small: f64,
        charge: &dyn Fn(f64) -> [f64; 2],
    ) -> f64 {
        let own = speed - now * self.mobility;
        let mut a = speed;
        for _ in 0..TRIES {
            let [f, rise] = self.lack(own, a, charge);
            let next = a - f / rise;
            if (next - a).abs() <= small && self.is_capped(a) == self.is_capped(next) {
                return (next - own) / self.mobility;
            }
            a = next;
        }
        let other = own - self.mobility * self.lack(own, own, charge)[0];
        let (mut low, mut high) = (own.min(other), own.max(other));
        let small = TOLERANCE * (own.abs() + self.rate.abs());
        // Not `clamp`, which panics where a number is not finite.
        a = speed.max(low).min(high);
        for _ in 0..MOST_ITERATIONS {
            let [f, rise] = self.lack(own, a, charge);
            if f.is_nan() {
                return f;
            }
            if f > 0.0 {
                high = a
            } else {
                low = a
            }
            let newton = a - f / rise;
            let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            let done = (next - a).abs() <= small;
            a = next;
            if done {
                break;
            }
        }
        (a - own) / self.mobility
    }

    /// What is wrong with a speed a of separation, N s, where the pair's own impulse alone changes it
    /// from `own`, and how that grows with a.
    fn lack(&self, own: f64, a: f64, charge: &dyn Fn(f64) -> [f64; 2]) -> [f64; 2] {
        let step = self.weight * self.duration;
        let [to, drag] = charge(self.gap + step * (a + self.turn));
        let capped = self.is_capped(a);
        let (pull, rise) =
            if capped { (self.pull, 0.0) } else { (self.pull_at(a), step * self.dashpot) };
        let resisted = to - self.paid + self.duration * pull;
        [(a - own) / self.mobility + resisted, 1.0 / self.mobility + step * drag + rise]
    }

    /// The dashpot's pull without a bound, N.
    fn pull_at(&self, a: f64) -> f64 {
        let before = (1.0 - self.weight) * self.rate;
        self.dashpot * (before + self.weight * (a + self.turn))
    }

    fn is_capped(&self, a: f64) -> bool {
        self.pull_at(a) > self.pull
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_weight_is_continuous_and_has_its_limits() {
        assert_eq!(weight(0.0), 0.5);
        assert!((weight(0.3 - 1e-12) - weight(0.3)).abs() < 1e-9);
        assert!((weight(1.0 + 1e-12) - weight(1.0)).abs() < 1e-11);
        assert!((weight(4.0 - 1e-12) - 1.0).abs() < 1e-11);
        assert_eq!(weight(1e9), 1.0);
        // g = 1: 1/(1 − 1/e) − 1 by hand
        assert!((weight(1.0) - 0.581_976_706_869_326_4).abs() < 1e-15);
    }
}
