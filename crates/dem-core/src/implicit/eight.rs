//! Links inside a chunk, eight side by side: pairs of which no two have a body in common, so that
//! all can be solved for at once.

use glam::Vec3;

use super::link::{Body, Change, Course, Link, New, Two, add_momentum};
use super::normal::Normal;
use super::paths::Paths;
use super::shear::Slip;
use super::{Colours, Inverse, Links, Memory, Met};
use crate::chunk::{List, Sum};
use crate::lane::{Kernel, Lane, Vector, in_widest};
use crate::particles::{Row, Velocity};
use crate::view::motion;

/// How many lie side by side.
pub(crate) const EIGHT: usize = 8;
/// Eights whose impulses are looked at together to see whether the passes may end. They lie near each
/// other: what goes on elsewhere does not hide what is to change among them.
const GROUP: usize = Colours::WINDOW / EIGHT;
// Where some of the numbers are; a vector takes three places.
const PUSH: usize = 9;
const SHEAR: usize = 13;
/// Numbers of a [`Link`].
const NUMBERS: usize = 25;

/// Eight links.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Eight {
    numbers: [[f64; EIGHT]; NUMBERS],
    pub(super) slots: [[u32; 2]; EIGHT],
    pub(super) index: [u32; EIGHT],
    /// Which of them are there, one bit each.
    pub(super) which: u32,
    /// Which have to be searched for.
    searched: u32,
}

impl Eight {
    const NONE: Self = Self {
        numbers: [[0.0; EIGHT]; NUMBERS],
        slots: [[0; 2]; EIGHT],
        index: [0; EIGHT],
        which: 0,
        searched: 0,
    };

    /// Reads the links from lane `at` on.
    #[inline(always)]
    pub(super) fn load<L: Lane>(&self, permit: L::Permit, at: usize) -> Link<L> {
        Link {
            normal: self.vector(permit, at, 0),
            levers: [self.number(permit, at, 3), self.number(permit, at, 4)],
            inverse: [
                [self.number(permit, at, 5), self.number(permit, at, 6)],
                [self.number(permit, at, 7), self.number(permit, at, 8)],
            ],
            push: self.number(permit, at, PUSH),
            along: Normal {
                offset: self.number(permit, at, 10),
                slope: self.number(permit, at, 11),
                answer: self.number(permit, at, 12),
            },
            shear: self.vector(permit, at, SHEAR),
            slip: Slip {
                slope: self.number(permit, at, 16),
                answer: self.number(permit, at, 17),
                offset: self.vector(permit, at, 18),
            },
            to: self.number(permit, at, 21),
            step: self.number(permit, at, 22),
            room: self.number(permit, at, 23),
            apart: self.number(permit, at, 24),
        }
    }

    #[inline(always)]
    fn number<L: Lane>(&self, permit: L::Permit, at: usize, n: usize) -> L {
        number(permit, &self.numbers[n], at)
    }

    #[inline(always)]
    fn vector<L: Lane>(&self, permit: L::Permit, at: usize, n: usize) -> Vector<L> {
        Vector {
            x: self.number(permit, at, n),
            y: self.number(permit, at, n + 1),
            z: self.number(permit, at, n + 2),
        }
    }

    #[inline(always)]
    fn set<L: Lane>(&mut self, at: usize, n: usize, value: L) {
        set(&mut self.numbers[n], at, value);
    }

    #[inline(always)]
    fn set_impulses<L: Lane>(&mut self, at: usize, link: &Link<L>) {
        self.set(at, PUSH, link.push);
        self.set(at, SHEAR, link.shear.x);
        self.set(at, SHEAR + 1, link.shear.y);
        self.set(at, SHEAR + 2, link.shear.z);
    }

    #[inline(always)]
    fn set_along<L: Lane>(&mut self, at: usize, along: &Normal<L>) {
        let Normal { offset, slope, answer } = *along;
        self.set(at, 10, offset);
        self.set(at, 11, slope);
        self.set(at, 12, answer);
    }

