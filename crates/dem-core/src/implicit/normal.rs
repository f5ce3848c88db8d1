//! The impulse along the line of centres that one pair wants.

use super::link::Path;
use crate::lane::Lane;

/// A pair is taken to be linear over a step in which its gap changes by less than this share of
/// its clearance: the error is below 1e-6 of the drag's impulse.
pub(super) const LINEAR: f64 = 1.5e-3;
/// A pair that is searched for is linear around a speed as long as the gap changes by less than this
/// share of its clearance from there: what is left is the square of it, again some 1e-6 of the
/// drag's impulse, since such a gap changes by more than [`LINEAR`].
pub(super) const NEAR: f64 = 5e-5;
/// Of the search between bounds, relative to the speeds before.
const TOLERANCE: f64 = 1e-13;
const MOST_ITERATIONS: u32 = 60;
/// Steps of Newton's method without bounds.
const TRIES: u32 = 4;
/// From this g on a pair is backward Euler's.
pub(super) const STIFF: f64 = 4.0;
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
    /// By how much the impulse `now` has to change to fit the speed of separation, which it is a part
    /// of.
    #[inline(always)]
    pub(super) fn change(&self, speed: L, now: L) -> L {
        -((self.offset + self.slope * speed + now) * self.answer)
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
    /// S + θ h κ, m.
    pub(super) to: f64,
    /// θ h, s.
    pub(super) step: f64,
    pub(super) duration: f64,
    pub(super) path: Path<f64>,
    /// 1/m_i + 1/m_j, 1/kg.
    pub(super) mobility: f64,
    /// Speeds nearer to each other than that are one for a tangent, m/s.
    pub(super) near: f64,
}

/// A speed that fits, and the tangent there: by how much the impulse falls with it, N s per m/s.
#[derive(Debug, Clone, Copy)]
pub(super) struct Fit {
    pub(super) speed: f64,
    pub(super) slope: f64,
}

impl Along {
    /// The speed of separation that fits, near to `guess`, where it would be `own` without the pair's
    /// impulse; `charge` gives the drag's impulse from contact to a gap, and the drag there.
    ///
    /// Newton's method from the guess, whose error is squared in every step, until a step is a near
    /// one. Where that does not do, between bounds: what is searched for grows with the speed, by
    /// 1/mobility at least.
    pub(super) fn search(&self, own: f64, guess: f64, charge: &dyn Fn(f64) -> [f64; 2]) -> Fit {
        let mut a = guess;
        for _ in 0..TRIES {
            let [f, slope] = self.lack(own, a, charge);
            let next = a - f / (slope + 1.0 / self.mobility);
            if self.are_alike(a, next) {
                return Fit { speed: next, slope };
            }
            a = next;
        }
        let other = own - self.mobility * self.lack(own, own, charge)[0];
        let (mut low, mut high) = (own.min(other), own.max(other));
        let small = TOLERANCE * (own.abs() + self.path.before.abs());
        // Not `clamp`, which panics where a number is not finite.
        let mut fit = Fit { speed: guess.max(low).min(high), slope: 0.0 };
        for _ in 0..MOST_ITERATIONS {
            let a = fit.speed;
            let [f, slope] = self.lack(own, a, charge);
            if f.is_nan() {
                return Fit { speed: f, slope };
            }
            if f > 0.0 {
                high = a
            } else {
                low = a
            }
            let newton = a - f / (slope + 1.0 / self.mobility);
            let next = if newton >= low && newton <= high { newton } else { 0.5 * (low + high) };
            fit = Fit { speed: next, slope };
            if (next - a).abs() <= small {
                break;
            }
        }
        fit
    }

    /// What is wrong with a speed a of separation, N s, where the pair's own impulse alone changes it
    /// from `own`, and by how much the impulse falls with a.
    fn lack(&self, own: f64, a: f64, charge: &dyn Fn(f64) -> [f64; 2]) -> [f64; 2] {
        let Self { to, step, duration, path, .. } = *self;
        let [impulse, drag] = charge(to + step * a);
        let capped = self.is_capped(a);
        let (pull, rise) =
            if capped { (path.pull, 0.0) } else { (self.pull_at(a), step * path.dashpot) };
        let resisted = impulse - path.paid + duration * pull;
        [(a - own) / self.mobility + resisted, step * drag + rise]
    }

    /// The dashpot's pull without a bound, N.
    fn pull_at(&self, a: f64) -> f64 {
        self.path.dashpot * (self.path.before + self.step / self.duration * a)
    }

    /// Whether the tangent where the pair was last searched for serves at a speed too. A pair whose
    /// speeds are all near to each other has no drag to tell how far its tangents reach.
    pub(super) fn has_tangent(&self, a: f64) -> bool {
        self.near < f64::INFINITY && self.are_alike(self.path.found, a)
    }

    /// Whether two speeds are so near that one tangent serves both.
    fn are_alike(&self, a: f64, b: f64) -> bool {
        (a - b).abs() <= self.near && self.is_capped(a) == self.is_capped(b)
    }

    fn is_capped(&self, a: f64) -> bool {
        self.pull_at(a) > self.path.pull
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
