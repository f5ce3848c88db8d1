//! Links that are solved for one at a time: with walls, across the borders of chunks, with more to
//! them than a drag along the line of centres and one across it, and what is left over.

use glam::DVec3;

use super::link::{Body, Change, Inverse, Link, Met, Two, middle};
use super::shear::{Coupled, Motion};
use super::{Impulse, Links, Resist};
use crate::chunk::List;
use crate::lane::{Lane, Vector};
use crate::pairs::Geometry;
use crate::particles::Velocity;
use crate::view::View;
use crate::{Pair, PairTerm};

/// Of a link that is nothing but its own record.
const NOTHING_MORE: u32 = u32::MAX;

/// As [`super::Charge`], of a link by itself.
pub(crate) type ChargeLoose<'a> = dyn Fn(&Loose, f64) -> [f64; 2] + 'a;

/// A link by itself.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Loose {
    pub(crate) slots: [u32; 2],
    pub(crate) list: List,
    pub(crate) index: u32,
    /// Where there is more to it, or [`NOTHING_MORE`].
    more: u32,
    /// Whether the impulse along the normal has to be searched for.
    searched: bool,
    link: Link<f64>,
}

/// What not every link has: a wall, rolling friction, a drag on rolling.
#[derive(Debug, Clone, Copy)]
pub(super) struct More {
    /// Velocity of the wall, m/s; zero between particles.
    wall: DVec3,
    couple: Vector<f64>,
    rolling: Vector<f64>,
    rolling_limit: f64,
    rolling_inertia: f64,
    reduced: f64,
    coupled: Option<Coupled>,
}

impl Links {
    /// Makes links by themselves of the pairs in `which`.
    #[inline(always)]
    pub(crate) fn add_loose<L: Lane>(
        &mut self,
        met: &Met<'_, L>,
        which: u32,
        inverse: Inverse<'_>,
        duration: f64,
    ) {
        for k in (0..L::WIDTH).filter(|k| which >> k & 1 == 1) {
            let resist = &met.resist;
            let [slip, coupling, rolling] = resist.across;
            let one = |lanes: L| lanes.unpack()[k];
            let single = Met {
                which: 1,
                slots: [met.slots[k]],
                list: met.list,
                index: [met.index[k]],
                geometry: &met.geometry.single(k),
                resist: Resist {
                    drag: one(resist.drag),
                    clearance: one(resist.clearance),
                    dashpot: one(resist.dashpot),
                    pull: one(resist.pull),
                    across: [one(slip), one(coupling), one(rolling)],
                    rolling: one(resist.rolling),
                },
                impulses: [met.impulses[k]],
            };
            self.add_one(&single, inverse, duration);
        }
    }

    /// Makes a link of a pair if anything resists in it.
    pub(crate) fn meet<T: PairTerm>(
        &mut self,
        view: &View<'_>,
        term: &T,
        pair: &Pair,
        slots: [u32; 2],
        (list, index): (List, u32),
        column: &mut T::Column,
    ) {
        let impulse = term.impulse(column).copied().unwrap_or_default();
        let geometry = Geometry::of(pair);
        let resist = term.resist(pair, column, middle(&[impulse], &geometry, view.kick()));
        let which = resist.any() & 1;
        if let (0, Some(own)) = (which, term.impulse(column)) {
            // Where nothing resists any more nothing is remembered either.
            *own = Impulse::NONE;
        }
        let met = Met::<f64> {
            which,
            slots: [slots],
            list,
            index: [index],
            geometry: &geometry,
            resist,
            impulses: [impulse],
        };
        let inverse = Inverse { classes: view.inverse, class: view.class };
        self.add_loose(&met, met.which, inverse, view.kick());
    }

    #[inline(never)]
    fn add_one(&mut self, met: &Met<'_, f64>, inverse: Inverse<'_>, duration: f64) {
        let (mut link, rolls) = Link::new((), met, inverse, duration);
        let [slots] = met.slots;
        let wall = slots[0] == slots[1];
        let mut more = NOTHING_MORE;
        if wall {
            // Its line of centres does not turn.
            link.turn = 0.0;
        }
        if wall || rolls != 0 {
            more = self.more.len() as u32;
            self.more.push(More::new(met, &link, duration));
        }
        let (list, index) = (met.list, met.index[0]);
        self.loose.push(Loose { slots, list, index, more, searched: false, link });
    }

