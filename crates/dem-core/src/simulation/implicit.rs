//! The write half of an implicit term: kick, the impulses that resist, drift.
//!
//! Passes go over all pairs and give each the impulse that fits the velocities around it
//! (Gauss-Seidel on the impulses of the implicit step). Pairs inside a chunk are visited by its
//! thread, pairs across chunks one after the other, in an order that depends on no thread.

use std::time::Instant;

use rayon::prelude::*;

use super::{Simulation, each, parallel};
use crate::chunk::{Chunk, List, Note, Sum, WallPair};
use crate::implicit::{Impulse, Inverse, Memory, Passes, Visit};
use crate::integrate::{Moved, drift};
use crate::particles::Velocity;
use crate::{Boundary, PairTerm, wall_pass};

const MOST_PASSES: u64 = 51;

impl<T: PairTerm, B: Boundary> Simulation<T, B> {
    /// How hard the implicit resistances were to find so far.
    #[must_use]
    pub fn passes(&self) -> Passes {
        self.passes
    }

    /// v(n+½) = v(n−½) + `kick` F/m + impulses over `kick`; x(n+1) = x(n) + `h` v(n+½).
    pub(super) fn write_implicit(&mut self, kick: f64, h: f64) -> Moved {
        let start = Instant::now();
        self.integrate(kick, 0.0);
        self.profile.integration += start.elapsed();
        let start = Instant::now();
        if self.chunks.iter().any(|c| !c.links.is_empty() || !c.links_across.is_empty()) {
            self.meet_walls(h);
            self.resist(kick);
        }
        self.profile.resistance += start.elapsed();
        let start = Instant::now();
        let moved = self.drift(h);
        self.profile.integration += start.elapsed();
        moved
    }