    #[inline(always)]
    pub(super) fn store<L: Lane>(&mut self, at: usize, link: &Link<L>) {
        let Link { normal, levers, inverse, slip, .. } = *link;
        self.set_impulses(at, link);
        self.set_along(at, &link.along);
        for (n, number) in [(0, normal.x), (1, normal.y), (2, normal.z)] {
            self.set(at, n, number);
        }
        for (n, number) in [(3, levers[0]), (4, levers[1]), (5, inverse[0][0])] {
            self.set(at, n, number);
        }
        for (n, number) in [(6, inverse[0][1]), (7, inverse[1][0]), (8, inverse[1][1])] {
            self.set(at, n, number);
        }
        for (n, number) in [(16, slip.slope), (17, slip.answer), (18, slip.offset.x)] {
            self.set(at, n, number);
        }
        for (n, number) in [(19, slip.offset.y), (20, slip.offset.z), (21, link.to)] {
            self.set(at, n, number);
        }
        for (n, number) in [(22, link.step), (23, link.room), (24, link.apart)] {
            self.set(at, n, number);
        }
    }

    /// What a search for the impulse of link `k` takes.
    #[inline(always)]
    fn course(&self, paths: &Paths, k: usize, share: f64) -> Course {
        let number = |n: usize| self.numbers[n][k];
        Course {
            push: share * number(PUSH),
            along: Normal { offset: number(10), slope: number(11), answer: number(12) },
            to: number(21),
            step: number(22),
            room: number(23),
            mobility: number(5) + number(7),
            path: paths.one(k),
        }
    }

    /// What those that are there are to remember, charged up to these gaps.
    fn remember(&self, charged: &[f64; EIGHT], memory: &mut dyn Memory) {
        for k in (0..EIGHT).filter(|k| self.which >> k & 1 == 1) {
            let Some(own) = memory.impulse(List::Inside, self.index[k]) else { continue };
            // Field by field: to write a whole one somewhere else first would take longer.
            own.charged = charged[k];
            own.normal = self.numbers[PUSH][k] as f32;
            own.shear.x = self.numbers[SHEAR][k] as f32;
            own.shear.y = self.numbers[SHEAR + 1][k] as f32;
            own.shear.z = self.numbers[SHEAR + 2][k] as f32;
            (own.couple, own.rolling) = (Vec3::ZERO, Vec3::ZERO);
        }
    }
}

#[inline(always)]
fn number<L: Lane>(permit: L::Permit, all: &[f64; EIGHT], at: usize) -> L {
    L::pack(permit, &L::each(|k| all[at + k]), |one| *one)
}

#[inline(always)]
pub(super) fn set<L: Lane>(all: &mut [f64; EIGHT], at: usize, value: L) {
    let value = value.unpack();
    for k in 0..L::WIDTH {
        all[at + k] = value[k];
    }
}

impl Links {
    /// The first place among eights that is not taken.
    #[inline(always)]
    pub(super) fn make_room(&mut self) -> usize {
        if self.taken / EIGHT == self.all_eights.len() {
            self.all_eights.push(Eight::NONE);
            self.all_paths.push(Paths::NONE);
        }
        self.taken
    }

