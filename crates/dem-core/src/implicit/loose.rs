//! Links that are solved for one at a time: with walls, across the borders of chunks, with more to
//! them than a drag along the line of centres and one across it, and what is left over.

use glam::{DVec3, Vec3};

use super::eight::EIGHT;
use super::link::{Body, Change, Link, New, Path, Two, add_momentum};
use super::shear::{Coupled, Motion};
use super::{Impulse, Inverse, Links, Memory, Met, Remembered, Resist, Visit};
use crate::chunk::{List, Sum};
use crate::lane::{Lane, Vector};
use crate::pairs::Geometry;
use crate::particles::Velocity;
use crate::view::View;
use crate::{Pair, PairTerm};

/// Of a link that is nothing but its own record.
const NOTHING_MORE: u32 = u32::MAX;

/// A link by itself.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Loose {
    pub(crate) slots: [u32; 2],
    pub(super) list: List,
    pub(super) index: u32,
    /// Where there is more to it, or [`NOTHING_MORE`].
    more: u32,
    /// Whether the impulse along the normal has to be searched for.
    searched: bool,
    /// Velocity of the wall, m/s; zero between particles.
    pub(super) wall: DVec3,
    pub(super) link: Link<f64>,
    path: Path<f64>,
}

/// What not every link has: rolling friction, a drag on rolling.
#[derive(Debug, Clone, Copy)]
pub(super) struct More {
    couple: Vector<f64>,
    rolling: Vector<f64>,
    rolling_limit: f64,
    rolling_inertia: f64,
    reduced: f64,
    coupled: Option<Coupled>,
}

impl Links {
    /// Makes links by themselves of those pairs in `which`. Returns those that have more to them, which
    /// are left out.
    #[inline(always)]
    pub(crate) fn add_loose<L: Lane>(
        &mut self,
        permit: L::Permit,
        met: &Met<'_, L>,
        which: u32,
        list: List,
        inverse: Inverse<'_>,
        times: [f64; 2],
    ) -> u32 {
        let New { link, path, searched, rolls } = New::of(permit, met, inverse, times);
        self.stiff |= link.is_stiff() & which != 0;
        let at = self.make_room();
        let (eight, paths) = (&mut self.all_eights[at / EIGHT], &mut self.all_paths[at / EIGHT]);
        // They are taken apart where the next eight will be.
        let at = at % EIGHT;
        eight.store(at, &link);
        paths.store(at, &path);
        for k in (0..L::WIDTH).filter(|k| (which & !rolls) >> k & 1 == 1) {
            self.loose.push(Loose {
                slots: met.slots[k],
                list,
                index: met.index[k],
                more: NOTHING_MORE,
                searched: searched >> k & 1 == 1,
                wall: DVec3::ZERO,
                link: eight.load::<f64>((), at + k),
                path: paths.one(at + k),
            });
        }
        which & rolls
    }

    /// Makes a link by itself of pair `k`, whatever there is to it.
    #[inline(never)]
    pub(crate) fn add_single<L: Lane>(
        &mut self,
        met: &Met<'_, L>,
        (k, impulse): (usize, Impulse),
        list: List,
        inverse: Inverse<'_>,
        times: [f64; 2],
    ) {
        let resist = met.resist;
        let [slip, coupling, rolling] = resist.across;
        let one = |lanes: L| lanes.unpack()[k];
        let single = Met {
            slots: [met.slots[k]],
            index: [met.index[k]],
            geometry: &met.geometry.single(k),
            sideways: one(met.sideways),
            resist: &Resist {
                drag: one(resist.drag),
                clearance: one(resist.clearance),
                dashpot: one(resist.dashpot),
                pull: one(resist.pull),
                across: [one(slip), one(coupling), one(rolling)],
                rolling: one(resist.rolling),
            },
            remembered: &met.remembered.single(k),
        };
        self.add_one(&single, list, &impulse, inverse, times);
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
        let remembered = &Remembered::pack((), |_| impulse);
        let resist = &term.resist(pair, column, remembered.middle(&geometry, view.kick()));
        if resist.any() & 1 == 0 {
            if let Some(own) = term.impulse(column) {
                // Where nothing resists any more nothing is remembered either.
                *own = Impulse::NONE;
            }
            return;
        }
        let sideways = view.sideways::<f64>((), &[slots], geometry.separation_speed);
        let (slots, index) = ([slots], [index]);
        let met = Met::<f64> { slots, index, geometry: &geometry, sideways, resist, remembered };
        let inverse = Inverse { classes: view.inverse, class: view.class };
        self.add_one(&met, list, &impulse, inverse, view.kick_and_drift());
    }