    fn drift(&mut self, h: f64) -> Moved {
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

    /// Walls have the velocity of the half step too.
    fn meet_walls(&mut self, h: f64) {
        let time = self.time();
        self.boundary.move_to(time, time + 0.5 * h);
        let boundary = &self.boundary;
        for chunk in &mut self.chunks {
            let walls = &chunk.walls;
            chunk.links.meet_walls(|index| boundary.velocity(walls[index as usize].part));
        }
    }

    /// The pairs that wanted attention, now that the term has settled them.
    pub(super) fn meet_settled(&mut self, settled: &[(u32, Note)]) {
        let mut chunks = std::mem::take(&mut self.chunks);
        let (view, term, boundary) = (self.view(), &self.term, &self.boundary);
        for &(number, note) in settled {
            let chunk = &mut chunks[number as usize];
            let encounter = chunk.encounter(&view, &note);
            let index = note.index as usize;
            let (links, column, slots, pair) = match note.list {
                List::Wall { memory } => {
                    let wall = &mut chunk.walls[index];
                    let memory = &mut wall.memories[memory as usize];
                    let (touch, normal) = (memory.touch, memory.touch.normal);
                    let slot = wall.slot;
                    let pair = wall_pass::pair(&view, boundary, slot, encounter, &touch, normal);
                    (&mut chunk.links, &mut memory.column, [slot; 2], pair)
                }
                list => {
                    let (links, list) = if list == List::Inside {
                        (&mut chunk.links, &mut chunk.inside)
                    } else {
                        (&mut chunk.links_across, &mut chunk.across)
                    };
                    let entry = list.active[index];
                    (links, &mut list.columns[index], entry, view.pair(entry))
                }
            };
            if !term.idle(&encounter, column) {
                links.meet(&view, term, &pair, slots, (note.list, note.index), column);
            }
        }
        self.chunks = chunks;
    }

    /// Passes over all pairs, one back and more there and back, until further ones would change the
    /// impulses by less than the tolerance.
    ///
    /// Way back, what touches comes last: to leave over something there costs most.
    fn resist(&mut self, duration: f64) {
        self.passes.steps += 1;
        self.start();
        let mut settled = self.pass(duration, false);
        let mut passes = 1;
        while !settled && passes < MOST_PASSES {
            self.pass(duration, true);
            settled = self.pass(duration, false);
            passes += 2;
        }
        self.passes.passes += passes;
        self.passes.at_most += u64::from(!settled);
        let stiff = |c: &Chunk<T::Column>| c.links.has_stiff() || c.links_across.has_stiff();
        // All pairs or none: a stack of both kinds would drain at a wrong speed.
        if !settled || self.chunks.iter().any(stiff) {
            self.close();
        }
    }

    /// A pass over all pairs for impulses that act for `duration` s: inside the chunks and then across
    /// them, or the other way round. On the way back it returns whether further ones would change little.
    fn pass(&mut self, duration: f64, forward: bool) -> bool {
        let tolerance = self.settings.pass_tolerance;
        let visit = Visit { duration, share: 1.0, forward, tolerance };
        let across = !forward && self.across(visit);
        let inside =
            self.inside(|solving, chunk, velocities| solving.pass(chunk, velocities, visit));
        if forward { self.across(visit) } else { across && inside }
    }

    /// As [`crate::implicit::Links::close`] for all pairs.
    fn close(&mut self) {
        self.inside(|solving, chunk, velocities| {
            let Chunk { links, inside, walls, range, .. } = chunk;
            let columns = &mut inside.columns[..];
            let memory = &mut Remembering { term: solving.term, columns, walls };
            links.close(velocities, range.start, memory);
            true
        });
        let Self { chunks, particles, term, settings, .. } = self;
        let (term, velocities) = (&*term, &particles.velocities[..]);
        each(chunks, settings.threads, |chunk| {
            let Chunk { links_across, across, .. } = chunk;
            let memory = &mut Remembering { term, columns: &mut across.columns, walls: &mut [] };
            links_across.close(velocities, 0, memory);
        });
    }

    /// Does something with every chunk and its velocities.
    fn inside(
        &mut self,
        work: impl Fn(&Solving<'_, T>, &mut Chunk<T::Column>, &mut [Velocity]) -> bool + Sync + Send,
    ) -> bool {
        let Self { chunks, particles, term, lists, settings, inverse, .. } = self;
        let inverse = Inverse { classes: inverse, class: &particles.class };
        let solving = Solving { term, inverse };
        let velocities = &mut particles.velocities;
        let one =
            |(chunk, velocities): (&mut _, &mut [Velocity])| work(&solving, chunk, velocities);
        let settled: Vec<bool> = if parallel(chunks.len(), settings.threads) {
            let parts = velocities.par_chunks_mut(lists.chunk_size);
            chunks.par_iter_mut().zip(parts).map(one).collect()
        } else {
            let parts = velocities.chunks_mut(lists.chunk_size);
            chunks.iter_mut().zip(parts).map(one).collect()
        };
        settled.into_iter().all(|settled| settled)
    }

    /// Starts from the impulses of the last step: [`Solving::start`], and the same for the pairs across
    /// chunks, all with one share.
    fn start(&mut self) {
        self.inside(|solving, chunk, velocities| {
            solving.start(chunk, velocities);
            true
        });
        let Self { chunks, particles, pushed, inverse, .. } = self;
        let inverse = Inverse { classes: inverse, class: &particles.class };
        pushed.resize(particles.velocities.len(), Sum::default());
        let mut sums = [0.0; 2];
        let mut slots = Vec::new();
        for links in chunks.iter().map(|chunk| &chunk.links_across) {
            let [own, below] = links.start_loose(pushed, 0);
            sums = [sums[0] + own, sums[1] + below];
            slots.extend(links.loose.iter().flat_map(|loose| loose.slots));
        }
        slots.sort_unstable();
        slots.dedup();
        let bodies = slots.iter().map(|&slot| (slot as usize, inverse.of_slot(slot)));
        for (slot, body) in bodies.clone() {
            sums = add_motion(sums, &particles.velocities[slot], &pushed[slot], body);
        }
        let share = share(sums);
        for (slot, body) in bodies {
            give(&mut particles.velocities[slot], &std::mem::take(&mut pushed[slot]), body, share);
        }
        chunks.iter_mut().for_each(|chunk| chunk.links_across.start_from(share));
    }

    /// A pass over the pairs across chunks.
    fn across(&mut self, visit: Visit) -> bool {
        let Self { chunks, particles, term, .. } = self;
        let (term, velocities) = (&*term, &mut particles.velocities[..]);
        let one = |settled: bool, chunk: &mut Chunk<T::Column>| {
            let Chunk { links_across, across, .. } = chunk;
            let memory = &mut Remembering { term, columns: &mut across.columns, walls: &mut [] };
            let visit = Visit { share: links_across.take_share(), ..visit };
            links_across.pass_loose(velocities, 0, visit, memory) && settled
        };
        if visit.forward {
            chunks.iter_mut().fold(true, one)
        } else {
            chunks.iter_mut().rev().fold(true, one)
        }
    }
}

/// What the impulses of a step are found with.
struct Solving<'a, T> {
    term: &'a T,
    inverse: Inverse<'a>,
}

impl<T: PairTerm> Solving<'_, T> {
    /// Starts from the impulses of the last step, scaled so that they cannot drive anything.
    fn start(&self, chunk: &mut Chunk<T::Column>, velocities: &mut [Velocity]) {
        let Chunk { links, range, pushed, .. } = chunk;
        if links.is_empty() {
            return;
        }
        let [mut own, mut below] = links.start_loose(pushed, range.start);
        let [side_by_side, below_side_by_side] = links.start_eights();
        (own, below) = (own + side_by_side, below + below_side_by_side);
        let mut sums = [own, below];
        let bodies = range.clone().map(|slot| self.inverse.of_slot(slot));
        for ((velocity, push), body) in velocities.iter().zip(&*pushed).zip(bodies.clone()) {
            sums = add_motion(sums, velocity, push, body);
        }
        let share = share(sums);
        for ((velocity, push), body) in velocities.iter_mut().zip(pushed).zip(bodies) {
            give(velocity, &std::mem::take(push), body, share);
        }
        links.start_from(share);
    }

