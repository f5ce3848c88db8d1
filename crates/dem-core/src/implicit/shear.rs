//! The impulses across the line of centres that one pair wants.

use super::normal::weight;
use crate::lane::{Lane, Vector};

/// Slip and rolling velocity of a pair, or the impulses on them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion {
    pub(super) slip: Vector<f64>,
    pub(super) rolling: Vector<f64>,
}

/// The impulse F = −θ h A u − offset of a pair whose slip u alone is resisted.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slip<L> {
    pub(super) slope: L,
    /// 1/(1 + slope M), M what an impulse does to the slip, 1/kg.
    pub(super) answer: L,
    pub(super) offset: Vector<L>,
}

impl<L: Lane> Slip<L> {
    /// By how much the impulse `now` has to change to fit the slip.
    #[inline(always)]
    pub(super) fn change(&self, slip: Vector<L>, now: Vector<L>) -> Vector<L> {
        -((self.offset + slip * self.slope + now) * self.answer)
    }
}

/// What decides the impulses where slip and rolling are resisted: (F, Q) = −h C ((1 − θ) y₀ + θ y) for
/// the velocities y = (u, q), C the resistance (A, B; B, D).
#[derive(Debug, Clone, Copy)]
pub(super) struct Coupled {
    /// θ h (A, B, D).
    slope: [f64; 3],
    offset: Motion,
    /// (1 + θ h C M)⁻¹, M what an impulse does to the velocities.
    answer: [f64; 4],
}

impl Coupled {
    /// `before` are the velocities y₀; `mobility` is M: (slip, both, rolling), 1/kg.
    pub(super) fn new(across: [f64; 3], before: Motion, duration: f64, mobility: [f64; 3]) -> Self {
        let [a, b, d] = across;
        let [m, both, turn] = mobility;
        let weight = weight(duration * (a * m).max(d * turn));
        let slope = across.map(|c| weight * duration * c);
        let rest = (1.0 - weight) * duration;
        let offset = Motion {
            slip: (before.slip * a + before.rolling * b) * rest,
            rolling: (before.slip * b + before.rolling * d) * rest,
        };
        let [a, b, d] = slope;
        let [p, q] = [1.0 + a * m + b * both, a * both + b * turn];
        let [r, s] = [b * m + d * both, 1.0 + b * both + d * turn];
        let determinant = p * s - q * r;
        Self { slope, offset, answer: [s, -q, -r, p].map(|c| c / determinant) }
    }

    /// By how much the impulses `now` have to change to fit the velocities `y`.
    pub(super) fn change(&self, y: Motion, now: Motion) -> Motion {
        let [a, b, d] = self.slope;
        let slip = self.offset.slip + y.slip * a + y.rolling * b + now.slip;
        let rolling = self.offset.rolling + y.slip * b + y.rolling * d + now.rolling;
        let [p, q, r, s] = self.answer;
        Motion { slip: -(slip * p + rolling * q), rolling: -(slip * r + rolling * s) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: Vector<f64> = Vector { x: 0.0, y: 0.0, z: 0.0 };
    const ALONG_X: Vector<f64> = Vector { x: 1.0, ..NONE };

    fn length(v: Vector<f64>) -> f64 {
        v.dot(v).sqrt()
    }

    #[test]
    fn a_fit_is_a_fixed_point() {
        // Against a direct solution: impulses that change the velocities, which they then fit.
        let before = Motion { slip: ALONG_X, rolling: ALONG_X * 0.3 };
        let (across, mobility) = ([2.0, -0.4, 1.0], [3.0, 0.5, 7.0]);
        let coupled = Coupled::new(across, before, 0.1, mobility);
        let after = |now: Motion| Motion {
            slip: before.slip + now.slip * mobility[0] + now.rolling * mobility[1],
            rolling: before.rolling + now.slip * mobility[1] + now.rolling * mobility[2],
        };
        let now = coupled.change(before, Motion { slip: NONE, rolling: NONE });
        let again = coupled.change(after(now), now);
        assert!(length(again.slip) + length(again.rolling) < 1e-15);
        assert!(now.slip.x < 0.0 && after(now).slip.x > 0.0, "braked, not turned back");
    }

    #[test]
    fn without_coupling_both_are_the_same() {
        let before = Vector { x: 0.3, y: -0.2, z: 0.5 };
        let (drag, h, mobility) = (2.0, 0.1, 3.0);
        let weight = weight(h * drag * mobility);
        let slope = weight * h * drag;
        let offset = before * ((1.0 - weight) * h * drag);
        let slip = Slip { slope, answer: 1.0 / (1.0 + slope * mobility), offset };
        let motion = Motion { slip: before, rolling: NONE };
        let coupled = Coupled::new([drag, 0.0, 0.0], motion, h, [mobility, 0.5, 7.0]);
        let alone = slip.change(before, NONE);
        let change = coupled.change(motion, Motion { slip: NONE, rolling: NONE });
        assert!(length(alone - change.slip) < 1e-15 && length(change.rolling) < 1e-15);
    }
}