    #[inline(never)]
    fn add_one(
        &mut self,
        met: &Met<'_, f64>,
        list: List,
        impulse: &Impulse,
        inverse: Inverse<'_>,
        times: [f64; 2],
    ) {
        let New { link, path, searched, rolls } = New::of((), met, inverse, times);
        let ([slots], [index]) = (met.slots, met.index);
        let mut more = NOTHING_MORE;
        if rolls != 0 {
            more = self.more.len() as u32;
            self.more.push(More::new(met, impulse, &link, times[0]));
        }
        let searched = searched != 0;
        self.stiff |= link.is_stiff() != 0;
        let wall = DVec3::ZERO;
        self.loose.push(Loose { slots, list, index, more, searched, wall, link, path });
    }

    /// Takes the velocities of the walls, by the index of the pair with one.
    pub(crate) fn meet_walls(&mut self, velocity: impl Fn(u32) -> DVec3) {
        for loose in &mut self.loose {
            if let List::Wall { .. } = loose.list {
                loose.wall = velocity(loose.index);
            }
        }
    }

    /// Adds what the impulses that they remember do to `pushed`, whose first is that of slot
    /// `first`; returns the sums that scale a start, of these pairs alone.
    pub(crate) fn start_loose(&self, pushed: &mut [Sum], first: u32) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for Loose { slots, more, wall, link, .. } in &self.loose {
            let [own, below] = link.start();
            let [push, mut a, mut b] = link.momentum();
            if let Some(more) = self.more.get(*more as usize) {
                let couple = link.normal.cross(more.couple) * more.reduced + more.rolling;
                (a, b) = (a + couple, b - couple);
            }
            let own = own - push.dot(vector(*wall));
            sums = [sums[0] + own, sums[1] + below];
            let ([push], [a], [b]) = (push.rows(()), a.rows(()), b.rows(()));
            add_momentum(pushed, *slots, first, push, [a, b]);
        }
        sums
    }

    /// A visit of all of them, as [`Links::pass_eights`].
    pub(crate) fn pass_loose(
        &mut self,
        velocities: &mut [Velocity],
        first: u32,
        visit: Visit,
        memory: &mut dyn Memory,
    ) -> bool {
        let count = self.loose.len();
        let mut change = Change::default();
        for n in 0..count {
            let k = if visit.forward { n } else { count - 1 - n };
            let mut two = take(velocities, self.loose[k].slots, first, self.loose[k].wall);
            change = change + self.relax(k, &mut two, visit, memory);
            put(velocities, self.loose[k].slots, first, &two);
        }
        visit.forward || change.is_little(&mut self.last_loose, visit.tolerance)
    }

    /// One visit of a pass: changes the impulses so that they fit the velocities, and the velocities
    /// with them.
    #[inline(always)]
    fn relax(
        &mut self,
        k: usize,
        two: &mut Two<f64>,
        visit: Visit,
        memory: &mut dyn Memory,
    ) -> Change {
        let Loose { list, index, more, searched, link, path, .. } = &mut self.loose[k];
        link.scale(visit.share);
        let (speed, slip) = link.motion(two);
        *searched |= link.is_fast(speed) != 0;
        let push = if *searched {
            let charge = |gap: f64| memory.charge(*list, *index, gap);
            let mut course = link.course(path);
            let change = course.search(speed, visit.duration, &charge);
            (link.along, *path) = (course.along, course.path);
            change
        } else {
            link.along.change(speed, link.push)
        };
        let mut shear = link.slip.change(slip, link.shear);
        let mut change = Change::default();
        let mut more = self.more.get_mut(*more as usize);
        if let Some(more) = &mut more {
            more.scale(visit.share);
            let (slipped, turned) = more.relax(link, two, slip);
            (shear, change) = (shear + slipped, turned);
        }
        link.change(two, push, shear);
        if visit.forward {
            return change;
        }
        if let Some(own) = memory.impulse(*list, *index) {
            own.charged = link.charge_to(speed, push);
            own.normal = link.push as f32;
            own.shear = single(link.shear);
            let none = Vec3::ZERO;
            (own.couple, own.rolling) =
                more.map_or((none, none), |more| (single(more.couple), single(more.rolling)));
        }
        change + link.amount(push, shear)
    }
}

impl More {
    /// Scales what it remembers.
    fn scale(&mut self, share: f64) {
        self.couple = self.couple * share;
        self.rolling = self.rolling * share;
    }

    fn new(met: &Met<'_, f64>, impulse: &Impulse, link: &Link<f64>, duration: f64) -> Self {
        let (g, resist) = (met.geometry, met.resist);
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
        let flat = |v: Vec3| {
            let v = vector(v.as_dvec3());
            v - normal * v.dot(normal)
        };
        Self {
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
            let changed = length(change.slip) + length(change.rolling);
            amount = Change { changed, all: length(self.couple) };
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

fn single(v: Vector<f64>) -> Vec3 {
    Vec3::new(v.x as f32, v.y as f32, v.z as f32)
}

fn vector(v: DVec3) -> Vector<f64> {
    Vector { x: v.x, y: v.y, z: v.z }
}

/// The two bodies of a link, a wall in the place of the second where both slots are the same.
#[inline(always)]
pub(super) fn take(velocities: &[Velocity], [a, b]: [u32; 2], first: u32, wall: DVec3) -> Two<f64> {
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
