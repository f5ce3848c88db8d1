//! Links inside a chunk, eight side by side: pairs of which no two have a body in common, so that
//! all can be solved for at once.

use super::Impulse;
use super::link::{Body, Change, Inverse, Link, Met, Two};
use super::normal::Normal;
use super::shear::Slip;
use crate::DVec3;
use crate::lane::{Kernel, Lane, Vector, in_widest};
use crate::particles::{Row, Velocity};
use crate::view::motion;

/// How many lie side by side.
pub(crate) const EIGHT: usize = 8;
// Where some of the numbers are; a vector takes three places.
const PUSH: usize = 9;
const OFFSET: usize = 10;
const SHEAR: usize = 13;
const TURN: usize = 21;
const CHARGED: usize = 24;
const PAID: usize = 30;
/// Numbers of a [`Link`].
const NUMBERS: usize = 31;

/// Drag's impulse up to a gap and the drag there, of the pair at an index of the list.
pub(crate) type Charge<'a> = dyn Fn(u32, f64) -> [f64; 2] + 'a;

/// Eight links.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Eight {
    numbers: [[f64; EIGHT]; NUMBERS],
    slots: [[u32; 2]; EIGHT],
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
    fn load<L: Lane>(&self, permit: L::Permit, at: usize) -> Link<L> {
        Link {
            normal: self.vector(permit, at, 0),
            levers: [self.number(permit, at, 3), self.number(permit, at, 4)],
            inverse: [
                [self.number(permit, at, 5), self.number(permit, at, 6)],
                [self.number(permit, at, 7), self.number(permit, at, 8)],
            ],
            push: self.number(permit, at, PUSH),
            along: Normal {
                offset: self.number(permit, at, OFFSET),
                slope: self.number(permit, at, 11),
                answer: self.number(permit, at, 12),
            },
            shear: self.vector(permit, at, SHEAR),
            slip: Slip {
                slope: self.number(permit, at, 16),
                answer: self.number(permit, at, 17),
                offset: self.vector(permit, at, 18),
            },
            turn: self.number(permit, at, TURN),
            gap: self.number(permit, at, 22),
            weight: self.number(permit, at, 23),
            charged: self.number(permit, at, CHARGED),
            rate: self.number(permit, at, 25),
            room: self.number(permit, at, 26),
            mobility: self.number(permit, at, 27),
            dashpot: self.number(permit, at, 28),
            pull: self.number(permit, at, 29),
            paid: self.number(permit, at, PAID),
        }
    }

    #[inline(always)]
    fn number<L: Lane>(&self, permit: L::Permit, at: usize, n: usize) -> L {
        let all = &self.numbers[n];
        L::pack(permit, &L::each(|k| all[at + k]), |one| *one)
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
    fn set<L: Lane>(&mut self, at: usize, n: usize, number: L) {
        let number = number.unpack();
        let all = &mut self.numbers[n];
        for k in 0..L::WIDTH {
            all[at + k] = number[k];
        }
    }

    #[inline(always)]
    fn set_impulses<L: Lane>(&mut self, at: usize, link: &Link<L>) {
        self.set(at, PUSH, link.push);
        self.set(at, SHEAR, link.shear.x);
        self.set(at, SHEAR + 1, link.shear.y);
        self.set(at, SHEAR + 2, link.shear.z);
    }

    #[inline(always)]
    fn store<L: Lane>(&mut self, at: usize, link: &Link<L>) {
        let Link { normal, levers, inverse, along, slip, .. } = *link;
        self.set_impulses(at, link);
        for (n, number) in [(0, normal.x), (1, normal.y), (2, normal.z)] {
            self.set(at, n, number);
        }
        for (n, number) in [(3, levers[0]), (4, levers[1]), (5, inverse[0][0])] {
            self.set(at, n, number);
        }
        for (n, number) in [(6, inverse[0][1]), (7, inverse[1][0]), (8, inverse[1][1])] {
            self.set(at, n, number);
        }
        for (n, number) in [(10, along.offset), (11, along.slope), (12, along.answer)] {
            self.set(at, n, number);
        }
        for (n, number) in [(16, slip.slope), (17, slip.answer), (18, slip.offset.x)] {
            self.set(at, n, number);
        }
        for (n, number) in [(19, slip.offset.y), (20, slip.offset.z), (21, link.turn)] {
            self.set(at, n, number);
        }
        for (n, number) in [(22, link.gap), (23, link.weight), (24, link.charged)] {
            self.set(at, n, number);
        }
        for (n, number) in [(25, link.rate), (26, link.room), (27, link.mobility)] {
            self.set(at, n, number);
        }
        for (n, number) in [(28, link.dashpot), (29, link.pull)] {
            self.set(at, n, number);
        }
    }

    /// Where the columns of those that are there stand, and what they are to remember.
    pub(super) fn impulses(&self) -> impl Iterator<Item = (u32, Impulse)> {
        (0..EIGHT).filter(|k| self.which >> k & 1 == 1).map(|k| {
            let number = |n: usize| self.numbers[n][k];
            let shear = DVec3::new(number(SHEAR), number(SHEAR + 1), number(SHEAR + 2));
            let (charged, normal) = (number(CHARGED), number(PUSH));
            (self.index[k], Impulse { charged, normal, shear, ..Impulse::NONE })
        })
    }
}

