//! The write half of an implicit term: kick, the impulses that resist, drift.
//!
//! Passes go over all pairs and give each the impulse that fits the velocities around it
//! (Gauss-Seidel on the impulses of the implicit step). Pairs inside a chunk are visited by its
//! thread, pairs across chunks one after the other, in an order that depends on no thread.

use std::time::Instant;

use rayon::prelude::*;

use super::{Simulation, parallel};
use crate::chunk::{Chunk, List};
use crate::implicit::{Between, Change, Link, Passes};
use crate::integrate::{Moved, drift};
use crate::particles::{Class, Velocity};
use crate::pass::View;
use crate::{Boundary, DVec3, Encounter, Pair, PairTerm, wall_pass};

/// Passes stop when they change the impulses by less than this share of them.
const SETTLED: f64 = 1e-3;
const LEAST_PASSES: u32 = 2;
const MOST_PASSES: u32 = 50;

impl<T: PairTerm, B: Boundary> Simulation<T, B> {
    /// How hard the implicit resistances were to find so far.
    #[must_use]
    pub fn passes(&self) -> Passes {
        self.passes
    }

    /// v(n+½) = v(n−½) + `kick` F/m + impulses over `kick`; x(n+1) = x(n) + `h` v(n+½).
    pub(super) fn write_implicit(&mut self, kick: f64, h: f64) -> Moved {
        let start = Instant::now();
        self.before.clone_from(&self.particles.velocities);
        self.integrate(kick, 0.0);
        self.gather(kick);
        self.profile.integration += start.elapsed();
        let start = Instant::now();
        if self.chunks.iter().any(|c| !c.links.is_empty() || !c.links_across.is_empty()) {
            self.meet_walls(h);
            self.warm();
            self.relax();
            self.close(h);
        }
        self.profile.resistance += start.elapsed();
        let Self { chunks, particles, lists, settings, .. } = self;
        let (places, velocities) = (&mut particles.places, &particles.velocities);
        let size = lists.chunk_size;
        let both = |a: Moved, b: Moved| a.with(b);
        if parallel(chunks.len(), settings.threads) {
            let parts = places.par_chunks_mut(size).zip(velocities.par_chunks(size));
            parts.map(|(places, v)| drift(places, v, h)).reduce(Moved::default, both)
        } else {
            let parts = places.chunks_mut(size).zip(velocities.chunks(size));
            parts.map(|(places, v)| drift(places, v, h)).fold(Moved::default(), both)
        }
    }

    /// Every pair that resists, with the velocities before and after the kick.
    fn gather(&mut self, duration: f64) {
        let mut chunks = std::mem::take(&mut self.chunks);
        let mut view = self.view();
        view.velocities = &self.before;
        let kicked = &self.particles.velocities;
        let (term, boundary) = (&self.term, &self.boundary);
        super::each(&mut chunks, |chunk| {
            let gathering = Gathering { view: &view, kicked, term, duration };
            gathering.pairs(chunk);
            gathering.walls(chunk, boundary);
        });
        self.chunks = chunks;
    }

    /// Walls have the velocity of the half step too.
    fn meet_walls(&mut self, h: f64) {
        let time = self.time();
        self.boundary.move_to(time, time + 0.5 * h);
        for chunk in &mut self.chunks {
            let Chunk { links, walls, .. } = chunk;
            for link in links.iter_mut().filter(|link| matches!(link.list, List::Wall { .. })) {
                link.wall = self.boundary.velocity(walls[link.index as usize].part);
            }
        }
    }