    /// A pass over the pairs inside a chunk and with walls.
    fn pass(
        &self,
        chunk: &mut Chunk<T::Column>,
        velocities: &mut [Velocity],
        visit: Visit,
    ) -> bool {
        let Chunk { links, inside, walls, range, .. } = chunk;
        let (columns, first) = (&mut inside.columns[..], range.start);
        let memory = &mut Remembering { term: self.term, columns, walls };
        let visit = Visit { share: links.take_share(), ..visit };
        if visit.forward {
            let settled = links.pass_eights(velocities, first, visit, memory);
            links.pass_loose(velocities, first, visit, memory) && settled
        } else {
            let settled = links.pass_loose(velocities, first, visit, memory);
            links.pass_eights(velocities, first, visit, memory) && settled
        }
    }
}

/// Adds what a particle has to do with the two sums that scale a start: what the impulses do to it
/// times its velocity, and times the velocity that they give. `[m, i]` are 1/m and 1/I.
#[inline(always)]
fn add_motion(
    [own, below]: [f64; 2],
    velocity: &Velocity,
    push: &Sum,
    [m, i]: [f64; 2],
) -> [f64; 2] {
    let (p, l) = (push.force.vector(), push.torque.vector());
    let (v, w) = (velocity.v.vector(), velocity.w.vector());
    let moved = p.length_squared() * m + l.length_squared() * i;
    [own + (p.dot(v) + l.dot(w)), below + moved]
}

/// The largest multiple of the remembered impulses, up to all of them, that drives no more than a start
/// without any: twice the one that is best for all pairs together. That one would be too little
/// wherever the impulses are still right, because of those elsewhere that are not.
fn share([own, below]: [f64; 2]) -> f64 {
    if below > 0.0 { (-2.0 * own / below).clamp(0.0, 1.0) } else { 0.0 }
}

/// Gives a share of impulses to a particle.
#[inline(always)]
fn give(velocity: &mut Velocity, push: &Sum, [m, i]: [f64; 2], share: f64) {
    let [m, i] = [share * m, share * i];
    velocity.v.add(push.force.0.map(|p| m * p));
    velocity.w.add(push.torque.0.map(|l| i * l));
}

/// The columns of the pairs of a list, and of those with walls.
struct Remembering<'a, T: PairTerm> {
    term: &'a T,
    columns: &'a mut [T::Column],
    walls: &'a mut [WallPair<T::Column>],
}

impl<T: PairTerm> Memory for Remembering<'_, T> {
    fn charge(&self, list: List, index: u32, gap: f64) -> [f64; 2] {
        let index = index as usize;
        let column = match list {
            List::Wall { memory } => &self.walls[index].memories[memory as usize].column,
            _ => &self.columns[index],
        };
        self.term.charge(column, gap)
    }

    fn impulse(&mut self, list: List, index: u32) -> Option<&mut Impulse> {
        let index = index as usize;
        self.term.impulse(match list {
            List::Wall { memory } => &mut self.walls[index].memories[memory as usize].column,
            _ => &mut self.columns[index],
        })
    }
}
