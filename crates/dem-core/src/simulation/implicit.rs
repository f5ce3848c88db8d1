//! The write half of an implicit term: kick, the impulses that resist, drift.
//!
//! Passes go over all pairs and give each the impulse that fits the velocities around it
//! (Gauss-Seidel on the impulses of the implicit step). Pairs inside a chunk are visited by its
//! thread, pairs across chunks one after the other, in an order that depends on no thread.

use std::time::Instant;

use rayon::prelude::*;

use super::{Simulation, parallel};
use crate::chunk::{Chunk, List};
use crate::implicit::{Body, Change, Inverse, Kept, Links, Met, Passes, Two};
use crate::integrate::{Moved, drift};
use crate::particles::{Row, Velocity};
use crate::view::View;
use crate::{Boundary, DVec3, Encounter, PairTerm, wall_pass};

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
        self.profile.integration += start.elapsed();
        let start = Instant::now();
        self.gather(kick, h);
        if self.chunks.iter().any(|c| !c.links.links.is_empty() || !c.links_across.links.is_empty())
        {
            self.meet_walls(h);
            self.warm();
            self.relax();
            self.close(h);
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

    /// Every pair that resists, with the velocities before and after the kick.
    fn gather(&mut self, duration: f64, drift: f64) {
        let mut chunks = std::mem::take(&mut self.chunks);
        let mut view = self.view();
        view.velocities = &self.before;
        let (term, boundary) = (&self.term, &self.boundary);
        let inverse = Inverse { classes: &self.inverse, class: &self.particles.class };
        let kicked = &self.particles.velocities;
        let times = [duration, drift];
        let gathering = Gathering { view: &view, kicked, term, inverse, times };
        super::each(&mut chunks, |chunk| {
            gathering.pairs(chunk);
            gathering.walls(chunk, boundary);
        });
        self.chunks = chunks;
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

    /// Starts from the impulses of the last step, scaled so that they cannot drive anything: the
    /// best multiple of them as a guess of this step's.
    fn warm(&mut self) {
        let Self { chunks, particles, before: pushed, inverse, lists, settings, .. } = self;
        let inverse = Inverse { classes: inverse, class: &particles.class };
        let velocities = &mut particles.velocities;
        pushed.fill(Velocity::new(DVec3::ZERO, DVec3::ZERO));
        let size = lists.chunk_size;
        let add = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a + c, b + d];
        let one = |(chunk, pushed): (&Chunk<T::Column>, &mut [Velocity])| {
            let Chunk { links, range, .. } = chunk;
            (0..links.links.len()).fold([0.0; 2], |sums, k| {
                let slots = links.links[k].slots;
                let two = take(velocities, slots, 0, links.wall(&links.links[k]));
                let mut push = take(pushed, slots, range.start, DVec3::ZERO);
                let own = links.start(k, &two, &mut push, inverse);
                put(pushed, slots, range.start, push);
                add(sums, own)
            })
        };
        let inside: Vec<[f64; 2]> = if parallel(chunks.len(), settings.threads) {
            chunks.par_iter().zip(pushed.par_chunks_mut(size)).map(one).collect()
        } else {
            chunks.iter().zip(pushed.chunks_mut(size)).map(one).collect()
        };
        let mut sums = inside.into_iter().fold([0.0; 2], add);
        for links in chunks.iter().map(|chunk| &chunk.links_across) {
            for (k, link) in links.links.iter().enumerate() {
                let two = take(velocities, link.slots, 0, DVec3::ZERO);
                let mut push = take(pushed, link.slots, 0, DVec3::ZERO);
                sums = add(sums, links.start(k, &two, &mut push, inverse));
                put(pushed, link.slots, 0, push);
            }
        }
        let moved: f64 = pushed
            .iter()
            .zip(&particles.class)
            .map(|(d, &class)| {
                let [m, i] = inverse.classes[usize::from(class)];
                d.v.vector().length_squared() / m + d.w.vector().length_squared() / i
            })
            .sum();
        let below = moved + sums[1];
        let share = if below > 0.0 { (-sums[0] / below).clamp(0.0, 1.0) } else { 0.0 };
        for (velocity, push) in particles.velocities.iter_mut().zip(pushed.iter()) {
            let (v, w) = (push.v.vector(), push.w.vector());
            velocity.v.add(Row::new(share * v).0);
            velocity.w.add(Row::new(share * w).0);
        }
        for chunk in chunks {
            chunk.links.scale(share);
            chunk.links_across.scale(share);
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
        let Self { chunks, particles, term, lists, settings, inverse, .. } = self;
        let inverse = Inverse { classes: inverse, class: &particles.class };
        let term = &*term;
        let one = |(chunk, velocities): (&mut Chunk<T::Column>, &mut [Velocity])| {
            let Chunk { links, inside, walls, range, .. } = chunk;
            let column = |kept: &Kept| match kept.list {
                List::Wall { memory } => {
                    &walls[kept.index as usize].memories[memory as usize].column
                }
                _ => &inside.columns[kept.index as usize],
            };
            pass(term, links, column, velocities, range.start, inverse, forward)
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
        let Self { chunks, particles, term, inverse, .. } = self;
        let inverse = Inverse { classes: inverse, class: &particles.class };
        let velocities = &mut particles.velocities[..];
        let mut one = |chunk: &mut Chunk<T::Column>| {
            let Chunk { links_across, across, .. } = chunk;
            let column = |kept: &Kept| &across.columns[kept.index as usize];
            pass(term, links_across, column, velocities, 0, inverse, forward)
        };
        let change = Change::default();
        if forward {
            chunks.iter_mut().fold(change, |change, chunk| change + one(chunk))
        } else {
            chunks.iter_mut().rev().fold(change, |change, chunk| change + one(chunk))
        }
    }

    /// Writes the impulses back to the columns of the pairs.
    fn close(&mut self, drift: f64) {
        let Self { chunks, particles, term, .. } = self;
        let (term, velocities) = (&*term, &particles.velocities);
        super::each(chunks, |chunk| {
            let Chunk { links, links_across, inside, across, walls, .. } = chunk;
            for (links, list) in [(links, inside), (links_across, across)] {
                for (k, link) in links.links.iter().enumerate() {
                    let kept = links.kept[k];
                    let two = take(velocities, link.slots, 0, links.wall(link));
                    let index = kept.index as usize;
                    let column = match kept.list {
                        List::Wall { memory } => &mut walls[index].memories[memory as usize].column,
                        _ => &mut list.columns[index],
                    };
                    if let Some(impulse) = term.impulse(column) {
                        links.close(k, &two, drift, impulse);
                    }
                }
            }
        });
    }
}

/// The two bodies of a link, a wall in the place of the second where both slots are the same.
#[inline(always)]
fn take(velocities: &[Velocity], [a, b]: [u32; 2], start: u32, wall: DVec3) -> Two {
    let body = |slot: u32| Body::from(velocities[(slot - start) as usize]);
    let second = if a == b { Body { v: wall, w: DVec3::ZERO } } else { body(b) };
    Two { first: body(a), second }
}

#[inline(always)]
fn put(velocities: &mut [Velocity], [a, b]: [u32; 2], start: u32, two: Two) {
    let mut set = |slot: u32, body: Body| {
        velocities[(slot - start) as usize] = Velocity::new(body.v, body.w);
    };
    if a != b {
        set(b, two.second);
    }
    set(a, two.first);
}

/// One pass over a list.
fn pass<'a, T: PairTerm>(
    term: &T,
    links: &mut Links,
    column: impl Fn(&Kept) -> &'a T::Column,
    velocities: &mut [Velocity],
    start: u32,
    inverse: Inverse<'_>,
    forward: bool,
) -> Change
where
    T::Column: 'a,
{
    let count = links.links.len();
    let mut change = Change::default();
    for n in 0..count {
        let k = if forward { n } else { count - 1 - n };
        let (slots, wall) = (links.links[k].slots, links.wall(&links.links[k]));
        let mut two = take(velocities, slots, start, wall);
        let search = |kept: &Kept, speed: f64, now: f64| {
            kept.search(speed, now, |gap| term.charge(column(kept), gap))
        };
        change = change + links.relax(k, &mut two, inverse, search);
        put(velocities, slots, start, two);
    }
    links.share = 1.0;
    change
}

/// What links are made from.
struct Gathering<'a, T> {
    view: &'a View<'a>,
    kicked: &'a [Velocity],
    term: &'a T,
    inverse: Inverse<'a>,
    /// Duration of the impulses, and of the drift after them, s.
    times: [f64; 2],
}