    /// Makes links of pairs of which no two have a body in common, those in `which`, and adds what
    /// the impulses that they remember do to `pushed`, whose first is that of slot `first`. Returns
    /// those that have more to them, which are left out; their places stay empty.
    #[inline(always)]
    pub(crate) fn add<L: Lane>(
        &mut self,
        permit: L::Permit,
        met: &Met<'_, L>,
        which: u32,
        inverse: Inverse<'_>,
        times: [f64; 2],
        (pushed, first): (&mut [Sum], u32),
    ) -> u32 {
        let New { link, path, searched, rolls } = New::of(permit, met, inverse, times);
        let at = self.make_room();
        let (last, at) = (at / EIGHT, at % EIGHT);
        self.taken += L::WIDTH;
        let (eight, paths) = (&mut self.all_eights[last], &mut self.all_paths[last]);
        if at == 0 {
            (eight.which, eight.searched) = (0, 0);
        }
        eight.store(at, &link);
        paths.store(at, &path);
        let all = (1 << L::WIDTH) - 1;
        let here = which & !rolls & all;
        for k in 0..L::WIDTH {
            (eight.slots[at + k], eight.index[at + k]) = (met.slots[k], met.index[k]);
        }
        eight.which |= here << at;
        eight.searched |= (searched & here) << at;
        self.stiff |= link.is_stiff() & here != 0;
        let mut sums = link.start();
        let [push, a, b] = link.momentum();
        let (push, turns) = (push.rows(permit), [a.rows(permit), b.rows(permit)]);
        if here != all {
            // Few are so.
            let mut each = [sums[0].unpack(), sums[1].unpack()];
            for k in (0..L::WIDTH).filter(|k| here >> k & 1 == 0) {
                eight.numbers.iter_mut().for_each(|all| all[at + k] = 0.0);
                (each[0][k], each[1][k]) = (0.0, 0.0);
            }
            sums = [L::pack(permit, &each[0], |one| *one), L::pack(permit, &each[1], |one| *one)];
        }
        for k in 0..L::WIDTH {
            if here >> k & 1 == 1 {
                add_momentum(pushed, met.slots[k], first, push[k], [turns[0][k], turns[1][k]]);
            }
        }
        add_up::<L>(permit, &mut self.start, at, sums);
        which & rolls
    }

    /// A visit of each of the links that lie side by side. On the way back their impulses are written
    /// to `memory`; returns whether further passes are to change little of them then.
    pub(crate) fn pass_eights(
        &mut self,
        velocities: &mut [Velocity],
        first: u32,
        visit: Visit,
        memory: &mut dyn Memory,
    ) -> bool {
        let count = self.taken.div_ceil(EIGHT);
        self.last.resize(count.div_ceil(GROUP), f64::NAN);
        let mut settled = true;
        let groups = self.last.len();
        for n in 0..groups {
            let n = if visit.forward { n } else { groups - 1 - n };
            let which = n * GROUP..count.min((n + 1) * GROUP);
            let mut sums = [[0.0; EIGHT]; 2];
            let (eights, paths) = (&mut self.all_eights[which.clone()], &mut self.all_paths[which]);
            let memory = &mut *memory;
            in_widest(Work { visit, eights, paths, velocities, first, memory, sums: &mut sums });
            let [changed, all] = sums.map(|lanes| lanes.iter().sum());
            let change = Change { changed, all };
            settled &= visit.forward || change.is_little(&mut self.last[n], visit.tolerance);
        }
        settled
    }
}

/// How links are visited.
#[derive(Clone, Copy)]
pub(crate) struct Visit {
    /// Duration of the impulses, s.
    pub(crate) duration: f64,
    /// By how much their impulses are scaled before it.
    pub(crate) share: f64,
    pub(crate) forward: bool,
    /// The share of the impulses that may be left to change.
    pub(crate) tolerance: f64,
}

/// Visits of links between bodies whose velocities these are, the first of them that of slot `first`.
struct Work<'a> {
    visit: Visit,
    eights: &'a mut [Eight],
    paths: &'a mut [Paths],
    velocities: &'a mut [Velocity],
    first: u32,
    memory: &'a mut dyn Memory,
    /// Lane by lane, so that no sum depends on how wide the registers are.
    sums: &'a mut [[f64; EIGHT]; 2],
}

