//! The read half between particles: every active pair is loaded, every load added up.

use std::ops::Range;
use std::time::Instant;

use glam::DVec3;

use crate::chunk::{Chunk, List, Note, Roll, Sum};
use crate::lists::{Entry, PairList};
use crate::particles::{Class, Particles, Place, Velocity};
use crate::{Encounter, Load, Pair, PairTerm, Partner};

/// What all chunks read in one step.
pub(crate) struct View<'a> {
    pub(crate) classes: &'a [Class],
    pub(crate) places: &'a [Place],
    pub(crate) velocities: &'a [Velocity],
    pub(crate) class: &'a [u16],
    pub(crate) id: &'a [u32],
    pub(crate) rolls: &'a [Roll],
    pub(crate) time_step: f64,
    /// How far the velocities lag behind the positions, s.
    pub(crate) lag: f64,
}

impl<'a> View<'a> {
    pub(crate) fn new(p: &'a Particles, rolls: &'a [Roll], time_step: f64, lag: f64) -> Self {
        let (places, velocities) = (&p.places, &p.velocities);
        let (class, id, classes) = (&p.class, &p.id, p.classes());
        Self { classes, places, velocities, class, id, rolls, time_step, lag }
    }

    pub(crate) fn inertia(&self, slot: usize) -> f64 {
        self.classes[usize::from(self.class[slot])].inertia()
    }

    /// Two particles and the distance of their centres.
    #[inline(always)]
    pub(crate) fn meet(&self, [a, b]: Entry) -> (Encounter, DVec3, f64) {
        let (a, b) = (a as usize, b as usize);
        let (p, q) = (&self.places[a], &self.places[b]);
        let line = q.x - p.x;
        let distance = line.length();
        let gap = distance - (p.r + q.r);
        let second = Partner::Particle(self.id[b]);
        (Encounter { first: self.id[a], second, element: 0, nearest: true, gap }, line, distance)
    }

    /// All there is to know of the pair.
    #[inline(always)]
    pub(crate) fn pair<const ROLLS: bool>(
        &self,
        [a, b]: Entry,
        encounter: Encounter,
        line: DVec3,
        distance: f64,
    ) -> Pair {
        let (a, b) = (a as usize, b as usize);
        let (ri, rj) = (self.places[a].r, self.places[b].r);
        let (vi, vj) = (&self.velocities[a], &self.velocities[b]);
        let velocity = vi.v - vj.v;
        let half_step_normal = (line + self.lag * velocity).normalize();
        // The contact lies in the middle of gap or overlap, so that li + lj is the distance.
        let (li, lj) = (ri + 0.5 * encounter.gap, rj + 0.5 * encounter.gap);
        let along = velocity.dot(half_step_normal);
        let turning = (li * vi.w + lj * vj.w).cross(half_step_normal);
        let mut pair = Pair {
            encounter,
            first_class: self.class[a],
            second_class: self.class[b],
            radii: [ri, rj],
            normal: line * distance.recip(),
            half_step_normal,
            separation_speed: -along,
            slip: velocity - along * half_step_normal + turning,
            spin: vi.w - vj.w,
            expected_spin: DVec3::ZERO,
            rolling_inertia: 0.0,
            levers: [li, lj],
            time_step: self.time_step,
        };
        if ROLLS {
            let (mi, mj) = (&self.rolls[a], &self.rolls[b]);
            pair.expected_spin = pair.spin + (mi.spin - mj.spin);
            let brake = mi.contacts / self.inertia(a) + mj.contacts / self.inertia(b);
            pair.rolling_inertia = 1.0 / brake;
        }
        pair
    }
}

/// Loads all active pairs of a chunk.
pub(crate) fn read<T: PairTerm, const ROLLS: bool>(
    view: &View<'_>,
    term: &T,
    chunk: &mut Chunk<T::Column>,
) {
    let start = Instant::now();
    let Chunk { range, inside, across, sums, rolls, notes, overlap, pair_time, .. } = chunk;
    let mut out = Out { range, sums, rolls, notes, overlap };
    list::<T, ROLLS, true>(view, term, inside, &mut out);
    list::<T, ROLLS, false>(view, term, across, &mut out);
    *pair_time += start.elapsed();
}

struct Out<'a> {
    range: &'a Range<u32>,
    sums: &'a mut [Sum],
    rolls: &'a mut [Roll],
    notes: &'a mut Vec<Note>,
    overlap: &'a mut f64,
}

/// One list. `INSIDE`: both particles are the chunk's own; else the load goes to one of them only,
/// computed in the same orientation as the chunk of the other one does.
fn list<T: PairTerm, const ROLLS: bool, const INSIDE: bool>(
    view: &View<'_>,
    term: &T,
    list: &mut PairList<T::Column>,
    out: &mut Out<'_>,
) {
    for (index, (&entry, column)) in list.active.iter().zip(&mut list.columns).enumerate() {
        let (encounter, line, distance) = view.meet(entry);
        if term.idle(&encounter, column) {
            continue;
        }
        let pair = view.pair::<ROLLS>(entry, encounter, line, distance);
        let load = term.load(&pair, column);
        let ours = |slot: u32| INSIDE || out.range.contains(&slot);
        let (first, second) = (ours(entry[0]), ours(entry[1]));
        let slot = |k: usize| (entry[k] - out.range.start) as usize;
        let touching = encounter.gap < 0.0;
        if first {
            add::<ROLLS>(&mut out.sums[slot(0)], &load, &pair, 0);
            if ROLLS && touching {
                roll(&mut out.rolls[slot(0)], load.rolling);
            }
        }
        if second {
            add::<ROLLS>(&mut out.sums[slot(1)], &load, &pair, 1);
            if ROLLS && touching {
                roll(&mut out.rolls[slot(1)], -load.rolling);
            }
        }
        if -encounter.gap > *out.overlap * pair.radii[0].min(pair.radii[1]) {
            *out.overlap = -encounter.gap / pair.radii[0].min(pair.radii[1]);
        }
        if load.attention {
            let kind = if INSIDE { List::Inside } else { List::Across };
            out.notes.push(Note { pair, list: kind, index: index as u32 });
        }
    }
}

/// Adds a load to the first (`side` 0) or second particle (`side` 1) of a pair.
#[inline(always)]
pub(crate) fn add<const ROLLS: bool>(sum: &mut Sum, load: &Load, pair: &Pair, side: usize) {
    let sign = if side == 0 { 1.0 } else { -1.0 };
    sum.force += sign * (load.tension * pair.normal + load.shear);
    sum.torque += pair.levers[side] * pair.normal.cross(load.shear) + sign * load.couple;
}

#[inline(always)]
pub(crate) fn roll(sum: &mut Roll, torque: DVec3) {
    sum.spin += torque;
    sum.contacts += 1.0;
}
