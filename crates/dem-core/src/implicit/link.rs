//! What is solved for in one pair whose motion is resisted, or in several side by side.

use super::normal::{Along, Fit, LINEAR, NEAR, Normal, STIFF, softness, weight};
use super::shear::Slip;
use super::{Inverse, Met};
use crate::chunk::Sum;
use crate::lane::{Lane, Vector};

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
    /// For a speed a of separation the drag is charged up to the gap `to` + `step` a.
    pub(super) to: L,
    pub(super) step: L,
    /// The fastest that the bodies may move along their line of centres for the pair to be linear:
    /// either way, and apart, to which the turning of that line adds.
    pub(super) room: L,
    pub(super) apart: L,
}

/// What only a pair needs that is not linear.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Path<L> {
    /// The gap up to which the drag has been charged, m.
    pub(super) charged: L,
    /// Its impulse up to there; not a number until the pair is searched for.
    pub(super) paid: L,
    /// The speed that was found.
    pub(super) found: L,
    /// The part of the gap's rate that the speed after the step is not, m/s.
    pub(super) before: L,
    pub(super) dashpot: L,
    pub(super) pull: L,
}

/// New links.
pub(super) struct New<L> {
    pub(super) link: Link<L>,
    pub(super) path: Path<L>,
    /// Which of them are not linear, one bit each.
    pub(super) searched: u32,
    /// Which resist rolling: they have more to them.
    pub(super) rolls: u32,
}

/// How much a further pass is to change impulses, and what they amount to, N s.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Change<L = f64> {
    pub(crate) changed: L,
    pub(crate) all: L,
}

impl Change {
    /// Whether further passes are to change less than the tolerance of the impulses. `last` is what the
    /// pass before the last was to change, not a number at first.
    pub(super) fn is_little(self, last: &mut f64, tolerance: f64) -> bool {
        let (before, now) = (std::mem::replace(last, self.changed), self.changed);
        // What the changes add up to if they go on falling as they fell.
        let rest = if now < before { now * now / (before - now) } else { now };
        rest <= tolerance * self.all
    }
}

impl<L: Lane> std::ops::Add for Change<L> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { changed: self.changed + other.changed, all: self.all + other.all }
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

impl<L: Lane> New<L> {
    /// Of pairs that resist, for impulses that act for `duration` s, before the positions move for
    /// `drift` s.
    #[inline(always)]
    pub(super) fn of(
        permit: L::Permit,
        met: &Met<'_, L>,
        inverse: Inverse<'_>,
        [duration, drift]: [f64; 2],
    ) -> Self {
        let Met { geometry, resist, remembered, .. } = met;
        let (zero, one) = (L::splat(permit, 0.0), L::splat(permit, 1.0));
        let (whole, any) = (L::splat(permit, duration), L::splat(permit, f64::INFINITY));
        let both = L::each(|k| inverse.both(met.slots[k]));
        let [mi, ti, mj, tj] = L::rows(permit, &both, |both| *both);
        let (mobility, levers, gap) = (mi + mj, geometry.levers, geometry.gap);
        let [a, b] = levers;
        let across = mobility + a * a * ti + b * b * tj;
        let (rate, normal) = (geometry.separation_speed, geometry.normal);

        let stiff = resist.drag + resist.dashpot;
        let theta = weight(whole * stiff * mobility);
        let (step, rest) = (theta * whole, (one - theta) * whole);
        // A bridge that is there from the start is charged from its gap on; one that forms later was
        // met somewhere on the way of the step before.
        let first = duration < geometry.time_step;
        let formed = if first { gap } else { gap - rest * rate };
        let charged = remembered.charged.if_less(any, remembered.charged, formed);
        // What the turning line of centres adds to the speed of separation: |d − h v| grows by
        // v_t² h/(2 |d|).
        let turn = L::splat(permit, 0.5 * drift) * met.sideways / (a + b);
        let slope = step * stiff;
        let along = Normal {
            offset: resist.drag * (gap - charged) + rest * resist.dashpot * rate + slope * turn,
            slope,
            answer: one / (one + slope * mobility),
        };

        let [slip, coupling, rolling] = resist.across;
        let coupled = coupling.most(-coupling) + rolling;
        let slip = zero.if_less(coupled, zero, slip);
        let theta_across = weight(whole * slip * across);
        let slope_across = theta_across * whole * slip;
        let slip = Slip {
            offset: geometry.slip * ((one - theta_across) * whole * slip),
            slope: slope_across,
            answer: one / (one + slope_across * across),
        };
        // The plane across the line of centres has turned a little.
        let shear = remembered.shear - normal * remembered.shear.dot(normal);
        let room = resist.clearance * L::splat(permit, LINEAR / duration);
        let room = zero.if_less(resist.drag, room, any);
        let cap =
            zero.if_less(resist.dashpot, resist.pull / (resist.dashpot + resist.dashpot), any);
        let link = Link {
            normal,
            levers,
            inverse: [[mi, ti], [mj, tj]],
            push: remembered.push,
            along,
            shear,
            slip,
            to: gap + step * turn,
            step,
            room,
            apart: room.least(cap) - turn,
        };
        let path = Path {
            charged,
            paid: L::splat(permit, f64::NAN),
            found: zero,
            before: (one - theta) * rate + theta * turn,
            dashpot: resist.dashpot,
            pull: resist.pull,
        };
        let rolls = zero.less_bits(coupled + resist.rolling);
        Self { link, path, searched: link.is_fast(rate), rolls }
    }
}

