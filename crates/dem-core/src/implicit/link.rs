//! Pairs whose motion is resisted, ready to be solved for.

use glam::DVec3;

use super::normal::{Along, Normal};
use super::shear::{Coupled, Motion, Slip};
use super::{Impulse, Resist};
use crate::chunk::List;
use crate::particles::{Class, Velocity};

/// Of a link that is nothing but its own record.
const NOTHING_MORE: u32 = u32::MAX;

/// A pair as it was read: where it is and how it moved before the kick.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Met {
    /// Slots of the bodies; the second is that of the first again at a wall.
    pub(crate) slots: [u32; 2],
    /// Where the pair's column stands.
    pub(crate) list: List,
    pub(crate) index: u32,
    pub(crate) normal: DVec3,
    pub(crate) levers: [f64; 2],
    pub(crate) gap: f64,
    /// dS/dt.
    pub(crate) rate: f64,
    pub(crate) slip: DVec3,
}

/// What every visit of a pass needs of a pair.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Link {
    pub(crate) slots: [u32; 2],
    /// Where there is more to it, or [`NOTHING_MORE`].
    more: u32,
    /// Whether the impulse along the normal has to be searched for.
    searched: bool,
    normal: DVec3,
    levers: [f64; 2],
    push: f64,
    shear: DVec3,
    along: Normal,
    slip: Slip,
}

/// What only the search and the end of the step need of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kept {
    pub(crate) list: List,
    pub(crate) index: u32,
    along: Along,
}

/// What not every link has: a wall, rolling friction, a drag on rolling.
#[derive(Debug, Clone, Copy)]
pub(crate) struct More {
    /// Velocity of the wall, m/s; zero between particles.
    pub(crate) wall: DVec3,
    couple: DVec3,
    rolling: DVec3,
    rolling_limit: f64,
    rolling_inertia: f64,
    reduced: f64,
    coupled: Option<Coupled>,
}

/// All links of a list.
#[derive(Debug, Default)]
pub(crate) struct Links {
    /// What the impulses are still to be scaled by.
    pub(crate) share: f64,
    /// The first link with a wall.
    pub(crate) walls_from: usize,
    pub(crate) met: Vec<Met>,
    pub(crate) links: Vec<Link>,
    pub(crate) kept: Vec<Kept>,
    pub(crate) more: Vec<More>,
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

/// 1/m and 1/I of every class, and the classes of the slots.
#[derive(Clone, Copy)]
pub(crate) struct Inverse<'a> {
    pub(crate) classes: &'a [[f64; 2]],
    pub(crate) class: &'a [u16],
}

impl Inverse<'_> {
    /// Of all classes.
    pub(crate) fn of(classes: &[Class]) -> Vec<[f64; 2]> {
        classes.iter().map(|class| [1.0 / class.mass(), 1.0 / class.inertia()]).collect()
    }

    /// Of both bodies; a wall does not move.
    #[inline(always)]
    fn both(&self, [a, b]: [u32; 2]) -> [[f64; 2]; 2] {
        let one = |slot: u32| self.classes[usize::from(self.class[slot as usize])];
        [one(a), if a == b { [0.0; 2] } else { one(b) }]
    }
}

/// Velocity and spin of a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Body {
    pub(crate) v: DVec3,
    pub(crate) w: DVec3,
}

impl From<Velocity> for Body {
    fn from(velocity: Velocity) -> Self {
        Self { v: velocity.v.vector(), w: velocity.w.vector() }
    }
}

/// The bodies of a link.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Two {
    pub(crate) first: Body,
    pub(crate) second: Body,
}

impl Links {
    pub(crate) fn clear(&mut self) {
        self.links.clear();
        self.kept.clear();
        self.more.clear();
    }

