use super::newton::{bracketed_root, newton, solve_linear};
use super::problem::{Problem, State, Values};
use super::rupture::RuptureKind;

/// Smallest dimensionless volume to start from; the torus estimate is good there.
const SEED_VOLUME: f64 = 1e-7;

/// A solved bridge on the stable branch, in units of R.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    pub(super) state: State,
    pub(super) gap: f64,
}

/// The stable branch from contact to rupture.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Path {
    pub(super) nodes: Vec<Node>,
    pub(super) kind: RuptureKind,
}

/// How far a path came before it was lost; the last gap, in units of R.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Lost {
    AtContact,
    AtGap(f64),
}

/// Solves and follows one problem. `mirror`: the problem is half a symmetric bridge, and its
/// second body the plane of symmetry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Solver {
    pub(super) problem: Problem,
    pub(super) mirror: bool,
}

/// Point of the branch with its unit tangent (unknowns, gap over `reach`).
#[derive(Debug, Clone, Copy)]
struct Step {
    node: Node,
    tangent: [f64; 4],
}

impl Solver {
    /// Solves for the meridian at a gap from a guess.
    pub(super) fn at_gap(&self, gap: f64, guess: State) -> Option<State> {
        self.at(self.problem.volume, gap, guess)
    }

    fn at(&self, volume: f64, gap: f64, guess: State) -> Option<State> {
        let length = self.length(volume, gap);
        newton(guess, |state| {
            let v = self.problem.evaluate(state)?;
            let [angle, by_volume, by_gap] = v.gradient;
            Some((
                [v.angle, v.volume / volume - 1.0, (v.gap - gap) / length],
                [angle, by_volume.map(|g| g / volume), by_gap.map(|g| g / length)],
            ))
        })
    }

    /// Height of a small bridge at its contact line, H = √(S² + 2V/(πR)), in the problem's units.
    fn length(&self, volume: f64, gap: f64) -> f64 {
        (gap * gap + 2.0 * volume * self.spread() / std::f64::consts::PI).sqrt()
    }

    /// 1/r_i + 1/r_j, twice the curvature of the gap.
    fn spread(&self) -> f64 {
        self.problem.curvature + 1.0 / self.problem.radius
    }

    /// Length that scales gaps in the arc length of the branch: V^(1/3).
    fn reach(&self) -> f64 {
        self.problem.volume.cbrt()
    }

    /// Small-bridge (torus) estimate of the state at contact.
    fn torus(&self, volume: f64) -> State {
        let height = self.length(volume, 0.0);
        let y = (2.0 * height / self.spread()).sqrt();
        let [first, second] = self.problem.angles;
        let beta = y / self.problem.radius;
        let phase = std::f64::consts::PI - beta - y * self.problem.curvature - first - second;
        let half_sum = 0.5 * (first.cos() + second.cos());
        // L = H φ/(cos θ_i + cos θ_j), whose limit for φ → 0 is H.
        let length = if half_sum.abs() < 1e-3 { height } else { 0.5 * height * phase / half_sum };
        [beta.ln(), phase, length.max(0.3 * height).ln()]
    }

    /// The bridge between touching bodies, by continuation in the volume.
    pub(super) fn contact(&self) -> Option<State> {
        let target = self.problem.volume;
        let mut volume = target.min(SEED_VOLUME);
        let mut state = self.at(volume, 0.0, self.torus(volume))?;
        let mut step: f64 = 2.0;
        for _ in 0..200 {
            if !self.stable(&state) {
                return None;
            }
            if volume >= target {
                return Some(state);
            }
            let next = (volume * step.exp()).min(target);
            let rise = (next / volume).ln();
            let corrected = self.by_log_volume(&state, volume).and_then(|slope| {
                let guess = [0, 1, 2].map(|k| state[k] + rise * slope[k]);
                let found = self.at(next, 0.0, guess)?;
                let moved = (0..3).fold(0.0_f64, |m, k| m.max((found[k] - guess[k]).abs()));
                (moved < 0.2 && self.stable(&found)).then_some(found)
            });
            match corrected {
                Some(found) => (state, volume, step) = (found, next, (1.4 * step).min(3.0)),
                None if step < 1e-6 => return None,
                None => step *= 0.5,
            }
        }
        None
    }

    fn by_log_volume(&self, state: &State, volume: f64) -> Option<State> {
        let v = self.problem.evaluate(state)?;
        let length = self.length(volume, 0.0);
        let [angle, by_volume, by_gap] = v.gradient;
        let rows = [angle, by_volume.map(|g| g / volume), by_gap.map(|g| g / length)];
        solve_linear(rows, [0.0, 1.0, 0.0])
    }

    /// Whether a state lies on the stable side of fold and pitchfork.
    pub(super) fn stable(&self, state: &State) -> bool {
        self.tangent(state).is_some_and(|t| t[3] > 0.0)
            && (!self.mirror || self.antisymmetric(state) > 0.0)
    }