impl<L: Lane> Link<L> {
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
        self.apart.less_bits(speed) | self.room.less_bits(-speed)
    }

    /// Which pairs are so stiff that they are backward Euler's, one bit each.
    #[inline(always)]
    pub(super) fn is_stiff(&self) -> u32 {
        let [[mi, _], [mj, _]] = self.inverse;
        L::splat(self.push.permit(), STIFF).less_bits(self.along.slope * (mi + mj))
    }

    /// The two sums over pairs that scale a start, as far as no velocity after the kick goes into
    /// them: p offset/slope and p²/slope.
    #[inline(always)]
    pub(super) fn start(&self) -> [L; 2] {
        let soft = softness(self.along.slope);
        let soft_across = softness(self.slip.slope);
        [
            soft * self.push * self.along.offset + soft_across * self.shear.dot(self.slip.offset),
            soft * self.push * self.push + soft_across * self.shear.dot(self.shear),
        ]
    }

    /// What the impulses add to the momentum of both bodies and to their angular momentum.
    #[inline(always)]
    pub(super) fn momentum(&self) -> [Vector<L>; 3] {
        let arm = self.normal.cross(self.shear);
        let [a, b] = self.levers;
        [self.shear - self.normal * self.push, arm * a, arm * b]
    }

    /// Scales the impulses; those across are what `slip` resists.
    #[inline(always)]
    pub(super) fn scale(&mut self, share: f64) {
        let share = L::splat(self.push.permit(), share);
        self.push = self.push * share;
        self.shear = self.shear * share;
    }

    /// Changes the impulses, along the line of centres by `push` and across it by `shear`.
    #[inline(always)]
    pub(super) fn change(&mut self, two: &mut Two<L>, push: L, shear: Vector<L>) {
        self.give(two, push, shear);
        self.push = self.push + push;
        self.shear += shear;
    }

    /// What a further pass is to change after a change of the impulses, and what they amount to now.
    ///
    /// A change of an impulse goes over to the impulses of the pairs around it in the measure in which
    /// these take what moves them: their own share of that, k/(1/m* + k), stands for theirs.
    #[inline(always)]
    pub(super) fn amount(&self, push: L, shear: Vector<L>) -> Change<L> {
        let one = L::splat(push.permit(), 1.0);
        let taken = (one - self.along.answer) * size(push);
        let across = (one - self.slip.answer) * length(shear);
        Change { changed: taken + across, all: size(self.push) + length(self.shear) }
    }

    /// The gap up to which the drag is charged when the impulse along the line of centres is changed
    /// by `push` at this speed.
    #[inline(always)]
    pub(super) fn charge_to(&self, speed: L, push: L) -> L {
        let [[mi, _], [mj, _]] = self.inverse;
        self.to + self.step * (speed + push * (mi + mj))
    }
}

#[inline(always)]
fn size<L: Lane>(x: L) -> L {
    x.most(-x)
}

/// How large an impulse is, as the sum of its parts.
#[inline(always)]
fn length<L: Lane>(Vector { x, y, z }: Vector<L>) -> L {
    (size(x) + size(y)) + size(z)
}

/// Adds what impulses do to the bodies to their momenta, the first of which is that of slot `first`.
#[inline(always)]
pub(super) fn add_momentum(
    pushed: &mut [Sum],
    [a, b]: [u32; 2],
    first: u32,
    push: [f64; 4],
    turns: [[f64; 4]; 2],
) {
    let sum = &mut pushed[(a - first) as usize];
    sum.force.add(push);
    sum.torque.add(turns[0]);
    if a != b {
        let sum = &mut pushed[(b - first) as usize];
        sum.force.take(push);
        sum.torque.add(turns[1]);
    }
}

