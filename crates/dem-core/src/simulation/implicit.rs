//! The write half of an implicit term: kick, the impulses that resist, drift.
//!
//! Passes go over all pairs and give each the impulse that fits the velocities around it
//! (Gauss-Seidel on the impulses of the implicit step). Pairs inside a chunk are visited by its
//! thread, pairs across chunks one after the other, in an order that depends on no thread.

use std::time::Instant;

use rayon::prelude::*;

use super::{Simulation, each, parallel};
use crate::chunk::{Chunk, List, Note, WallPair};
use crate::implicit::{Change, Impulse, Inverse, Links, Loose, Passes, Task, work};
use crate::integrate::{Moved, drift};
use crate::particles::Velocity;
use crate::{Boundary, DVec3, PairTerm, wall_pass};

/// Rounds stop when their second half changes the impulses by less than this share of them.
const SETTLED: f64 = 1e-3;
const MOST_ROUNDS: u32 = 25;

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
            self.resist([kick, h]);
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

    /// Rounds over all pairs, there and back: inside the chunks, across them, and the other way round.
    fn resist(&mut self, times: [f64; 2]) {
        self.passes.steps += 1;
        for round in 1..=MOST_ROUNDS {
            self.passes.passes += 2;
            let first = round == 1;
            self.inside(times, |solving, chunk, velocities| {
                if first {
                    solving.start_inside(chunk, velocities);
                }
                solving.pass_inside(chunk, velocities, true)
            });
            if first {
                self.start_across(times);
            }
            self.across(times, true);
            let across = self.across(times, false);
            let inside = self.inside(times, |solving, chunk, velocities| {
                solving.pass_inside(chunk, velocities, false)
            });
            let change = inside + across;
            let settled = change.changed <= SETTLED * change.all;
            if settled {
                break;
            }
            self.passes.at_most += u64::from(round == MOST_ROUNDS);
        }
        self.inside(times, |solving, chunk, velocities| {
            solving.close_inside(chunk, velocities);
            Change::default()
        });
        self.close_across(times);
    }

    /// Does something with every chunk and its velocities.
    fn inside(
        &mut self,
        times: [f64; 2],
        work: impl Fn(&Solving<'_, T>, &mut Chunk<T::Column>, &mut [Velocity]) -> Change + Sync + Send,
    ) -> Change {
        let Self { chunks, particles, term, lists, settings, inverse, .. } = self;
        let inverse = Inverse { classes: inverse, class: &particles.class };
        let solving = Solving { term, inverse, times };
        let velocities = &mut particles.velocities;
        let one =
            |(chunk, velocities): (&mut _, &mut [Velocity])| work(&solving, chunk, velocities);
        let changes: Vec<Change> = if parallel(chunks.len(), settings.threads) {
            let parts = velocities.par_chunks_mut(lists.chunk_size);
            chunks.par_iter_mut().zip(parts).map(one).collect()
        } else {
            let parts = velocities.chunks_mut(lists.chunk_size);
            chunks.iter_mut().zip(parts).map(one).collect()
        };
        changes.into_iter().fold(Change::default(), |a, b| a + b)
    }

    /// As [`Solving::start_inside`] for the pairs across chunks, all with one share.
    fn start_across(&mut self, times: [f64; 2]) {
        let Self { chunks, particles, term, inverse, pushed, .. } = self;
        let inverse = Inverse { classes: inverse, class: &particles.class };
        let solving = Solving { term: &*term, inverse, times };
        let lists = chunks.iter_mut().map(|chunk| &mut chunk.links_across);
        solving.start(lists, &mut particles.velocities, pushed, 0);
    }

    /// A pass over the pairs across chunks.
    fn across(&mut self, [duration, _]: [f64; 2], forward: bool) -> Change {
        let Self { chunks, particles, term, .. } = self;
        let velocities = &mut particles.velocities[..];
        let one = |change: Change, chunk: &mut Chunk<T::Column>| {
            let Chunk { links_across, across, .. } = chunk;
            let charge =
                |loose: &Loose, gap: f64| term.charge(&across.columns[loose.index as usize], gap);
            change + links_across.pass_loose(velocities, 0, duration, &charge, forward)
        };
        if forward {
            chunks.iter_mut().fold(Change::default(), one)
        } else {
            chunks.iter_mut().rev().fold(Change::default(), one)
        }
    }

    fn close_across(&mut self, [duration, _]: [f64; 2]) {
        let Self { chunks, particles, term, settings, .. } = self;
        let (term, velocities) = (&*term, &particles.velocities);
        each(chunks, settings.threads, |chunk| {
            let Chunk { links_across, across, .. } = chunk;
            links_across.close_loose(velocities, 0, duration, |loose, impulse| {
                remember(term, &mut across.columns[loose.index as usize], impulse);
            });
        });
    }
}