    /// Takes the velocities of the walls, by the index of the pair with one.
    pub(crate) fn meet_walls(&mut self, velocity: impl Fn(u32) -> DVec3) {
        for loose in &self.loose {
            if let (List::Wall { .. }, Some(more)) =
                (loose.list, self.more.get_mut(loose.more as usize))
            {
                more.wall = velocity(loose.index);
            }
        }
    }

    /// The wall's velocity, or none.
    #[inline(always)]
    fn wall(&self, k: usize) -> DVec3 {
        self.more.get(self.loose[k].more as usize).map_or(DVec3::ZERO, |more| more.wall)
    }

    /// As [`Link::start`], of all of them; `first` is the slot of the first of the velocities.
    pub(crate) fn start_loose(
        &mut self,
        velocities: &[Velocity],
        pushed: &mut [Velocity],
        first: u32,
        drift: f64,
    ) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for k in 0..self.loose.len() {
            let wall = self.wall(k);
            let loose = &mut self.loose[k];
            let slots = loose.slots;
            let two = take(velocities, slots, first, wall);
            let mut push = take(pushed, slots, first, DVec3::ZERO);
            let [a, b] = loose.link.start(&two, &mut push, drift);
            let Loose { link, more, .. } = loose;
            let turned = self.more.get(*more as usize).map_or(0.0, |more| {
                let couple = link.normal.cross(more.couple) * more.reduced + more.rolling;
                turn(link, &mut push, couple);
                couple.dot(two.first.w - two.second.w)
            });
            put(pushed, slots, first, &push);
            sums = [sums[0] + a + turned, sums[1] + b];
        }
        sums
    }

    /// A pass over all of them; `charge` is asked for a link and a gap.
    pub(crate) fn pass_loose(
        &mut self,
        velocities: &mut [Velocity],
        first: u32,
        duration: f64,
        charge: &ChargeLoose<'_>,
        forward: bool,
    ) -> Change {
        let count = self.loose.len();
        let mut change = Change::default();
        for n in 0..count {
            let k = if forward { n } else { count - 1 - n };
            let mut two = take(velocities, self.loose[k].slots, first, self.wall(k));
            change = change + self.relax(k, &mut two, duration, charge);
            put(velocities, self.loose[k].slots, first, &two);
        }
        self.share = 1.0;
        change
    }

    /// One visit of a pass: changes the impulses so that they fit the velocities, and the velocities
    /// with them.
    #[inline(always)]
    fn relax(
        &mut self,
        k: usize,
        two: &mut Two<f64>,
        duration: f64,
        charge: &ChargeLoose<'_>,
    ) -> Change {
        let loose = &mut self.loose[k];
        loose.link.scale(self.share);
        let link = &loose.link;
        let (speed, slip) = link.motion(two);
        if !loose.searched && link.is_fast(speed) != 0 {
            loose.searched = true;
            loose.link.paid = charge(loose, loose.link.charged)[0];
        }
        let link = &loose.link;
        let push = if loose.searched {
            link.search(speed, duration, &|gap| charge(loose, gap))
        } else {
            link.along.fit(speed, link.push)
        };
        let mut shear = link.slip.change(slip, link.shear);
        let mut turned = Change::default();
        if let Some(more) = self.more.get_mut(loose.more as usize) {
            let (slipped, change) = more.relax(link, two, slip);
            (shear, turned) = (shear + slipped, change);
        }
        turned + loose.link.change(two, push, shear)
    }

    /// What all of them are to remember.
    pub(crate) fn close_loose(
        &self,
        velocities: &[Velocity],
        first: u32,
        duration: f64,
        mut remember: impl FnMut(&Loose, Impulse),
    ) {
        for (k, loose) in self.loose.iter().enumerate() {
            let two = take(velocities, loose.slots, first, self.wall(k));
            let link = &loose.link;
            let more = self.more.get(loose.more as usize);
            let none = Vector::zero(());
            let impulse = Impulse {
                charged: link.charge_to(&two, duration),
                normal: link.push,
                shear: link.shear.unpack()[0],
                couple: more.map_or(none, |more| more.couple).unpack()[0],
                rolling: more.map_or(none, |more| more.rolling).unpack()[0],
            };
            remember(loose, impulse);
        }
    }

    /// Scales what all pairs remember; the impulses of most of them when they are next looked at.
    pub(crate) fn scale(&mut self, share: f64) {
        self.share = share;
        for more in &mut self.more {
            more.couple = more.couple * share;
            more.rolling = more.rolling * share;
        }
    }
}

