//! A pair whose motion is resisted, ready to be solved for.

use glam::DVec3;

use super::normal::Normal;
use super::shear::{Motion, Shear};
use super::{Impulse, Resist};
use crate::chunk::List;
use crate::particles::{Class, Velocity};
use crate::{Pair, Partner};

/// A pair in the passes of one step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Link {
    /// Slots of the bodies; the second is that of the first again at a wall.
    pub(crate) slots: [u32; 2],
    /// Where the pair's column stands.
    pub(crate) list: List,
    pub(crate) index: u32,
    pub(crate) impulse: Impulse,
    normal: DVec3,
    levers: [f64; 2],
    /// 1/m and 1/I of both bodies; 0 for a wall.
    inverse_mass: [f64; 2],
    inverse_inertia: [f64; 2],
    reduced: f64,
    /// Velocity of the wall, m/s; zero between particles.
    pub(crate) wall: DVec3,
    along: Normal,
    across: Shear,
    rolling_limit: f64,
    rolling_inertia: f64,
}

/// What a change of impulses amounts to, N s.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Change {
    pub(crate) changed: f64,
    pub(crate) all: f64,
}

impl std::ops::Add for Change {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { changed: self.changed + other.changed, all: self.all + other.all }
    }
}

/// Who a link is between.
pub(crate) struct Between<'a> {
    pub(crate) slots: [u32; 2],
    pub(crate) classes: [Option<&'a Class>; 2],
    pub(crate) list: List,
    pub(crate) index: u32,
}

impl Link {
    /// `resist` is what the pair resists with; velocities before the kick are in `pair`, the
    /// relative velocity after it is `kicked`; the impulses act over `duration` s.
    pub(crate) fn new(
        between: &Between<'_>,
        pair: &Pair,
        resist: &Resist,
        impulse: Impulse,
        kicked: DVec3,
        duration: f64,
    ) -> Self {
        let Between { slots, classes, list, index } = *between;
        let inverse_mass = classes.map(|c| c.map_or(0.0, |class| 1.0 / class.mass()));
        let inverse_inertia = classes.map(|c| c.map_or(0.0, |class| 1.0 / class.inertia()));
        let wall = matches!(pair.encounter.second, Partner::Wall(_));
        let [r, q] = pair.radii;
        let reduced = if wall { r } else { r * q / (r + q) };
        let mobility = inverse_mass[0] + inverse_mass[1];
        let [turn_i, turn_j] = inverse_inertia;
        let [l, k] = pair.levers;
        let across_mobility = [
            mobility + l * l * turn_i + k * k * turn_j,
            reduced * (l * turn_i - k * turn_j),
            reduced * reduced * (turn_i + turn_j),
        ];
        let speed = -kicked.dot(pair.normal);
        // The line of centres turns during the step: |d − h v| grows by v_t² h/(2 |d|).
        let sideways = kicked.length_squared() - speed * speed;
        let turn = if wall { 0.0 } else { 0.5 * pair.time_step * sideways.max(0.0) / (l + k) };
        let rates = [pair.separation_speed, turn, speed];
        let gaps = [pair.encounter.gap, impulse.charged];
        let before =
            Motion { slip: pair.slip, rolling: reduced * pair.spin.cross(pair.half_step_normal) };
        Self {
            slots,
            list,
            index,
            // The plane across the line of centres has turned a little.
            impulse: Impulse {
                shear: impulse.shear.reject_from_normalized(pair.normal),
                ..impulse
            },
            normal: pair.normal,
            levers: pair.levers,
            inverse_mass,
            inverse_inertia,
            reduced,
            wall: DVec3::ZERO,
            along: Normal::new(resist, gaps, rates, duration, mobility),
            across: Shear::new(resist.across, before, duration, across_mobility),
            rolling_limit: duration * resist.rolling,
            rolling_inertia: 1.0 / (turn_i + turn_j),
        }
    }

