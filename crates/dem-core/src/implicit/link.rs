//! What is solved for in one pair whose motion is resisted, or in several side by side.

use super::normal::{Along, LINEAR, Normal, STEP, weight};
use super::shear::Slip;
use super::{Impulse, Resist};
use crate::chunk::List;
use crate::lane::{Lane, Vector};
use crate::pairs::Geometry;
use crate::particles::Class;

/// Pairs as they were read, side by side.
pub(crate) struct Met<'a, L: Lane> {
    /// One bit for each pair that becomes a link.
    pub(crate) which: u32,
    /// Slots of the bodies; the second is that of the first again at a wall.
    pub(crate) slots: L::Each<[u32; 2]>,
    /// Where the pairs' columns stand.
    pub(crate) list: List,
    pub(crate) index: L::Each<u32>,
    pub(crate) geometry: &'a Geometry<L>,
    pub(crate) resist: Resist<L>,
    pub(crate) impulses: L::Each<Impulse>,
}

/// The middle of what the gaps are expected to be charged for in this step.
#[inline(always)]
pub(crate) fn middle<L: Lane>(
    impulses: &L::Each<Impulse>,
    geometry: &Geometry<L>,
    duration: f64,
) -> L {
    let permit = geometry.gap.permit();
    let charged = L::pack(permit, impulses, |impulse| impulse.charged);
    let charged = charged.if_less(L::splat(permit, f64::INFINITY), charged, geometry.gap);
    charged + L::splat(permit, 0.5 * duration) * geometry.separation_speed
}

/// The impulses between two bodies, and what decides them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Link<L> {
    pub(super) normal: Vector<L>,
    pub(super) levers: [L; 2],
    /// 1/m and 1/I of both bodies; a wall does not move.
    pub(super) inverse: [[L; 2]; 2],
    pub(super) push: L,
    pub(super) along: Normal<L>,
    pub(super) shear: Vector<L>,
    pub(super) slip: Slip<L>,
    /// What the turning line of centres adds to the speed of separation, m/s. Until the start it is
    /// that over h v_t²: |d − h v| grows by v_t² h/(2 |d|).
    pub(super) turn: L,
    pub(super) gap: L,
    /// Of the velocity after the step.
    pub(super) weight: L,
    /// The gap up to which the drag has been charged, m.
    pub(super) charged: L,
    /// Its impulse up to there; known where it is to be searched for.
    pub(super) paid: L,
    pub(super) rate: L,
    /// The fastest that the bodies may move along their line of centres for the pair to be linear.
    pub(super) room: L,
    pub(super) mobility: L,
    pub(super) dashpot: L,
    pub(super) pull: L,
}

/// What a change of impulses amounts to, N s.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Change<L = f64> {
    pub(crate) changed: L,
    pub(crate) all: L,
}

impl<L: Lane> std::ops::Add for Change<L> {
    type Output = Self;

    #[inline(always)]
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
    fn both(&self, [a, b]: [u32; 2]) -> [f64; 4] {
        let one = |slot: u32| self.classes[usize::from(self.class[slot as usize])];
        let ([m, t], [n, u]) = (one(a), if a == b { [0.0; 2] } else { one(b) });
        [m, t, n, u]
    }
}

/// Velocity and spin of a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Body<L> {
    pub(crate) v: Vector<L>,
    pub(crate) w: Vector<L>,
}

/// The bodies of a link.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Two<L> {
    pub(crate) first: Body<L>,
    pub(crate) second: Body<L>,
}