impl More {
    fn new(met: &Met<'_, f64>, link: &Link<f64>, duration: f64) -> Self {
        let (g, [impulse], resist) = (met.geometry, &met.impulses, &met.resist);
        let [[mi, ti], [mj, tj]] = link.inverse;
        let ([a, b], [r, q], normal) = (g.levers, g.radii, g.normal);
        let reduced = if q == f64::INFINITY { r } else { r * q / (r + q) };
        let [_, coupling, rolling] = resist.across;
        let coupled = (coupling != 0.0 || rolling != 0.0).then(|| {
            let both = reduced * (a * ti - b * tj);
            let across = mi + mj + a * a * ti + b * b * tj;
            let mobility = [across, both, reduced * reduced * (ti + tj)];
            let motion = Motion { slip: g.slip, rolling: g.spin.cross(normal) * reduced };
            Coupled::new(resist.across, motion, duration, mobility)
        });
        let flat = |v: DVec3| {
            let v = Vector { x: v.x, y: v.y, z: v.z };
            v - normal * v.dot(normal)
        };
        Self {
            wall: DVec3::ZERO,
            // What nothing resists any more has no impulse either.
            couple: if coupled.is_some() { flat(impulse.couple) } else { Vector::zero(()) },
            rolling: if resist.rolling > 0.0 { flat(impulse.rolling) } else { Vector::zero(()) },
            rolling_limit: duration * resist.rolling,
            rolling_inertia: 1.0 / (ti + tj),
            reduced,
            coupled,
        }
    }

    /// Changes what is resisted beside the slip; returns what that changes in the shear impulse, and
    /// what its own change amounts to.
    fn relax(
        &mut self,
        link: &Link<f64>,
        two: &mut Two<f64>,
        slip: Vector<f64>,
    ) -> (Vector<f64>, Change) {
        let length = |v: Vector<f64>| v.dot(v).sqrt();
        let (mut shear, mut amount) = (Vector::zero(()), Change::default());
        if let Some(coupled) = &self.coupled {
            let spin = two.first.w - two.second.w;
            let y = Motion { slip, rolling: spin.cross(link.normal) * self.reduced };
            let now = Motion { slip: link.shear, rolling: self.couple };
            let change = coupled.change(y, now);
            // The slip's own impulse has no slope then and would only fade.
            shear = change.slip + link.shear;
            self.couple += change.rolling;
            amount = Change { changed: length(change.rolling), all: length(self.couple) };
            turn(link, two, link.normal.cross(change.rolling) * self.reduced);
        }
        if self.rolling_limit > 0.0 {
            let spin = two.first.w - two.second.w;
            let rolling = spin - link.normal * spin.dot(link.normal);
            let wanted = self.rolling - rolling * self.rolling_inertia;
            // Without any motion the share is infinite: no bound.
            let share = (self.rolling_limit / length(wanted)).least(1.0);
            let change = wanted * share - self.rolling;
            self.rolling += change;
            turn(link, two, change);
            let (changed, all) = (length(change), length(self.rolling));
            let arm = 1.0 / self.reduced;
            amount = amount + Change { changed: changed * arm, all: all * arm };
        }
        (shear, amount)
    }
}

/// Turns both bodies against each other.
fn turn(link: &Link<f64>, two: &mut Two<f64>, couple: Vector<f64>) {
    let [[_, ti], [_, tj]] = link.inverse;
    two.first.w += couple * ti;
    two.second.w = two.second.w - couple * tj;
}

fn vector(v: DVec3) -> Vector<f64> {
    Vector { x: v.x, y: v.y, z: v.z }
}

/// The two bodies of a link, a wall in the place of the second where both slots are the same.
#[inline(always)]
fn take(velocities: &[Velocity], [a, b]: [u32; 2], first: u32, wall: DVec3) -> Two<f64> {
    let body = |slot: u32| {
        let velocity = &velocities[(slot - first) as usize];
        Body { v: vector(velocity.v.vector()), w: vector(velocity.w.vector()) }
    };
    let second = if a == b { Body { v: vector(wall), w: Vector::zero(()) } } else { body(b) };
    Two { first: body(a), second }
}

#[inline(always)]
fn put(velocities: &mut [Velocity], [a, b]: [u32; 2], first: u32, two: &Two<f64>) {
    let mut set = |slot: u32, body: &Body<f64>| {
        let single = |v: Vector<f64>| v.unpack()[0];
        velocities[(slot - first) as usize] = Velocity::new(single(body.v), single(body.w));
    };
    if a != b {
        set(b, &two.second);
    }
    set(a, &two.first);
}