    /// Speed of separation along the normal, slip and rolling velocity.
    #[inline(always)]
    fn motion(&self, [p, q]: [&Velocity; 2]) -> (f64, Motion) {
        let v = p.v - q.v;
        let along = v.dot(self.normal);
        let turning = (self.levers[0] * p.w + self.levers[1] * q.w).cross(self.normal);
        let slip = v - along * self.normal + turning;
        let rolling = if self.across.coupled {
            self.reduced * (p.w - q.w).cross(self.normal)
        } else {
            DVec3::ZERO
        };
        (-along, Motion { slip, rolling })
    }

    /// Gives impulses to both bodies.
    #[inline(always)]
    fn give(&self, [p, q]: [&mut Velocity; 2], normal: f64, across: Motion, rolling: DVec3) {
        let force = across.slip - normal * self.normal;
        let arm = self.normal.cross(across.slip);
        let couple = if self.across.coupled {
            self.reduced * self.normal.cross(across.rolling) + rolling
        } else {
            rolling
        };
        p.v += self.inverse_mass[0] * force;
        q.v -= self.inverse_mass[1] * force;
        p.w += self.inverse_inertia[0] * (self.levers[0] * arm + couple);
        q.w += self.inverse_inertia[1] * (self.levers[1] * arm - couple);
    }

    /// Gives what the pair remembers to the velocities.
    #[inline(always)]
    pub(crate) fn push(&self, bodies: [&mut Velocity; 2]) {
        let Impulse { normal, shear, couple, rolling, .. } = self.impulse;
        self.give(bodies, normal, Motion { slip: shear, rolling: couple }, rolling);
    }

    /// The sums that scale a start, for the velocities after the kick.
    pub(crate) fn start(&self, bodies: [&Velocity; 2]) -> [f64; 2] {
        let (speed, across) = self.motion(bodies);
        let Impulse { normal, shear, couple, rolling, .. } = self.impulse;
        let [a, b] = self.along.start(normal, speed);
        let [c, d] = self.across.start(Motion { slip: shear, rolling: couple }, across);
        [a + c + rolling.dot(bodies[0].w - bodies[1].w), b + d]
    }

    /// One visit of a pass: changes the impulses so that they fit the velocities, and the velocities
    /// with them.
    #[inline(always)]
    pub(crate) fn relax(
        &mut self,
        [p, q]: [&mut Velocity; 2],
        charge: impl Fn(f64) -> [f64; 2],
    ) -> Change {
        let (speed, y) = self.motion([p, q]);
        let before = self.impulse;
        let normal = self.along.fit(speed, before.normal, charge);
        let mut across = Motion::default();
        if self.across.any() {
            let now = Motion { slip: before.shear, rolling: before.couple };
            across = self.across.change(y, now);
        }
        let mut rolling = DVec3::ZERO;
        if self.rolling_limit > 0.0 {
            rolling = self.brake(p.w - q.w);
        }
        self.give([p, q], normal - before.normal, across, rolling);
        self.impulse.normal = normal;
        self.impulse.shear += across.slip;
        self.impulse.couple += across.rolling;
        self.impulse.rolling += rolling;
        Change {
            changed: (normal - before.normal).abs() + across.slip.length(),
            all: normal.abs() + self.impulse.shear.length(),
        }
    }

    /// The change of the rolling impulse that stops the rolling, within its bound.
    fn brake(&self, spin: DVec3) -> DVec3 {
        let rolling = spin - spin.dot(self.normal) * self.normal;
        let wanted = self.impulse.rolling - self.rolling_inertia * rolling;
        wanted.clamp_length_max(self.rolling_limit) - self.impulse.rolling
    }

    /// Closes the step: how far the gap has been charged for.
    pub(crate) fn close(&mut self, bodies: [&Velocity; 2], drift: f64) {
        let (speed, _) = self.motion(bodies);
        self.impulse.charged = self.along.charged(speed, drift);
    }

    /// Scales what the pair remembers.
    pub(crate) fn scale(&mut self, share: f64) {
        self.impulse.normal *= share;
        self.impulse.shear *= share;
        self.impulse.couple *= share;
        self.impulse.rolling *= share;
    }
}
