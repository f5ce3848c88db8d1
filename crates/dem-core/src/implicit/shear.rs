//! The impulses across the line of centres that one pair wants.

use glam::DVec3;

use super::normal::weight;

/// Slip and rolling velocity of a pair, or the impulses on them.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Motion {
    pub(super) slip: DVec3,
    pub(super) rolling: DVec3,
}

/// What decides them: impulses (F, Q) = −h C ((1 − θ) y₀ + θ y) for the velocities y = (u, q), C the
/// resistance (A, B; B, D).
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Shear {
    /// θ h (A, B, D).
    slope: [f64; 3],
    offset: Motion,
    /// (1 + θ h C M)⁻¹, M what an impulse does to the velocities.
    answer: [f64; 4],
    pub(super) coupled: bool,
}

impl Shear {
    /// `before` are the velocities y₀; `mobility` is M: (slip, both, rolling), 1/kg.
    pub(super) fn new(across: [f64; 3], before: Motion, duration: f64, mobility: [f64; 3]) -> Self {
        let [a, b, d] = across;
        let [m, both, turn] = mobility;
        let coupled = b != 0.0 || d != 0.0;
        let weight = weight(duration * (a * m).max(d * turn));
        let slope = across.map(|c| weight * duration * c);
        let rest = (1.0 - weight) * duration;
        let offset = Motion {
            slip: rest * (a * before.slip + b * before.rolling),
            rolling: rest * (b * before.slip + d * before.rolling),
        };
        let [a, b, d] = slope;
        let answer = if coupled {
            let [p, q] = [1.0 + a * m + b * both, a * both + b * turn];
            let [r, s] = [b * m + d * both, 1.0 + b * both + d * turn];
            let determinant = p * s - q * r;
            [s, -q, -r, p].map(|c| c / determinant)
        } else {
            [1.0 / (1.0 + a * m), 0.0, 0.0, 1.0]
        };
        Self { slope, offset, answer, coupled }
    }

    /// Whether anything resists.
    pub(super) fn any(&self) -> bool {
        self.slope[0] > 0.0 || self.coupled
    }

    /// By how much the impulses `now` have to change to fit the velocities `y`.
    #[inline(always)]
    pub(super) fn change(&self, y: Motion, now: Motion) -> Motion {
        let [a, b, d] = self.slope;
        if !self.coupled {
            let lack = self.offset.slip + a * y.slip + now.slip;
            return Motion { slip: -self.answer[0] * lack, rolling: DVec3::ZERO };
        }
        let slip = self.offset.slip + a * y.slip + b * y.rolling + now.slip;
        let rolling = self.offset.rolling + b * y.slip + d * y.rolling + now.rolling;
        let [p, q, r, s] = self.answer;
        Motion { slip: -(p * slip + q * rolling), rolling: -(r * slip + s * rolling) }
    }

    /// The sums that scale a start, as in [`super::normal::Normal::start`]; of the slip alone.
    pub(super) fn start(&self, now: Motion, y: Motion) -> [f64; 2] {
        let a = self.slope[0];
        if a > 0.0 {
            let along = now.slip.dot(y.slip + self.offset.slip / a);
            [along, now.slip.length_squared() / a]
        } else {
            [0.0; 2]
        }
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
        let shear = Shear::new(across, before, 0.1, mobility);
        let mut now = Motion::default();
        let after = |now: Motion| Motion {
            slip: before.slip + mobility[0] * now.slip + mobility[1] * now.rolling,
            rolling: before.rolling + mobility[1] * now.slip + mobility[2] * now.rolling,
        };
        let change = shear.change(after(now), now);
        now = Motion { slip: now.slip + change.slip, rolling: now.rolling + change.rolling };
        let again = shear.change(after(now), now);
        assert!(again.slip.length() + again.rolling.length() < 1e-15);
        assert!(now.slip.x < 0.0 && after(now).slip.x > 0.0, "braked, not turned back");
    }
}
