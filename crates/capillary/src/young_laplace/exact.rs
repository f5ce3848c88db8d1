use pendular_pair::{Bridge, Mate};

use super::error::SolveError;
use super::gauss::Rule;
use super::path::{Lost, Node, Path, Solver};
use super::problem::{Problem, State};
use super::rupture::Rupture;
use super::solution::{Form, Solution};

/// Radii and angles that agree to this are taken as equal, so that the bridge is symmetric.
const EQUAL: f64 = 1e-12;

/// The same where the solver cannot tell an asymmetry from rounding. S_rup changes by the 2/3 power
/// of the asymmetry, some 1e-9 where that happens.
const NEARLY_EQUAL: f64 = 1e-10;

/// The exact bridge from contact to rupture: one continuation, then any number of gaps.
///
/// Making it costs about half a millisecond; each gap after that some ten microseconds.
///
/// # Units
/// As [`Bridge`]: m, m³, rad, N/m; forces in N, tension positive.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactBridge {
    bridge: Bridge,
    setup: Setup,
    path: Path,
    rupture: Rupture,
}

/// How a bridge becomes a dimensionless problem.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Setup {
    pub(super) solver: Solver,
    /// The whole bridge, also where the solver works on half of a symmetric one.
    pub(super) whole: Problem,
    pub(super) scale: f64,
    pub(super) surface_tension: f64,
    pub(super) swapped: bool,
}

impl Setup {
    pub(super) fn new(bridge: &Bridge, rule: Rule) -> Self {
        Self::within(bridge, rule, EQUAL)
    }

    /// The setup that takes radii and angles as equal within a tolerance.
    fn within(bridge: &Bridge, rule: Rule, tolerance: f64) -> Self {
        let scale = bridge.harmonic_radius();
        let mate = match bridge.mate() {
            Mate::Sphere { radius } => radius,
            Mate::Wall { .. } => f64::INFINITY,
        };
        let [first, second] = bridge.contact_angles();
        let equal = (bridge.radius() / mate - 1.0).abs() < tolerance;
        let mirror = equal && (first - second).abs() < tolerance;
        let swapped = if equal { first > second } else { bridge.radius() > mate };
        let (near, far) = if swapped { (mate, bridge.radius()) } else { (bridge.radius(), mate) };
        let angles = if swapped { [second, first] } else { [first, second] };
        let volume = bridge.v_star();
        let whole = Problem { radius: near / scale, curvature: scale / far, angles, volume, rule };
        let half = Problem {
            radius: 1.0,
            curvature: 0.0,
            angles: [angles[0], std::f64::consts::FRAC_PI_2],
            volume: 0.5 * volume,
            rule,
        };
        let solver = Solver { problem: if mirror { half } else { whole }, mirror };
        Self { solver, whole, scale, surface_tension: bridge.surface_tension(), swapped }
    }

    /// Metres per unit of the solver's gap.
    pub(super) fn gap_unit(&self) -> f64 {
        if self.solver.mirror { 2.0 * self.scale } else { self.scale }
    }

    /// The whole meridian of a solver's state.
    pub(super) fn form(&self, state: State) -> Form {
        let [beta, phase, length] = state;
        let two = std::f64::consts::LN_2;
        let whole = if self.solver.mirror { [beta, 2.0 * phase, length + two] } else { state };
        Form {
            problem: self.whole,
            state: whole,
            scale: self.scale,
            surface_tension: self.surface_tension,
            swapped: self.swapped,
        }
    }
}

impl ExactBridge {
    /// Follows a bridge from contact to rupture.
    ///
    /// # Errors
    /// [`SolveError::NoStableBridge`] if even touching bodies hold no stable bridge of this
    /// volume, [`SolveError::NotConverged`] if the continuation fails on its way.
    pub fn new(bridge: &Bridge) -> Result<Self, SolveError> {
        Self::with_rule(bridge, Rule::Fine)
    }

    /// [`ExactBridge::new`] to 1e-7 at half the cost: for tables, which are coarser than that.
    pub(crate) fn coarse(bridge: &Bridge) -> Result<Self, SolveError> {
        Self::with_rule(bridge, Rule::Coarse)
    }

    fn with_rule(bridge: &Bridge, rule: Rule) -> Result<Self, SolveError> {
        let mut setup = Setup::new(bridge, rule);
        let mut path = setup.solver.path();
        if path.is_err() && !setup.solver.mirror {
            setup = Setup::within(bridge, rule, NEARLY_EQUAL);
            if setup.solver.mirror {
                path = setup.solver.path();
            }
        }
        let v_star = bridge.v_star();
        let path = path.map_err(|lost| match lost {
            Lost::AtContact => {
                SolveError::NoStableBridge { v_star, contact_angles: bridge.contact_angles() }
            }
            Lost::AtGap(gap) => SolveError::NotConverged { v_star, gap: gap * setup.gap_unit() },
        })?;
        let lost = SolveError::NotConverged { v_star, gap: 0.0 };
        let last = path.nodes.last().ok_or(lost)?;
        let symmetric = setup.solver.mirror;
        let rupture = Rupture {
            distance: last.gap * setup.gap_unit(),
            kind: path.kind,
            share: if symmetric { 0.5 } else { setup.form(last.state).share() },
        };
        Ok(Self { bridge: *bridge, setup, path, rupture })
    }