impl<L: Lane> Link<L> {
    /// Of pairs that resist, for impulses that act for `duration` s. Returns too which of them resist
    /// rolling, one bit each: they have more to them.
    #[inline(always)]
    pub(super) fn new(
        permit: L::Permit,
        met: &Met<'_, L>,
        inverse: Inverse<'_>,
        duration: f64,
    ) -> (Self, u32) {
        let Met { geometry, resist, impulses, .. } = met;
        let (zero, one) = (L::splat(permit, 0.0), L::splat(permit, 1.0));
        let (step, any) = (L::splat(permit, duration), L::splat(permit, f64::INFINITY));
        let both = L::each(|k| inverse.both(met.slots[k]));
        let [mi, ti, mj, tj] = L::rows(permit, &both, |both| *both);
        let (mobility, levers, gap) = (mi + mj, geometry.levers, geometry.gap);
        let [a, b] = levers;
        let across = mobility + a * a * ti + b * b * tj;
        let (rate, normal) = (geometry.separation_speed, geometry.normal);

        let stiff = resist.drag + resist.dashpot;
        let theta = weight(step * stiff * mobility);
        let before = (one - theta) * step;
        let [x, y, z, push] =
            L::rows(permit, impulses, |i| [i.shear.x, i.shear.y, i.shear.z, i.normal]);
        let charged = L::pack(permit, impulses, |impulse| impulse.charged);
        // A bridge that is there from the start is charged from its gap on; one that forms later was
        // met somewhere on the way of the step before.
        let first = duration < geometry.time_step;
        let formed = if first { gap } else { gap - before * rate };
        let charged = charged.if_less(any, charged, formed);
        let slope = theta * step * stiff;
        let along = Normal {
            offset: resist.drag * (gap - charged) + before * resist.dashpot * rate,
            slope,
            answer: one / (one + slope * mobility),
        };

        let [slip, coupling, rolling] = resist.across;
        let coupled = coupling.most(-coupling) + rolling;
        let slip = zero.if_less(coupled, zero, slip);
        let theta_across = weight(step * slip * across);
        let slope_across = theta_across * step * slip;
        let slip = Slip {
            offset: geometry.slip * ((one - theta_across) * step * slip),
            slope: slope_across,
            answer: one / (one + slope_across * across),
        };
        // The plane across the line of centres has turned a little.
        let shear = Vector { x, y, z };
        let shear = shear - normal * shear.dot(normal);
        let room = resist.clearance * L::splat(permit, LINEAR / duration);
        let link = Self {
            normal,
            levers,
            inverse: [[mi, ti], [mj, tj]],
            push,
            along,
            shear,
            slip,
            turn: L::splat(permit, 0.5) / (a + b),
            gap,
            weight: theta,
            charged,
            paid: zero,
            rate,
            room: zero.if_less(resist.drag, room, any),
            mobility,
            dashpot: resist.dashpot,
            pull: resist.pull,
        };
        (link, zero.less_bits(coupled + resist.rolling))
    }

    /// Speed of separation along the normal, and slip.
    #[inline(always)]
    pub(super) fn motion(&self, two: &Two<L>) -> (L, Vector<L>) {
        let (p, q, [a, b]) = (&two.first, &two.second, self.levers);
        let v = p.v - q.v;
        let along = v.dot(self.normal);
        let turning = (p.w * a + q.w * b).cross(self.normal);
        (-along, v - self.normal * along + turning)
    }

    /// Gives impulses to both bodies: one that drives them apart, one across on the first.
    #[inline(always)]
    pub(super) fn give(&self, two: &mut Two<L>, push: L, shear: Vector<L>) {
        let ([[mi, ti], [mj, tj]], [a, b]) = (self.inverse, self.levers);
        let force = shear - self.normal * push;
        let arm = self.normal.cross(shear);
        two.first.v += force * mi;
        two.second.v = two.second.v - force * mj;
        two.first.w += arm * (ti * a);
        two.second.w += arm * (tj * b);
    }

    /// Which pairs move so fast that they have to be searched for, one bit each.
    #[inline(always)]
    pub(super) fn is_fast(&self, speed: L) -> u32 {
        let permit = speed.permit();
        let (rate, after) = (self.rate, speed + self.turn);
        let fastest = rate.most(-rate).most(after.most(-after));
        let pulled = self.dashpot * rate.most(after);
        let bound = self.pull * L::splat(permit, 0.5);
        self.room.less_bits(fastest)
            | bound.less_bits(pulled) & L::splat(permit, 0.0).less_bits(self.dashpot)
    }