    /// Makes a link of a pair that resists. `before` and `kicked` are the velocities before and after
    /// the kick, that of a wall in the second place.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "all that a link is made from")]
    pub(crate) fn add(
        &mut self,
        met: &Met,
        resist: &Resist,
        impulse: &Impulse,
        [before, kicked]: [&Two; 2],
        inverse: Inverse<'_>,
        [duration, drift]: [f64; 2],
        radii: [f64; 2],
    ) {
        let Met { slots, list, index, normal, levers, gap, rate, slip } = *met;
        let wall = slots[0] == slots[1];
        let [[mi, ti], [mj, tj]] = inverse.both(slots);
        let mobility = mi + mj;
        let v = kicked.first.v - kicked.second.v;
        let speed = -v.dot(normal);
        // The line of centres turns during the step: |d − h v| grows by v_t² h/(2 |d|).
        let sideways = (v.length_squared() - speed * speed).max(0.0);
        let turn = if wall { 0.0 } else { 0.5 * drift * sideways / (levers[0] + levers[1]) };
        let (along, linear, searched) =
            Along::new(resist, [gap, impulse.charged], [rate, turn, speed], duration, mobility);
        let across = mobility + levers[0] * levers[0] * ti + levers[1] * levers[1] * tj;
        let [a, b, d] = resist.across;
        let coupled = b != 0.0 || d != 0.0;
        let flat = |v: DVec3| v - v.dot(normal) * normal;
        let mut more = NOTHING_MORE;
        if wall || coupled || resist.rolling > 0.0 {
            more = self.more.len() as u32;
            let [r, q] = radii;
            let reduced = if wall { r } else { r * q / (r + q) };
            let mobility = [
                across,
                reduced * (levers[0] * ti - levers[1] * tj),
                reduced * reduced * (ti + tj),
            ];
            let turning = reduced * (before.first.w - before.second.w).cross(normal);
            let motion = Motion { slip, rolling: turning };
            self.more.push(More {
                wall: DVec3::ZERO,
                couple: flat(impulse.couple),
                rolling: flat(impulse.rolling),
                rolling_limit: duration * resist.rolling,
                rolling_inertia: 1.0 / (ti + tj),
                reduced,
                coupled: coupled.then(|| Coupled::new(resist.across, motion, duration, mobility)),
            });
        }
        self.links.push(Link {
            slots,
            more,
            searched,
            normal,
            levers,
            push: impulse.normal,
            // The plane across the line of centres has turned a little.
            shear: flat(impulse.shear),
            along: linear,
            slip: Slip::new(if coupled { 0.0 } else { a }, slip, duration, across),
        });
        self.kept.push(Kept { list, index, along });
    }

    /// Takes the velocities of the walls, by the index of the pair with one.
    pub(crate) fn meet_walls(&mut self, velocity: impl Fn(u32) -> DVec3) {
        for k in self.walls_from..self.links.len() {
            if let Some(more) = self.more.get_mut(self.links[k].more as usize) {
                more.wall = velocity(self.kept[k].index);
            }
        }
    }

    /// The wall's velocity, or none.
    #[inline(always)]
    pub(crate) fn wall(&self, link: &Link) -> DVec3 {
        self.more.get(link.more as usize).map_or(DVec3::ZERO, |more| more.wall)
    }

    /// The sums that scale a start, for the velocities after the kick; what the pair remembers is
    /// given to `pushed`.
    #[inline(always)]
    pub(crate) fn start(
        &self,
        k: usize,
        velocities: &Two,
        pushed: &mut Two,
        inverse: Inverse<'_>,
    ) -> [f64; 2] {
        let link = &self.links[k];
        let (speed, slip) = link.motion(velocities);
        let [a, b] = link.along.start(link.push, speed);
        let [c, d] = link.slip.start(link.shear, slip);
        link.give(pushed, link.push, link.shear, inverse);
        let turned = self.more.get(link.more as usize).map_or(0.0, |more| {
            let couple = more.reduced * link.normal.cross(more.couple) + more.rolling;
            link.turn(pushed, couple, inverse);
            couple.dot(velocities.first.w - velocities.second.w)
        });
        [a + c + turned, b + d]
    }

    /// Scales what all pairs remember; the impulses of most of them when they are next looked at.
    pub(crate) fn scale(&mut self, share: f64) {
        self.share = share;
        for more in &mut self.more {
            more.couple *= share;
            more.rolling *= share;
        }
    }