impl<T: PairTerm> Gathering<'_, T> {
    /// The pairs of particles that acted in the read half.
    fn pairs(&self, chunk: &mut Chunk<T::Column>) {
        let view = self.view;
        let Chunk { inside, across, links, links_across, .. } = chunk;
        for (list, links) in [(inside, links), (across, links_across)] {
            links.clear();
            let met = std::mem::take(&mut links.met);
            for met in &met {
                let [a, b] = met.slots.map(|slot| slot as usize);
                let encounter = view.encounter(met.slots, met.gap);
                let classes = [view.class[a], view.class[b]];
                let column = &mut list.columns[met.index as usize];
                let both = |of: &[Velocity]| Two { first: of[a].into(), second: of[b].into() };
                let (before, kicked) = (both(view.velocities), both(self.kicked));
                let radii = [view.places[a].r, view.places[b].r];
                self.link(links, met, &encounter, classes, column, [&before, &kicked], radii);
            }
            links.met = met;
        }
    }

    fn walls<B: Boundary>(&self, chunk: &mut Chunk<T::Column>, boundary: &B) {
        let (view, term) = (self.view, self.term);
        let Chunk { walls, links, .. } = chunk;
        links.walls_from = links.links.len();
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
                let pair = wall_pass::pair(view, boundary, slot, encounter, &touch, before);
                let met = Met {
                    slots: [slot; 2],
                    list: List::Wall { memory: k as u32 },
                    index: index as u32,
                    normal: pair.normal,
                    levers: pair.levers,
                    gap: touch.gap,
                    rate: pair.separation_speed,
                    slip: pair.slip,
                };
                let second = Body { v: boundary.velocity(part), w: DVec3::ZERO };
                let of = |all: &[Velocity]| Two { first: all[slot as usize].into(), second };
                let (before, kicked) = (of(view.velocities), of(self.kicked));
                let classes = [pair.first_class, pair.second_class];
                let both = [&before, &kicked];
                self.link(links, &met, &encounter, classes, column, both, pair.radii);
            }
        }
    }

    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "one loop body in two places")]
    fn link(
        &self,
        links: &mut Links,
        met: &Met,
        encounter: &Encounter,
        classes: [u16; 2],
        column: &mut T::Column,
        velocities: [&Two; 2],
        radii: [f64; 2],
    ) {
        let Some(&mut impulse) = self.term.impulse(column) else { return };
        // The middle of what the gap is expected to be charged for in this step.
        let gap = if impulse.charged.is_finite() { impulse.charged } else { met.gap };
        let gap = gap + 0.5 * self.times[0] * met.rate;
        let resist = self.term.resist(encounter, classes, column, gap);
        if resist.any() {
            links.add(met, &resist, &impulse, velocities, self.inverse, self.times, radii);
        }
    }
}
