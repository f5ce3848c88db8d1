//! The impulse along the line of centres that one pair wants.

use super::Resist;

/// A pair is taken to be linear over a step in which its gap changes by less than this share of
/// its clearance: the error is below 1e-6 of the drag's impulse.
const LINEAR: f64 = 2e-3;
/// Of the search for a speed, relative to the speeds before.
const TOLERANCE: f64 = 1e-13;
const MOST_ITERATIONS: u32 = 60;
/// From this g on a pair is backward Euler's.
const STIFF: f64 = 4.0;

/// The weight θ of the velocity after the step, from g = h c/m. While g ≤ 1 it is fitted: the decay
/// of a free pair is exp(−g) and its terminal speed is force over drag, both exactly.
///
/// ```text
/// θ = 1/(1 − exp(−g)) − 1/g          1/2 for g → 0
/// ```
///
/// Above that it goes to 1, which it is from g = 4 on (backward Euler): every pass then lowers the
/// energy, however stiff the pairs and however far the passes are from their end.
#[inline]
pub(super) fn weight(g: f64) -> f64 {
    if g < 0.3 {
        let g2 = g * g;
        return 0.5 + g * (1.0 / 12.0 - g2 * (1.0 / 720.0 - g2 * (1.0 / 30_240.0)));
    }
    if g >= STIFF {
        return 1.0;
    }
    let fitted = 1.0 / (1.0 - (-g).exp()) - 1.0 / g;
    1.0 - (1.0 - fitted) * ((STIFF - g) / (STIFF - 1.0)).min(1.0)
}

/// The impulse p = −(offset + slope a) of a pair along its line of centres, a the speed at which it
/// separates; p > 0 drives the bodies apart.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Normal {
    pub(super) offset: f64,
    pub(super) slope: f64,
    pub(super) answer: f64,
}

impl Normal {
    /// The impulse that fits the speed of separation, which `now` is a part of.
    #[inline(always)]
    pub(super) fn fit(&self, speed: f64, now: f64) -> f64 {
        now - (self.offset + self.slope * speed + now) * self.answer
    }

    /// The terms of the sums that scale a start: p (a + offset/slope) and p²/slope.
    #[inline(always)]
    pub(super) fn start(&self, now: f64, speed: f64) -> [f64; 2] {
        let soft = if self.slope > 0.0 { 1.0 / self.slope } else { 0.0 };
        [now * (speed + soft * self.offset), soft * now * now]
    }
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
    gap: f64,
    charged: f64,
    rate: f64,
    turn: f64,
    weight: f64,
    duration: f64,
    dashpot: f64,
    pull: f64,
    /// 1/m_i + 1/m_j, 1/kg.
    mobility: f64,
}

impl Along {
    /// `rate` is u₀, `turn` κ, `speed` a after the kick. Returns the linear pair too, and whether the
    /// pair has to be searched for because it is not.
    #[inline(always)]
    pub(super) fn new(
        resist: &Resist,
        [gap, charged]: [f64; 2],
        [rate, turn, speed]: [f64; 3],
        duration: f64,
        mobility: f64,
    ) -> (Self, Normal, bool) {
        let Resist { drag, dashpot, pull, clearance, .. } = *resist;
        let weight = weight(duration * (drag + dashpot) * mobility);
        let fresh = gap - (1.0 - weight) * duration * rate;
        let charged = if charged.is_finite() { charged } else { fresh };
        let slope = weight * duration * (drag + dashpot);
        let before = (1.0 - weight) * duration * dashpot * rate;
        let fastest = speed + turn;
        let travel = duration * rate.abs().max(fastest.abs());
        let searched = (drag > 0.0 && travel > LINEAR * clearance)
            || (dashpot > 0.0 && dashpot * rate.max(fastest) > 0.5 * pull);
        let normal = Normal {
            offset: drag * (gap - charged) + before + slope * turn,
            slope,
            answer: 1.0 / (1.0 + slope * mobility),
        };
        let along = Self { gap, charged, rate, turn, weight, duration, dashpot, pull, mobility };
        (along, normal, searched)
    }

    /// How far the gap is charged for after the step `drift`, with the speed of separation `speed`.
    pub(super) fn charged(&self, speed: f64, drift: f64) -> f64 {
        self.gap + self.weight * drift * (speed + self.turn)
    }

    /// The impulse that fits the speed of separation `speed`, which `now` is a part of; `charge`
    /// gives the drag's impulse from contact to a gap, and the drag there. Newton's method between
    /// bounds: what is searched for grows with the speed, by 1/mobility at least.
    #[cold]
    #[inline(never)]
    pub(super) fn search(&self, speed: f64, now: f64, charge: impl Fn(f64) -> [f64; 2]) -> f64 {
        let own = speed - now * self.mobility;
        let [paid, _] = charge(self.charged);
        let (step, before) = (self.weight * self.duration, (1.0 - self.weight) * self.rate);
        let lack = |a: f64| {
            let u = a + self.turn;
            let [to, drag] = charge(self.gap + step * u);
            let pull = self.dashpot * (before + self.weight * u);
            let capped = pull > self.pull;
            let (pull, rise) = if capped { (self.pull, 0.0) } else { (pull, step * self.dashpot) };
            let resisted = to - paid + self.duration * pull;
            [(a - own) / self.mobility + resisted, 1.0 / self.mobility + step * drag + rise]
        };
        let other = own - self.mobility * lack(own)[0];
        let (mut low, mut high) = (own.min(other), own.max(other));
        let small = TOLERANCE * (own.abs() + self.rate.abs());
        // Not `clamp`, which panics where a number is not finite.
        let mut a = speed.max(low).min(high);
        for _ in 0..MOST_ITERATIONS {
            let [f, rise] = lack(a);
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

    #[test]
    fn a_free_pair_decays_like_the_exponential() {
        let (drag, h, mass) = (0.15, 1e-3, 2e-4);
        let resist = Resist { drag, clearance: f64::INFINITY, ..Resist::default() };
        let gaps = [1.0, f64::INFINITY];
        let (along, normal, searched) = Along::new(&resist, gaps, [0.7, 0.0, 0.7], h, 1.0 / mass);
        assert!(!searched);
        let p = normal.fit(0.7, 0.0);
        let left = 0.7 + p / mass;
        assert!((left / (0.7 * (-drag * h / mass).exp()) - 1.0).abs() < 1e-13);
        let found = along.search(0.7, 0.0, |gap| [drag * gap, drag]);
        assert!((found / p - 1.0).abs() < 1e-12);
    }
}