    /// The sums that scale a start, for the velocities after the kick; what the pair remembers is
    /// given to `pushed`. Settles too how far the line of centres turns in the `drift`.
    #[inline(always)]
    pub(super) fn start(&mut self, two: &Two<L>, pushed: &mut Two<L>, drift: f64) -> [L; 2] {
        let (speed, slip) = self.motion(two);
        let permit = speed.permit();
        let (zero, v) = (L::splat(permit, 0.0), two.first.v - two.second.v);
        let sideways = (v.dot(v) - speed * speed).most(zero);
        self.turn = self.turn * (L::splat(permit, drift) * sideways);
        self.along.offset = self.along.offset + self.along.slope * self.turn;
        let [a, b] = self.along.start(self.push, speed);
        let [c, d] = self.slip.start(self.shear, slip);
        self.give(pushed, self.push, self.shear);
        [a + c, b + d]
    }

    /// Scales the impulses; those across are what `slip` resists.
    #[inline(always)]
    pub(super) fn scale(&mut self, share: f64) {
        let share = L::splat(self.push.permit(), share);
        self.push = self.push * share;
        self.shear = self.shear * share;
    }

    /// Changes the impulses to `push` along the line of centres and by `shear` across it.
    #[inline(always)]
    pub(super) fn change(&mut self, two: &mut Two<L>, push: L, shear: Vector<L>) -> Change<L> {
        let change = push - self.push;
        self.give(two, change, shear);
        self.push = push;
        self.shear += shear;
        Change {
            changed: change.most(-change) + shear.dot(shear).sqrt(),
            all: push.most(-push) + self.shear.dot(self.shear).sqrt(),
        }
    }

    /// How far the gap is charged for after impulses that acted for `duration` s.
    #[inline(always)]
    pub(super) fn charge_to(&self, two: &Two<L>, duration: f64) -> L {
        let (speed, _) = self.motion(two);
        self.gap + self.weight * L::splat(speed.permit(), duration) * (speed + self.turn)
    }
}

impl Link<f64> {
    /// The impulse along the line of centres of a pair that has to be searched for; `charge` gives
    /// the drag's impulse up to a gap, and the drag there.
    #[inline(never)]
    pub(super) fn search(
        &self,
        speed: f64,
        duration: f64,
        charge: &dyn Fn(f64) -> [f64; 2],
    ) -> f64 {
        let Self { gap, paid, rate, turn, weight, mobility, dashpot, pull, room, .. } = *self;
        let along = Along { gap, paid, rate, turn, weight, duration, dashpot, pull, mobility };
        along.search(speed, self.push, STEP / LINEAR * room, charge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_free_pair_decays_like_the_exponential() {
        let (drag, h, mass) = (0.15, 1e-3, 2e-4);
        let mut geometry = Geometry::<f64>::none(());
        geometry.normal.x = 1.0;
        geometry.separation_speed = 0.7;
        geometry.levers = [1.0, 0.0];
        let met = Met::<f64> {
            which: 1,
            slots: [[0, 0]],
            list: List::Inside,
            index: [0],
            geometry: &geometry,
            resist: Resist { drag, clearance: f64::INFINITY, ..Resist::default() },
            impulses: [Impulse::NONE],
        };
        let inverse = Inverse { classes: &[[1.0 / mass, 0.0]], class: &[0] };
        let (link, more) = Link::new((), &met, inverse, h);
        assert_eq!(more, 0);
        let p = link.along.fit(0.7, link.push);
        let left = 0.7 + p / mass;
        assert!((left / (0.7 * (-drag * h / mass).exp()) - 1.0).abs() < 1e-13);
        let charged = Link { turn: 0.0, paid: drag * link.charged, ..link };
        let found = charged.search(0.7, h, &|gap| [drag * gap, drag]);
        assert!((found / p - 1.0).abs() < 1e-12);
    }
}