fn remember<T: PairTerm>(term: &T, column: &mut T::Column, impulse: Impulse) {
    if let Some(own) = term.impulse(column) {
        *own = impulse;
    }
}

/// What the impulses of a step are found with.
struct Solving<'a, T> {
    term: &'a T,
    inverse: Inverse<'a>,
    /// Duration of the impulses, and of the drift after them, s.
    times: [f64; 2],
}

impl<T: PairTerm> Solving<'_, T> {
    /// Starts from the impulses of the last step, scaled so that they cannot drive anything: the
    /// best multiple of them as a guess of this step's.
    fn start_inside(&self, chunk: &mut Chunk<T::Column>, velocities: &mut [Velocity]) {
        let Chunk { links, range, pushed, .. } = chunk;
        self.start([links], velocities, pushed, range.start);
    }

    /// `first` is the slot of the first of the velocities; `pushed` is scratch.
    fn start<'l>(
        &self,
        lists: impl IntoIterator<Item = &'l mut Links>,
        velocities: &mut [Velocity],
        pushed: &mut Vec<Velocity>,
        first: u32,
    ) {
        let [_, drift] = self.times;
        pushed.clear();
        pushed.resize(velocities.len(), Velocity::new(DVec3::ZERO, DVec3::ZERO));
        let mut sums = [0.0; 2];
        let mut started = Vec::new();
        for links in lists {
            let own = work(Task::Start { drift, pushed }, links.eights(), velocities, first);
            let loose = links.start_loose(velocities, pushed, first, drift);
            sums = std::array::from_fn(|k| sums[k] + (own[k] + loose[k]));
            started.push(links);
        }
        let Inverse { classes, class } = self.inverse;
        let moved =
            pushed.iter().zip(&class[first as usize..]).fold(0.0, |moved, (push, &class)| {
                let [m, i] = classes[usize::from(class)];
                moved + push.v.vector().length_squared() / m + push.w.vector().length_squared() / i
            });
        let below = moved + sums[1];
        let share = if below > 0.0 { (-sums[0] / below).clamp(0.0, 1.0) } else { 0.0 };
        for (velocity, push) in velocities.iter_mut().zip(pushed) {
            velocity.v.add(push.v.0.map(|v| share * v));
            velocity.w.add(push.w.0.map(|w| share * w));
        }
        started.into_iter().for_each(|links| links.scale(share));
    }

    /// A pass over the pairs inside a chunk and with walls.
    fn pass_inside(
        &self,
        chunk: &mut Chunk<T::Column>,
        velocities: &mut [Velocity],
        forward: bool,
    ) -> Change {
        let Self { term, times: [duration, _], .. } = *self;
        let Chunk { links, inside, walls, range, .. } = chunk;
        let charge_loose =
            |loose: &Loose, gap: f64| term.charge(column(loose, walls, &inside.columns), gap);
        let charge = |index: u32, gap: f64| term.charge(&inside.columns[index as usize], gap);
        let (first, share) = (range.start, links.share);
        let one_by_one = |links: &mut Links, velocities: &mut [Velocity]| {
            links.pass_loose(velocities, first, duration, &charge_loose, forward)
        };
        let mut change = Change::default();
        if !forward {
            change = one_by_one(links, velocities);
        }
        let task = Task::Pass { duration, share, forward, charge: &charge };
        let [changed, all] = work(task, links.eights(), velocities, first);
        change = change + Change { changed, all };
        if forward {
            change = change + one_by_one(links, velocities);
        }
        change
    }

    /// Writes the impulses inside a chunk and with walls back to the columns of the pairs.
    fn close_inside(&self, chunk: &mut Chunk<T::Column>, velocities: &mut [Velocity]) {
        let Self { term, times: [duration, _], .. } = *self;
        let mut links = std::mem::take(&mut chunk.links);
        let first = chunk.range.start;
        work(Task::Close { duration }, links.eights(), velocities, first);
        links.close_eights(|index, impulse| {
            remember(term, chunk.column(List::Inside, index), impulse);
        });
        links.close_loose(velocities, first, duration, |loose, impulse| {
            remember(term, chunk.column(loose.list, loose.index), impulse);
        });
        chunk.links = links;
    }
}

/// The column of a link inside a chunk or with a wall.
fn column<'a, C>(loose: &Loose, walls: &'a [WallPair<C>], inside: &'a [C]) -> &'a C {
    match loose.list {
        List::Wall { memory } => &walls[loose.index as usize].memories[memory as usize].column,
        _ => &inside[loose.index as usize],
    }
}