    /// The bridge that is solved.
    #[must_use]
    pub fn bridge(&self) -> &Bridge {
        &self.bridge
    }

    /// Where and how the bridge ends.
    #[must_use]
    pub fn rupture(&self) -> Rupture {
        self.rupture
    }

    /// Force at a gap, N; tension positive. Overlap (S < 0) reads as S = 0.
    ///
    /// # Errors
    /// As [`ExactBridge::solve`].
    pub fn force(&self, gap: f64) -> Result<f64, SolveError> {
        Ok(self.setup.form(self.state(gap)?).force())
    }

    /// The bridge at a gap, m. Overlap (S < 0) reads as S = 0.
    ///
    /// # Errors
    /// [`SolveError::Gap`] if the gap is not finite, [`SolveError::Ruptured`] beyond the rupture
    /// distance, [`SolveError::NotConverged`] if the solver fails.
    pub fn solve(&self, gap: f64) -> Result<Solution, SolveError> {
        let state = self.state(gap)?;
        Ok(self.setup.form(state).solution(gap.max(0.0)))
    }

    /// The last stable bridge, at the rupture distance.
    #[must_use]
    pub fn last_stable(&self) -> Solution {
        let state = self.path.nodes.last().map_or([0.0; 3], |node| node.state);
        self.setup.form(state).solution(self.rupture.distance)
    }

    fn state(&self, gap: f64) -> Result<State, SolveError> {
        if !gap.is_finite() {
            return Err(SolveError::Gap { gap });
        }
        if gap > self.rupture.distance {
            return Err(SolveError::Ruptured { gap, rupture_distance: self.rupture.distance });
        }
        let lost = SolveError::NotConverged { v_star: self.bridge.v_star(), gap };
        self.scaled_state(gap.max(0.0) / self.setup.gap_unit()).ok_or(lost)
    }

    pub(super) fn setup(&self) -> &Setup {
        &self.setup
    }

    /// The solver's state at a gap in its own unit.
    pub(super) fn scaled_state(&self, gap: f64) -> Option<State> {
        self.path.state(&self.setup.solver, gap)
    }
}

impl Path {
    /// The stable state at a gap (in units of the solver).
    pub(super) fn state(&self, solver: &Solver, gap: f64) -> Option<State> {
        let end = self.nodes.last()?;
        let after = self.nodes.partition_point(|node| node.gap <= gap);
        if after == self.nodes.len() {
            return Some(end.state);
        }
        let low = self.nodes.get(after.checked_sub(1)?)?;
        if low.gap == gap {
            return Some(low.state);
        }
        // The branch is smooth in √(1 − S/S_rup), also at a fold.
        let depth = |node: &Node| (1.0 - node.gap / end.gap).max(0.0).sqrt();
        let high = &self.nodes[after];
        let (a, b) = (depth(low), depth(high));
        let share = (a - (1.0 - gap / end.gap).max(0.0).sqrt()) / (a - b);
        let guess = [0, 1, 2].map(|k| low.state[k] + share * (high.state[k] - low.state[k]));
        let trust = |found: State| {
            let moved = (0..3).fold(0.0_f64, |m, k| m.max((found[k] - guess[k]).abs()));
            let span = (0..3).fold(0.0_f64, |m, k| m.max((high.state[k] - low.state[k]).abs()));
            (moved < span.max(1e-9) && solver.stable(&found)).then_some(found)
        };
        // The last part in 1e12 before a fold is rounding.
        let last = || (gap > end.gap * (1.0 - 1e-12)).then_some(end.state);
        solver.at_gap(gap, guess).and_then(trust).or_else(|| walk(solver, *low, gap)).or_else(last)
    }
}

/// Natural continuation in the gap, in steps that shrink where Newton fails.
fn walk(solver: &Solver, low: Node, gap: f64) -> Option<State> {
    let (mut node, mut before) = (low, low);
    let mut step = 0.5 * (gap - low.gap);
    for _ in 0..200 {
        let next = (node.gap + step).min(gap);
        let ratio =
            if node.gap > before.gap { (next - node.gap) / (node.gap - before.gap) } else { 0.0 };
        let guess = [0, 1, 2].map(|k| node.state[k] + ratio * (node.state[k] - before.state[k]));
        let near = |found: &State| (0..3).all(|k| (found[k] - guess[k]).abs() < 0.2);
        match solver.at_gap(next, guess).filter(|s| near(s) && solver.stable(s)) {
            Some(state) if next >= gap => return Some(state),
            Some(state) => (before, node) = (node, Node { state, gap: next }),
            None => step *= 0.5,
        }
    }
    None
}