/// Adds links that the lanes hold; the place of those that are not there stays empty.
#[inline(always)]
pub(super) fn add<L: Lane>(
    eights: &mut Vec<Eight>,
    taken: &mut usize,
    permit: L::Permit,
    met: &Met<'_, L>,
    inverse: Inverse<'_>,
    duration: f64,
) -> u32 {
    let (link, more) = Link::new(permit, met, inverse, duration);
    let (last, at) = (*taken / EIGHT, *taken % EIGHT);
    if last == eights.len() {
        eights.push(Eight::NONE);
    }
    *taken += L::WIDTH;
    let eight = &mut eights[last];
    if at == 0 {
        (eight.which, eight.searched) = (0, 0);
    }
    eight.store(at, &link);
    let here = met.which & !more;
    for k in 0..L::WIDTH {
        (eight.slots[at + k], eight.index[at + k]) = (met.slots[k], met.index[k]);
        if here >> k & 1 == 0 {
            eight.numbers.iter_mut().for_each(|all| all[at + k] = 0.0);
        }
    }
    eight.which |= (here & ((1 << L::WIDTH) - 1)) << at;
    met.which & more
}

/// What is done with the links of a chunk.
pub(crate) enum Task<'a> {
    /// The sums that scale a start; what the start does to the velocities is added to `pushed`.
    Start { drift: f64, pushed: &'a mut [Velocity] },
    /// A visit of each.
    Pass { duration: f64, share: f64, forward: bool, charge: &'a Charge<'a> },
    /// The end: how far the gaps are charged for now.
    Close { duration: f64 },
}

/// Does a task for links between bodies whose velocities these are, the first of them that of slot
/// `first`; returns the two sums of a start or of a pass.
pub(crate) fn work(
    task: Task<'_>,
    eights: &mut [Eight],
    velocities: &mut [Velocity],
    first: u32,
) -> [f64; 2] {
    let mut sums = [[0.0; EIGHT]; 2];
    in_widest(Work { task, eights, velocities, first, sums: &mut sums });
    sums.map(|lanes| lanes.iter().sum())
}

struct Work<'a> {
    task: Task<'a>,
    eights: &'a mut [Eight],
    velocities: &'a mut [Velocity],
    first: u32,
    /// Lane by lane, so that no sum depends on how wide the registers are.
    sums: &'a mut [[f64; EIGHT]; 2],
}