/// What the search for the impulse of one pair along its line of centres takes.
pub(super) struct Course {
    /// The impulse now.
    pub(super) push: f64,
    pub(super) along: Normal<f64>,
    pub(super) to: f64,
    pub(super) step: f64,
    pub(super) room: f64,
    /// 1/m_i + 1/m_j, 1/kg.
    pub(super) mobility: f64,
    pub(super) path: Path<f64>,
}

impl Link<f64> {
    #[inline(always)]
    pub(super) fn course(&self, path: &Path<f64>) -> Course {
        let Self { push, along, to, step, room, inverse: [[mi, _], [mj, _]], .. } = *self;
        Course { push, along, to, step, room, mobility: mi + mj, path: *path }
    }
}

impl Course {
    /// By how much the impulse has to change of a pair that is not linear; `charge` gives the drag's
    /// impulse up to a gap, and the drag there.
    ///
    /// What has been found stays in `along` and `path`, for visits that change little of it.
    #[inline(never)]
    pub(super) fn search(
        &mut self,
        speed: f64,
        duration: f64,
        charge: &dyn Fn(f64) -> [f64; 2],
    ) -> f64 {
        let Self { push, to, step, mobility, .. } = *self;
        let near = NEAR / LINEAR * self.room;
        let change = self.along.change(speed, push);
        let guess = speed + change * mobility;
        let first = self.path.paid.is_nan();
        if first {
            self.path.paid = charge(self.path.charged)[0];
        }
        let along = Along { to, step, duration, path: self.path, mobility, near };
        if !first && along.has_tangent(guess) {
            return change;
        }
        let Fit { speed: found, slope } = along.search(speed - push * mobility, guess, charge);
        let change = (found - speed) / mobility;
        let offset = -(push + change) - slope * found;
        self.along = Normal { offset, slope, answer: 1.0 / (1.0 + slope * mobility) };
        self.path.found = found;
        change
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::implicit::{Impulse, Remembered, Resist};
    use crate::pairs::Geometry;

    const MASS: f64 = 2e-4;

    /// A body that moves along x, and across it, before a wall that does not keep it from turning.
    fn pair(separation_speed: f64, sideways: f64, resist: &Resist, h: f64) -> New<f64> {
        let mut geometry = Geometry::<f64>::none(());
        geometry.normal.x = 1.0;
        geometry.separation_speed = separation_speed;
        geometry.levers = [1.0, 0.0];
        let met = Met::<f64> {
            slots: [[0, 0]],
            index: [0],
            geometry: &geometry,
            sideways,
            resist,
            remembered: &Remembered::pack((), |_| Impulse::NONE),
        };
        let inverse = Inverse { classes: &[[1.0 / MASS, 0.0]], class: &[0] };
        New::of((), &met, inverse, [h, h])
    }

    #[test]
    fn a_free_pair_decays_like_the_exponential() {
        let (drag, h) = (0.15, 1e-3);
        let resist = Resist { drag, clearance: f64::INFINITY, ..Resist::default() };
        let New { link, path, searched, rolls } = pair(0.7, 0.0, &resist, h);
        assert_eq!([searched, rolls], [0; 2]);
        let p = link.push + link.along.change(0.7, link.push);
        let left = 0.7 + p / MASS;
        assert!((left / (0.7 * (-drag * h / MASS).exp()) - 1.0).abs() < 1e-13);
        let found = link.course(&path).search(0.7, h, &|gap| [drag * gap, drag]);
        assert!((found / p - 1.0).abs() < 1e-12);
    }

    /// What counts is how fast the gap opens, to which the turning of the line of centres adds.
    #[test]
    fn a_pair_is_searched_for_where_turning_opens_its_gap_far() {
        let (h, clearance) = (1e-3, 1e-6);
        let resist = Resist { drag: 0.15, clearance, ..Resist::default() };
        // The gap opens by v² h²/2 where levers of 1 m turn.
        let opens = |gap: f64| pair(0.0, 2.0 * gap / (h * h), &resist, h);
        assert_eq!(opens(0.9 * LINEAR * clearance).searched, 0);
        assert_eq!(opens(1.1 * LINEAR * clearance).searched, 1);
    }
}