    /// Tangent of the branch, oriented so that stable bridges have a growing gap.
    ///
    /// It is the vector of minors of the Jacobian, so that its orientation follows one smooth rule
    /// along a branch: its last entry is the determinant whose sign tells stable from unstable.
    fn tangent(&self, state: &State) -> Option<[f64; 4]> {
        let rows = self.rows(&self.problem.evaluate(state)?);
        let minor = |skip: usize| {
            let column = |k: usize| rows.map(|row| row[if k < skip { k } else { k + 1 }]);
            determinant(column(0), column(1), column(2))
        };
        let t = [minor(0), -minor(1), minor(2), -minor(3)];
        let size = t.iter().map(|x| x * x).sum::<f64>().sqrt();
        (size > 0.0 && size.is_finite()).then(|| t.map(|x| ORIENTATION * x / size))
    }

    /// Rows of residual derivatives by the unknowns and the scaled gap.
    fn rows(&self, v: &Values) -> [[f64; 4]; 3] {
        let row = |k: usize, scale: f64, last: f64| {
            let [a, b, c] = v.gradient[k];
            [a / scale, b / scale, c / scale, last]
        };
        let reach = self.reach();
        [row(0, 1.0, 0.0), row(1, self.problem.volume, 0.0), row(2, reach, -1.0)]
    }

    /// Positive while a symmetric bridge is stable against antisymmetric disturbances.
    ///
    /// Such a disturbance leaves the suction and, to first order, volume and gap; its mode is
    /// neutral when the radius at the plane of symmetry does not change with β at fixed suction
    /// and length, which comes to sin(φ + 2β + θ) = 0 with φ the phase of half the meridian.
    pub(super) fn antisymmetric(&self, state: &State) -> f64 {
        (state[1] + 2.0 * state[0].exp() + self.problem.angles[0]).sin()
    }

    /// Follows the stable branch from contact to its end.
    pub(super) fn path(&self) -> Result<Path, Lost> {
        let state = self.contact().ok_or(Lost::AtContact)?;
        let tangent = self.tangent(&state).ok_or(Lost::AtContact)?;
        let mut last = Step { node: Node { state, gap: 0.0 }, tangent };
        let mut nodes = vec![last.node];
        let mut stride = 0.05;
        for _ in 0..2000 {
            let lost = Lost::AtGap(last.node.gap);
            let next =
                self.advance(&last, stride).filter(|next| dot(&next.tangent, &last.tangent) > 0.97);
            let Some(next) = next else {
                stride *= 0.5;
                if stride < 1e-9 {
                    return Err(lost);
                }
                continue;
            };
            if let Some((node, kind)) = self.rupture_between(&last, &next, stride) {
                nodes.push(node.ok_or(lost)?);
                return Ok(Path { nodes, kind });
            }
            if dot(&next.tangent, &last.tangent) > 0.992 {
                stride = (1.5 * stride).min(0.4);
            }
            nodes.push(next.node);
            last = next;
        }
        Err(Lost::AtGap(last.node.gap))
    }

    /// One step of pseudo-arc-length continuation.
    fn advance(&self, from: &Step, stride: f64) -> Option<Step> {
        let reach = self.reach();
        let [a, b, c] = from.node.state;
        let start = [a, b, c, from.node.gap / reach];
        let guess = [0, 1, 2, 3].map(|k| start[k] + stride * from.tangent[k]);
        let found = newton(guess, |x| {
            let state = [x[0], x[1], x[2]];
            let v = self.problem.evaluate(&state)?;
            let rows = self.rows(&v);
            let ahead: f64 = (0..4).map(|k| from.tangent[k] * (x[k] - guess[k])).sum();
            Some((
                [v.angle, v.volume / self.problem.volume - 1.0, v.gap / reach - x[3], ahead],
                [rows[0], rows[1], rows[2], from.tangent],
            ))
        })?;
        let moved = (0..4).fold(0.0_f64, |m, k| m.max((found[k] - guess[k]).abs()));
        let state = [found[0], found[1], found[2]];
        let node = Node { state, gap: found[3] * reach };
        (moved < 0.5 * stride).then_some(Step { node, tangent: self.tangent(&state)? })
    }

    /// The first loss of stability between two steps, if there is one.
    fn rupture_between(
        &self,
        from: &Step,
        to: &Step,
        stride: f64,
    ) -> Option<(Option<Node>, RuptureKind)> {
        let fold = |step: &Step| step.tangent[3];
        let fork = |step: &Step| self.antisymmetric(&step.node.state);
        let find = |measure: &dyn Fn(&Step) -> f64| {
            bracketed_root((0.0, measure(from)), (stride, measure(to)), 1e-12 * stride, |h| {
                let step = self.advance(from, h)?;
                Some((measure(&step), (h, step.node)))
            })
        };
        let folded = (fold(to) <= 0.0).then(|| find(&fold));
        let forked = (self.mirror && fork(to) <= 0.0).then(|| find(&fork));
        let (kind, found) = match (folded, forked) {
            (None, None) => return None,
            (Some(fold), None) => (RuptureKind::Fold, fold),
            (None, Some(fork)) => (RuptureKind::Pitchfork, fork),
            (Some(Some(fold)), Some(Some(fork))) if fork.0 < fold.0 => {
                (RuptureKind::Pitchfork, Some(fork))
            }
            (Some(fold), Some(_)) => (RuptureKind::Fold, fold),
        };
        Some((found.map(|(_, node)| node), kind))
    }
}

/// Sign that makes the tangent of small bridges, which are stable, point to larger gaps.
const ORIENTATION: f64 = 1.0;

fn dot(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn determinant(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}