    /// Starts from the impulses of the last step, scaled so that they cannot drive anything: the
    /// best multiple of them as a guess of this step's.
    fn warm(&mut self) {
        let velocities = &mut self.particles.velocities;
        let size = self.lists.chunk_size;
        let pushed = &mut self.before;
        pushed.fill(Velocity { v: DVec3::ZERO, w: DVec3::ZERO });
        let mut sums = [0.0; 2];
        for (chunk, first) in self.chunks.iter().zip((0..).step_by(size)) {
            for link in &chunk.links {
                let [along, own] =
                    with(&link.wall, velocities, link.slots, |p, q| link.start([p, q]));
                sums = [sums[0] + along, sums[1] + own];
                with(&DVec3::ZERO, pushed, link.slots, |p, q| link.push([p, q]));
            }
            debug_assert!(first <= pushed.len());
            for link in &chunk.links_across {
                let [along, own] =
                    with(&link.wall, velocities, link.slots, |p, q| link.start([p, q]));
                sums = [sums[0] + along, sums[1] + own];
                with(&DVec3::ZERO, pushed, link.slots, |p, q| link.push([p, q]));
            }
        }
        let classes = self.particles.classes();
        let moved: f64 = pushed
            .iter()
            .zip(&self.particles.class)
            .map(|(d, &class)| {
                let class = &classes[usize::from(class)];
                class.mass() * d.v.length_squared() + class.inertia() * d.w.length_squared()
            })
            .sum();
        let below = moved + sums[1];
        let share = if below > 0.0 { (-sums[0] / below).clamp(0.0, 1.0) } else { 0.0 };
        let velocities = &mut self.particles.velocities;
        for (velocity, push) in velocities.iter_mut().zip(pushed.iter()) {
            velocity.v += share * push.v;
            velocity.w += share * push.w;
        }
        for chunk in &mut self.chunks {
            let links = chunk.links.iter_mut().chain(&mut chunk.links_across);
            links.for_each(|link| link.scale(share));
        }
    }

    fn relax(&mut self) {
        self.passes.steps += 1;
        for pass in 1..=MOST_PASSES {
            self.passes.passes += 1;
            let forward = pass % 2 == 1;
            let change = if forward {
                let inside = self.relax_inside(forward);
                inside + self.relax_across(forward)
            } else {
                let across = self.relax_across(forward);
                across + self.relax_inside(forward)
            };
            if pass >= LEAST_PASSES && change.changed <= SETTLED * change.all {
                return;
            }
        }
        self.passes.at_most += 1;
    }

    fn relax_inside(&mut self, forward: bool) -> Change {
        let Self { chunks, particles, term, lists, settings, .. } = self;
        let term = &*term;
        let one = |(chunk, velocities): (&mut Chunk<T::Column>, &mut [Velocity])| {
            relax_chunk(term, chunk, velocities, forward)
        };
        let velocities = &mut particles.velocities;
        let changes: Vec<Change> = if parallel(chunks.len(), settings.threads) {
            let parts = velocities.par_chunks_mut(lists.chunk_size);
            chunks.par_iter_mut().zip(parts).map(one).collect()
        } else {
            let parts = velocities.chunks_mut(lists.chunk_size);
            chunks.iter_mut().zip(parts).map(one).collect()
        };
        changes.into_iter().fold(Change::default(), |a, b| a + b)
    }

    fn relax_across(&mut self, forward: bool) -> Change {
        let Self { chunks, particles, term, .. } = self;
        let mut change = Change::default();
        let mut one = |chunk: &mut Chunk<T::Column>| {
            let Chunk { links_across, across, .. } = chunk;
            let mut visit = |link: &mut Link| {
                let column = &across.columns[link.index as usize];
                let charge = |gap| term.charge(column, gap);
                let (slots, wall) = (link.slots, link.wall);
                let velocities = &mut particles.velocities;
                change = change + with(&wall, velocities, slots, |p, q| link.relax([p, q], charge));
            };
            if forward {
                links_across.iter_mut().for_each(&mut visit);
            } else {
                links_across.iter_mut().rev().for_each(&mut visit);
            }
        };
        if forward {
            chunks.iter_mut().for_each(&mut one);
        } else {
            chunks.iter_mut().rev().for_each(&mut one);
        }
        change
    }

    /// Writes the impulses back to the columns of the pairs.
    fn close(&mut self, drift: f64) {
        let Self { chunks, particles, term, .. } = self;
        let velocities = &mut particles.velocities;
        for chunk in chunks {
            for across in [false, true] {
                let links = if across { &mut chunk.links_across } else { &mut chunk.links };
                let mut links = std::mem::take(links);
                for link in &mut links {
                    let (slots, wall) = (link.slots, link.wall);
                    with(&wall, velocities, slots, |p, q| link.close([p, q], drift));
                    let column = chunk.column(link.list, link.index);
                    if let Some(impulse) = term.impulse(column) {
                        *impulse = link.impulse;
                    }
                }
                *(if across { &mut chunk.links_across } else { &mut chunk.links }) = links;
            }
        }
    }
}