impl Kernel for Work<'_> {
    #[inline(always)]
    fn run<L: Lane>(self, permit: L::Permit) {
        let Work { task, eights, velocities, first, sums } = self;
        match task {
            Task::Start { drift, pushed } => {
                for eight in eights {
                    start::<L>(permit, eight, velocities, pushed, first, drift, sums);
                }
            }
            Task::Pass { duration, share, forward: true, charge } => {
                for eight in eights {
                    pass::<L>(permit, eight, velocities, first, [duration, share], charge, sums);
                }
            }
            Task::Pass { duration, share, forward: false, charge } => {
                for eight in eights.iter_mut().rev() {
                    pass::<L>(permit, eight, velocities, first, [duration, share], charge, sums);
                }
            }
            Task::Close { duration } => {
                for eight in eights {
                    for at in (0..EIGHT).step_by(L::WIDTH) {
                        let two = take::<L>(permit, velocities, &eight.slots, at, first);
                        let charged = eight.load::<L>(permit, at).charge_to(&two, duration);
                        eight.set(at, CHARGED, charged);
                    }
                }
            }
        }
    }
}

#[inline(always)]
fn start<L: Lane>(
    permit: L::Permit,
    eight: &mut Eight,
    velocities: &[Velocity],
    pushed: &mut [Velocity],
    first: u32,
    drift: f64,
    sums: &mut [[f64; EIGHT]; 2],
) {
    for at in (0..EIGHT).step_by(L::WIDTH) {
        let mut link = eight.load::<L>(permit, at);
        let two = take::<L>(permit, velocities, &eight.slots, at, first);
        let mut push = take::<L>(permit, pushed, &eight.slots, at, first);
        let [a, b] = link.start(&two, &mut push, drift);
        put::<L>(permit, pushed, &eight.slots, at, first, &push);
        eight.set(at, OFFSET, link.along.offset);
        eight.set(at, TURN, link.turn);
        add_up::<L>(permit, sums, at, [a, b]);
    }
}

#[inline(always)]
fn pass<L: Lane>(
    permit: L::Permit,
    eight: &mut Eight,
    velocities: &mut [Velocity],
    first: u32,
    [duration, share]: [f64; 2],
    charge: &Charge<'_>,
    sums: &mut [[f64; EIGHT]; 2],
) {
    for at in (0..EIGHT).step_by(L::WIDTH) {
        let mut link = eight.load::<L>(permit, at);
        link.scale(share);
        let mut two = take::<L>(permit, velocities, &eight.slots, at, first);
        let (speed, slip) = link.motion(&two);
        let mut push = link.along.fit(speed, link.push);
        let fast = (link.is_fast(speed) << at) & !eight.searched;
        if fast != 0 {
            eight.searched |= fast;
            for k in (0..EIGHT).filter(|k| fast >> k & 1 == 1) {
                eight.numbers[PAID][k] = charge(eight.index[k], eight.numbers[CHARGED][k])[0];
            }
        }
        if eight.searched >> at & ((1 << L::WIDTH) - 1) != 0 {
            let (speeds, now) = (speed.unpack(), link.push.unpack());
            let mut found = push.unpack();
            for k in (0..L::WIDTH).filter(|k| eight.searched >> (at + k) & 1 == 1) {
                let index = eight.index[at + k];
                let one = Link { push: now[k], ..eight.load::<f64>((), at + k) };
                found[k] = one.search(speeds[k], duration, &|gap| charge(index, gap));
            }
            push = L::pack(permit, &found, |one| *one);
        }
        let shear = link.slip.change(slip, link.shear);
        let Change { changed, all } = link.change(&mut two, push, shear);
        put::<L>(permit, velocities, &eight.slots, at, first, &two);
        eight.set_impulses(at, &link);
        add_up::<L>(permit, sums, at, [changed, all]);
    }
}

/// Adds numbers lane by lane.
#[inline(always)]
fn add_up<L: Lane>(permit: L::Permit, sums: &mut [[f64; EIGHT]; 2], at: usize, of: [L; 2]) {
    for (sum, of) in sums.iter_mut().zip(of) {
        let now = L::pack(permit, &L::each(|k| sum[at + k]), |one| *one) + of;
        let now = now.unpack();
        for k in 0..L::WIDTH {
            sum[at + k] = now[k];
        }
    }
}

/// The bodies of the links from lane `at` on.
#[inline(always)]
fn take<L: Lane>(
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