    /// One visit of a pass: changes the impulses so that they fit the velocities, and the velocities
    /// with them. `charge` gives the drag's impulse up to a gap, and the drag there.
    #[inline(always)]
    pub(crate) fn relax(
        &mut self,
        k: usize,
        two: &mut Two,
        inverse: Inverse<'_>,
        charge: impl FnOnce(&Kept, f64, f64) -> f64,
    ) -> Change {
        let link = &mut self.links[k];
        link.push *= self.share;
        link.shear *= self.share;
        let (speed, slip) = link.motion(two);
        let push = if link.searched {
            charge(&self.kept[k], speed, link.push)
        } else {
            link.along.fit(speed, link.push)
        };
        let mut shear = link.slip.change(slip, link.shear);
        if link.more != NOTHING_MORE {
            let more = &mut self.more[link.more as usize];
            shear += more.relax(link, two, slip, inverse);
        }
        let change = push - link.push;
        link.give(two, change, shear, inverse);
        link.push = push;
        link.shear += shear;
        Change { changed: change.abs() + shear.length(), all: push.abs() + link.shear.length() }
    }

    /// What is remembered of a link after the step `drift`.
    pub(crate) fn close(&self, k: usize, two: &Two, drift: f64) -> Impulse {
        let link = &self.links[k];
        let (speed, _) = link.motion(two);
        let more = self.more.get(link.more as usize);
        Impulse {
            charged: self.kept[k].along.charged(speed, drift),
            normal: link.push,
            shear: link.shear,
            couple: more.map_or(DVec3::ZERO, |more| more.couple),
            rolling: more.map_or(DVec3::ZERO, |more| more.rolling),
        }
    }
}

impl Kept {
    /// As [`Along::search`].
    pub(crate) fn search(&self, speed: f64, now: f64, charge: impl Fn(f64) -> [f64; 2]) -> f64 {
        self.along.search(speed, now, charge)
    }
}

impl Link {
    /// Speed of separation along the normal, and slip.
    #[inline(always)]
    fn motion(&self, two: &Two) -> (f64, DVec3) {
        let (p, q) = (&two.first, &two.second);
        let v = p.v - q.v;
        let along = v.dot(self.normal);
        let turning = (self.levers[0] * p.w + self.levers[1] * q.w).cross(self.normal);
        (-along, v - along * self.normal + turning)
    }

    /// Gives impulses to both bodies: one that drives them apart, one across on the first.
    #[inline(always)]
    fn give(&self, two: &mut Two, push: f64, shear: DVec3, inverse: Inverse<'_>) {
        let [[mi, ti], [mj, tj]] = inverse.both(self.slots);
        let force = shear - push * self.normal;
        let arm = self.normal.cross(shear);
        two.first.v += mi * force;
        two.second.v -= mj * force;
        two.first.w += ti * self.levers[0] * arm;
        two.second.w += tj * self.levers[1] * arm;
    }

    /// Turns both bodies against each other.
    fn turn(&self, two: &mut Two, couple: DVec3, inverse: Inverse<'_>) {
        let [[_, ti], [_, tj]] = inverse.both(self.slots);
        two.first.w += ti * couple;
        two.second.w -= tj * couple;
    }
}

impl More {
    /// Changes what is resisted beside the slip; returns what that changes in the shear impulse.
    fn relax(&mut self, link: &Link, two: &mut Two, slip: DVec3, inverse: Inverse<'_>) -> DVec3 {
        let mut shear = DVec3::ZERO;
        if let Some(coupled) = &self.coupled {
            let spin = two.first.w - two.second.w;
            let y = Motion { slip, rolling: self.reduced * spin.cross(link.normal) };
            let now = Motion { slip: link.shear, rolling: self.couple };
            let change = coupled.change(y, now);
            // The slip's own impulse has no slope then and would only fade.
            shear = change.slip + link.shear;
            self.couple += change.rolling;
            link.turn(two, self.reduced * link.normal.cross(change.rolling), inverse);
        }
        if self.rolling_limit > 0.0 {
            let spin = two.first.w - two.second.w;
            let rolling = spin - spin.dot(link.normal) * link.normal;
            let wanted = self.rolling - self.rolling_inertia * rolling;
            let change = wanted.clamp_length_max(self.rolling_limit) - self.rolling;
            self.rolling += change;
            link.turn(two, change, inverse);
        }
        shear
    }
}