/// Calls `act` with the two bodies of a link; a wall stands in for the second where both slots are
/// the same.
#[inline(always)]
fn with<R>(
    wall: &DVec3,
    velocities: &mut [Velocity],
    [a, b]: [u32; 2],
    act: impl FnOnce(&mut Velocity, &mut Velocity) -> R,
) -> R {
    let (a, b) = (a as usize, b as usize);
    let mut p = velocities[a];
    if a == b {
        let mut still = Velocity { v: *wall, w: DVec3::ZERO };
        let result = act(&mut p, &mut still);
        velocities[a] = p;
        return result;
    }
    let mut q = velocities[b];
    let result = act(&mut p, &mut q);
    (velocities[a], velocities[b]) = (p, q);
    result
}

fn relax_chunk<T: PairTerm>(
    term: &T,
    chunk: &mut Chunk<T::Column>,
    velocities: &mut [Velocity],
    forward: bool,
) -> Change {
    let Chunk { links, inside, walls, range, .. } = chunk;
    let mut change = Change::default();
    let mut visit = |link: &mut Link| {
        let index = link.index as usize;
        let column = match link.list {
            List::Wall { memory } => &walls[index].memories[memory as usize].column,
            _ => &inside.columns[index],
        };
        let slots = link.slots.map(|slot| slot - range.start);
        let wall = link.wall;
        let charge = |gap| term.charge(column, gap);
        change = change + with(&wall, velocities, slots, |p, q| link.relax([p, q], charge));
    };
    if forward {
        links.iter_mut().for_each(&mut visit);
    } else {
        links.iter_mut().rev().for_each(&mut visit);
    }
    change
}

/// What links are made from.
struct Gathering<'a, T> {
    view: &'a View<'a>,
    kicked: &'a [Velocity],
    term: &'a T,
    duration: f64,
}

impl<T: PairTerm> Gathering<'_, T> {
    fn pairs(&self, chunk: &mut Chunk<T::Column>) {
        let (view, term) = (self.view, self.term);
        let Chunk { inside, across, links, links_across, range, .. } = chunk;
        links.clear();
        links_across.clear();
        for (kind, list, links) in
            [(List::Inside, inside, links), (List::Across, across, links_across)]
        {
            let pairs = list.active.iter().zip(&mut list.columns).enumerate();
            for (index, (&entry, column)) in pairs {
                if !range.contains(&entry[0]) || term.idle(&view.meet(entry), column) {
                    continue;
                }
                let pair = view.pairs::<f64, false>((), [entry], false).pair(0);
                let [p, q] = entry.map(|slot| &self.kicked[slot as usize]);
                let classes = entry.map(|slot| Some(self.class(slot)));
                let between = Between { slots: entry, classes, list: kind, index: index as u32 };
                links.extend(self.link(&between, &pair, column, p.v - q.v));
            }
        }
    }

    fn walls<B: Boundary>(&self, chunk: &mut Chunk<T::Column>, boundary: &B) {
        let (view, term) = (self.view, self.term);
        let Chunk { walls, links, .. } = chunk;
        let there = walls.iter_mut().enumerate().filter(|(_, w)| boundary.is_present(w.part));
        for (index, wall) in there {
            for k in 0..wall.memories.len() {
                let touch = wall.memories[k].touch;
                let nearest = k == 0;
                let encounter = Encounter { nearest, ..wall_pass::meeting(view, wall, &touch) };
                let (slot, part) = (wall.slot, wall.part);
                let column = &mut wall.memories[k].column;
                if term.idle(&encounter, column) {
                    continue;
                }
                let before = touch.normal;
                let pair =
                    wall_pass::pair::<B, false>(view, boundary, slot, encounter, &touch, before);
                let kicked = self.kicked[slot as usize].v - boundary.velocity(part);
                let classes = [Some(self.class(slot)), None];
                let list = List::Wall { memory: k as u32 };
                let between = Between { slots: [slot; 2], classes, list, index: index as u32 };
                links.extend(self.link(&between, &pair, column, kicked));
            }
        }
    }

    fn link(
        &self,
        between: &Between<'_>,
        pair: &Pair,
        column: &mut T::Column,
        kicked: DVec3,
    ) -> Option<Link> {
        let impulse = *self.term.impulse(column)?;
        // The middle of what the gap is expected to be charged for in this step.
        let gap = if impulse.charged.is_finite() { impulse.charged } else { pair.encounter.gap };
        let gap = gap + 0.5 * self.duration * pair.separation_speed;
        let resist = self.term.resist(pair, column, gap);
        resist.any().then(|| Link::new(between, pair, &resist, impulse, kicked, self.duration))
    }

    fn class(&self, slot: u32) -> &Class {
        &self.view.classes[usize::from(self.view.class[slot as usize])]
    }
}