impl Kernel for Work<'_> {
    #[inline(always)]
    fn run<L: Lane>(self, permit: L::Permit) {
        let Work { visit, eights, paths, velocities, first, memory, sums } = self;
        let all = eights.iter_mut().zip(paths);
        if visit.forward {
            for (eight, paths) in all {
                for at in (0..EIGHT).step_by(L::WIDTH) {
                    pass::<L>(permit, (eight, paths), at, velocities, first, visit, &*memory);
                }
            }
        } else {
            for (eight, paths) in all.rev() {
                let mut charged = [0.0; EIGHT];
                for at in (0..EIGHT).step_by(L::WIDTH) {
                    let (link, speed, push, shear) =
                        pass::<L>(permit, (eight, paths), at, velocities, first, visit, &*memory);
                    let amount = link.amount(push, shear);
                    add_up::<L>(permit, sums, at, [amount.changed, amount.all]);
                    set(&mut charged, at, link.charge_to(speed, push));
                }
                eight.remember(&charged, memory);
            }
        }
    }
}

/// Changes the impulses of the links from lane `at` on so that they fit the velocities, and these with
/// them. Returns the links, their speeds before, and by how much their impulses have changed.
#[inline(always)]
fn pass<L: Lane>(
    permit: L::Permit,
    (eight, paths): (&mut Eight, &mut Paths),
    at: usize,
    velocities: &mut [Velocity],
    first: u32,
    Visit { duration, share, .. }: Visit,
    memory: &dyn Memory,
) -> (Link<L>, L, L, Vector<L>) {
    let mut link = eight.load::<L>(permit, at);
    link.scale(share);
    let mut two = take::<L>(permit, velocities, &eight.slots, at, first);
    let (speed, slip) = link.motion(&two);
    let mut push = link.along.change(speed, link.push);
    eight.searched |= link.is_fast(speed) << at & eight.which;
    let searched = eight.searched >> at & ((1 << L::WIDTH) - 1);
    if searched != 0 {
        let (speeds, mut found) = (speed.unpack(), push.unpack());
        for k in (0..L::WIDTH).filter(|k| searched >> k & 1 == 1) {
            let index = eight.index[at + k];
            let charge = |gap: f64| memory.charge(List::Inside, index, gap);
            let mut course = eight.course(paths, at + k, share);
            found[k] = course.search(speeds[k], duration, &charge);
            eight.set_along(at + k, &course.along);
            paths.store(at + k, &course.path);
        }
        push = L::pack(permit, &found, |one| *one);
    }
    let shear = link.slip.change(slip, link.shear);
    link.change(&mut two, push, shear);
    put::<L>(permit, velocities, &eight.slots, at, first, &two);
    eight.set_impulses(at, &link);
    (link, speed, push, shear)
}

/// Adds numbers lane by lane.
#[inline(always)]
fn add_up<L: Lane>(permit: L::Permit, sums: &mut [[f64; EIGHT]; 2], at: usize, of: [L; 2]) {
    for (sum, of) in sums.iter_mut().zip(of) {
        set(sum, at, number::<L>(permit, sum, at) + of);
    }
}

/// The bodies of the links from lane `at` on.
#[inline(always)]
pub(super) fn take<L: Lane>(
    permit: L::Permit,
    velocities: &[Velocity],
    slots: &[[u32; 2]; EIGHT],
    at: usize,
    first: u32,
) -> Two<L> {
    let of = L::each(|k| &velocities[(slots[at + k][0] - first) as usize]);
    let (v, w) = motion::<L>(permit, &of);
    let first_body = Body { v, w };
    let of = L::each(|k| &velocities[(slots[at + k][1] - first) as usize]);
    let (v, w) = motion::<L>(permit, &of);
    Two { first: first_body, second: Body { v, w } }
}

#[inline(always)]
fn put<L: Lane>(
    permit: L::Permit,
    velocities: &mut [Velocity],
    slots: &[[u32; 2]; EIGHT],
    at: usize,
    first: u32,
    two: &Two<L>,
) {
    for (side, body) in [(0, &two.first), (1, &two.second)] {
        let (v, w) = (body.v.rows(permit), body.w.rows(permit));
        for k in 0..L::WIDTH {
            let slot = (slots[at + k][side] - first) as usize;
            velocities[slot] = Velocity { v: Row(v[k]), w: Row(w[k]) };
        }
    }
}
