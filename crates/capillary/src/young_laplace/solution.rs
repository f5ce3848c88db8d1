use super::problem::{Problem, State};

/// One exact bridge at one gap: what can be measured on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solution {
    /// Gap S, m; overlap was read as 0.
    pub gap: f64,
    /// Force along the line of centres, N; tension positive.
    pub force: f64,
    /// Pressure inside the liquid minus pressure outside, Pa; negative for wetting liquids.
    pub pressure_difference: f64,
    /// Half-filling angles β of the two bodies, rad; 0 for a plane.
    pub half_filling_angles: [f64; 2],
    /// Radii of the two contact lines, m.
    pub contact_radii: [f64; 2],
    /// Smallest radius of the liquid, m.
    pub neck_radius: f64,
    /// Distance of the neck from the first body's surface, along the line of centres, m.
    pub neck_position: f64,
    /// Share of the liquid on the first body's side of the neck.
    pub share: f64,
    /// Wetted areas of the two bodies, m².
    pub wetted_areas: [f64; 2],
    /// Free surface of the liquid, m².
    pub free_area: f64,
    /// Surface energy σ (A_free − cos θ_i A_i − cos θ_j A_j), J. Its slope over the gap at
    /// constant volume is the force.
    pub energy: f64,
    pub(super) form: Form,
}

/// The scaled meridian behind a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Form {
    pub(super) problem: Problem,
    pub(super) state: State,
    pub(super) scale: f64,
    pub(super) surface_tension: f64,
    /// The problem's first body is the bridge's second.
    pub(super) swapped: bool,
}

impl Form {
    fn ordered<T>(&self, [first, second]: [T; 2]) -> [T; 2] {
        if self.swapped { [second, first] } else { [first, second] }
    }

    /// Force, N.
    pub(super) fn force(&self) -> f64 {
        std::f64::consts::PI * self.surface_tension * self.scale * self.problem.pull(&self.state)
    }

    /// Share of the liquid on the first body's side of the neck.
    pub(super) fn share(&self) -> f64 {
        let neck = self.problem.neck(&self.state);
        let before = self.problem.share_before(&self.state, neck.t);
        if self.swapped { 1.0 - before } else { before }
    }

    /// Everything about the bridge at `gap`, m.
    pub(super) fn solution(self, gap: f64) -> Solution {
        let (problem, state) = (&self.problem, &self.state);
        let square = self.scale * self.scale;
        let neck = problem.neck(state);
        let along = self.scale * problem.position(state, neck.t);
        let areas = problem.wetted_areas(state).map(|a| a * square);
        let free_area = square * problem.free_area(state);
        let held: f64 = (0..2).map(|k| areas[k] * problem.angles[k].cos()).sum();
        let suction = state[1] * (-state[2]).exp() / self.scale;
        Solution {
            gap,
            force: self.force(),
            pressure_difference: -self.surface_tension * suction,
            half_filling_angles: self.ordered(problem.half_filling_angles(state)),
            contact_radii: self.ordered(problem.contact_radii(state).map(|y| y * self.scale)),
            neck_radius: self.scale * neck.radius,
            neck_position: if self.swapped { gap - along } else { along },
            share: self.share(),
            wetted_areas: self.ordered(areas),
            free_area,
            energy: self.surface_tension * (free_area - held),
            form: self,
        }
    }
}

impl Solution {
    /// `count` points (x, y) of the meridian in m, evenly spaced along it.
    ///
    /// x is the distance from the first body's surface along the line of centres, so that the
    /// bodies meet the axis at 0 and at the gap; y is the distance from the axis. The first point
    /// lies on the first body, the last on the second. Fewer than two points give none.
    #[must_use]
    pub fn meridian(&self, count: usize) -> Vec<[f64; 2]> {
        if count < 2 {
            return Vec::new();
        }
        let Form { problem, state, scale, swapped, .. } = &self.form;
        let start = problem.start(state[0].exp());
        let point = |k: usize| {
            let t = k as f64 / (count - 1) as f64;
            let t = if *swapped { 1.0 - t } else { t };
            let x = scale * problem.position(state, t);
            let y = scale * Problem::point(state, start, t).z.modulus();
            [if *swapped { self.gap - x } else { x }, y]
        };
        (0..count).map(point).collect()
    }
}
