//! The impulses across the line of centres that one pair wants.

use glam::DVec3;

use super::normal::weight;

/// Slip and rolling velocity of a pair, or the impulses on them.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Motion {
    pub(super) slip: DVec3,
    pub(super) rolling: DVec3,
}

/// The impulse F = −θ h A u − offset of a pair whose slip u alone is resisted.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Slip {
    pub(super) slope: f64,
    pub(super) answer: f64,
    pub(super) offset: DVec3,
}

impl Slip {
    /// `before` is the slip before the kick, `mobility` what an impulse does to it, 1/kg.
    #[inline(always)]
    pub(super) fn new(drag: f64, before: DVec3, duration: f64, mobility: f64) -> Self {
        let weight = weight(duration * drag * mobility);
        let slope = weight * duration * drag;
        let offset = (1.0 - weight) * duration * drag * before;
        Self { slope, answer: 1.0 / (1.0 + slope * mobility), offset }
    }

    /// By how much the impulse `now` has to change to fit the slip.
    #[inline(always)]
    pub(super) fn change(&self, slip: DVec3, now: DVec3) -> DVec3 {
        -self.answer * (self.offset + self.slope * slip + now)
    }

    /// The sums that scale a start, as in [`super::normal::Normal::start`].
    #[inline(always)]
    pub(super) fn start(&self, now: DVec3, slip: DVec3) -> [f64; 2] {
        let soft = if self.slope > 0.0 { 1.0 / self.slope } else { 0.0 };
        [now.dot(slip) + soft * now.dot(self.offset), soft * now.length_squared()]
    }
}

/// What decides the impulses where slip and rolling are resisted: (F, Q) = −h C ((1 − θ) y₀ + θ y) for
/// the velocities y = (u, q), C the resistance (A, B; B, D).
#[derive(Debug, Clone, Copy, Default)]
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
            slip: rest * (a * before.slip + b * before.rolling),
            rolling: rest * (b * before.slip + d * before.rolling),
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
        let slip = self.offset.slip + a * y.slip + b * y.rolling + now.slip;
        let rolling = self.offset.rolling + b * y.slip + d * y.rolling + now.rolling;
        let [p, q, r, s] = self.answer;
        Motion { slip: -(p * slip + q * rolling), rolling: -(r * slip + s * rolling) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fit_is_a_fixed_point() {
        // Against a direct solution: impulses that change the velocities, which they then fit.
        let before = Motion { slip: DVec3::X, rolling: 0.3 * DVec3::X };
        let (across, mobility) = ([2.0, -0.4, 1.0], [3.0, 0.5, 7.0]);
        let coupled = Coupled::new(across, before, 0.1, mobility);
        let after = |now: Motion| Motion {
            slip: before.slip + mobility[0] * now.slip + mobility[1] * now.rolling,
            rolling: before.rolling + mobility[1] * now.slip + mobility[2] * now.rolling,
        };
        let now = coupled.change(after(Motion::default()), Motion::default());
        let again = coupled.change(after(now), now);
        assert!(again.slip.length() + again.rolling.length() < 1e-15);
        assert!(now.slip.x < 0.0 && after(now).slip.x > 0.0, "braked, not turned back");
    }

    #[test]
    fn without_coupling_both_are_the_same() {
        let before = DVec3::new(0.3, -0.2, 0.5);
        let slip = Slip::new(2.0, before, 0.1, 3.0);
        let motion = Motion { slip: before, rolling: DVec3::ZERO };
        let coupled = Coupled::new([2.0, 0.0, 0.0], motion, 0.1, [3.0, 0.5, 7.0]);
        let alone = slip.change(before, DVec3::ZERO);
        let change = coupled.change(motion, Motion::default());
        assert!((alone - change.slip).length() < 1e-15 && change.rolling.length() < 1e-15);
    }
}
