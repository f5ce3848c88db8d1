use std::time::Instant;

use glam::DVec3;
use rayon::ThreadPool;
use rayon::prelude::*;

use crate::chunk::{Chunk, List, Note, Roll, WallPair};
use crate::integrate::{Bodies, Moved, Push, integrate};
use crate::limit::Limit;
use crate::order::chunk_size;
use crate::particles::{Particles, Place};
use crate::pass::{self, View};
use crate::{Boundary, PairTerm, Profile, SimulationError, Visit, wall_pass};

mod neighbours;
mod snapshot;

pub use snapshot::{RollState, Snapshot, WallMemory};

/// Steps between looks for particles that left the scene or walls that were taken away.
const LEAVE_EVERY: u64 = 64;
/// Steps between sortings of the particles. Constant: the order decides the order of sums.
const SORT_EVERY: u64 = 16_384;

/// What a simulation needs to know besides bodies and laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Time step, s.
    pub time_step: f64,
    /// Gravity, m/s².
    pub gravity: DVec3,
    /// Threads; results do not depend on them.
    pub threads: usize,
    /// Corners of the box that particles may be in, m; one outside leaves the scene.
    pub domain: Option<(DVec3, DVec3)>,
    /// Skin of the outer neighbour lists, m; `None` chooses it. Results do not depend on it.
    pub skin: Option<f64>,
    /// Skin of the active lists, m; `None` chooses it. Results do not depend on it.
    pub inner_skin: Option<f64>,
    /// Largest overlap at the start, as a share of the smaller radius.
    pub start_overlap: f64,
    /// Goes on with a time step above the stability limit.
    pub allow_unstable: bool,
}

impl Settings {
    /// Earth's gravity along −z, one thread, no bounds, at most 5 % overlap at the start.
    #[must_use]
    pub fn new(time_step: f64) -> Self {
        Self {
            time_step,
            gravity: DVec3::new(0.0, 0.0, -9.81),
            threads: 1,
            domain: None,
            skin: None,
            inner_skin: None,
            start_overlap: 0.05,
            allow_unstable: false,
        }
    }
}

/// A particle that left the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Departure {
    /// The particle as it left.
    pub particle: crate::Particle,
    /// Simulated time, s.
    pub time: f64,
}

/// Particles, walls and the terms that act between them.
pub struct Simulation<T: PairTerm, B> {
    particles: Particles,
    term: T,
    boundary: B,
    settings: Settings,
    chunks: Vec<Chunk<T::Column>>,
    rolls: Vec<Roll>,
    pool: Option<ThreadPool>,
    step: u64,
    lists: neighbours::State,
    departures: Vec<Departure>,
    profile: Profile,
    limit: Limit,
}

impl<T: PairTerm + std::fmt::Debug, B: std::fmt::Debug> std::fmt::Debug for Simulation<T, B> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Simulation")
            .field("particles", &self.particles.len())
            .field("term", &self.term)
            .field("settings", &self.settings)
            .field("step", &self.step)
            .finish_non_exhaustive()
    }
}

impl<T: PairTerm, B: Boundary> Simulation<T, B> {
    /// Sets up a simulation at t = 0.
    ///
    /// # Errors
    /// [`SimulationError`] if a setting is not usable, the time step is above the stability limit,
    /// or bodies overlap too much.
    pub fn new(
        particles: Particles,
        term: T,
        boundary: B,
        settings: Settings,
    ) -> Result<Self, SimulationError> {
        let mut simulation = Self::bare(particles, term, boundary, settings)?;
        simulation.boundary.move_to(0.0, 0.0);
        simulation.sort(&[]);
        simulation.check_overlaps()?;
        Ok(simulation)
    }

    /// A simulation whose particles are not yet cut into chunks.
    fn bare(
        particles: Particles,
        term: T,
        boundary: B,
        settings: Settings,
    ) -> Result<Self, SimulationError> {
        let limit = check(&particles, &term, &settings)?;
        let lists = neighbours::State::new(&particles, &settings);
        let start = Roll { spin: DVec3::ZERO, contacts: 1.0 };
        let rolls = vec![start; if term.rolls() { particles.len() } else { 0 }];
        Ok(Self {
            particles,
            term,
            boundary,
            settings,
            chunks: Vec::new(),
            rolls,
            pool: threads(settings.threads)?,
            step: 0,
            lists,
            departures: Vec::new(),
            profile: Profile::default(),
            limit,
        })
    }

    /// Goes on for `steps` time steps.
    ///
    /// # Errors
    /// [`SimulationError`] if a term cannot settle or a particle's state is no longer finite.
    pub fn advance(&mut self, steps: u64) -> Result<(), SimulationError> {
        match self.pool.take() {
            None => self.steps(steps),
            Some(pool) => {
                let done = pool.install(|| self.steps(steps));
                self.pool = Some(pool);
                done
            }
        }
    }

    fn steps(&mut self, steps: u64) -> Result<(), SimulationError> {
        for _ in 0..steps {
            self.refresh();
            self.read();
            self.settle()?;
            self.write()?;
            if self.step.is_multiple_of(LEAVE_EVERY) {
                self.leave()?;
            }
            if self.step.is_multiple_of(SORT_EVERY) {
                self.sort(&[]);
            }
        }
        Ok(())
    }

    /// Simulated time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.step as f64 * self.settings.time_step
    }

    /// Steps done.
    #[must_use]
    pub fn step(&self) -> u64 {
        self.step
    }

    /// The particles in the scene.
    #[must_use]
    pub fn particles(&self) -> &Particles {
        &self.particles
    }

    /// The term that acts between bodies.
    #[must_use]
    pub fn term(&self) -> &T {
        &self.term
    }

    /// The term, to be changed between steps.
    pub fn term_mut(&mut self) -> &mut T {
        &mut self.term
    }

    /// The walls, as they stand now.
    #[must_use]
    pub fn boundary(&self) -> &B {
        &self.boundary
    }

    /// The settings.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The longest stable time step and what sets it.
    #[must_use]
    pub fn limit(&self) -> Limit {
        self.limit
    }

    /// Particles that left since the last call, in the order of their ids within a time.
    pub fn take_departures(&mut self) -> Vec<Departure> {
        std::mem::take(&mut self.departures)
    }

    /// Largest overlap so far, as a share of the smaller radius.
    #[must_use]
    pub fn largest_overlap(&self) -> f64 {
        self.chunks.iter().fold(self.lists.overlap, |most, chunk| most.max(chunk.overlap))
    }

    /// Where the time went.
    #[must_use]
    pub fn profile(&self) -> Profile {
        let mut profile = self.profile;
        for chunk in &self.chunks {
            profile.pairs += chunk.pair_time;
            profile.walls += chunk.wall_time;
        }
        profile
    }

    /// Calls `see` with every pair of particles that touch or that the term holds as live, once.
    pub fn for_each_pair(&self, mut see: impl FnMut(&crate::Encounter, &T::Column)) {
        let view = self.view();
        for chunk in &self.chunks {
            let across = chunk.across.active.iter().zip(&chunk.across.columns);
            let across = across.filter(|(e, _)| chunk.range.contains(&e[0]));
            let inside = chunk.inside.active.iter().zip(&chunk.inside.columns);
            for (&entry, column) in inside.chain(across) {
                let encounter = view.meet(entry);
                if encounter.gap < 0.0 || self.term.live(column) {
                    see(&encounter, column);
                }
            }
        }
    }

    fn view(&self) -> View<'_> {
        // At the start velocities and positions are of the same time.
        let lag = if self.step == 0 { 0.0 } else { 0.5 * self.settings.time_step };
        View::new(&self.particles, &self.rolls, self.settings.time_step, lag)
    }

    fn read(&mut self) {
        let mut chunks = std::mem::take(&mut self.chunks);
        let (view, term, boundary) = (self.view(), &self.term, &self.boundary);
        let rolls = !self.rolls.is_empty();
        each(&mut chunks, |chunk| {
            chunk.clear();
            if rolls {
                pass::read::<T, true>(&view, term, chunk);
                wall_pass::read::<T, B, true>(&view, term, boundary, chunk);
            } else {
                pass::read::<T, false>(&view, term, chunk);
                wall_pass::read::<T, B, false>(&view, term, boundary, chunk);
            }
        });
        self.chunks = chunks;
    }

    /// Gathers the pairs that want attention in the order of their keys, lets the term settle them
    /// and writes their columns back, to both copies where a pair crosses a border.
    fn settle(&mut self) -> Result<(), SimulationError> {
        if self.chunks.iter().all(|chunk| chunk.notes.is_empty()) {
            return Ok(());
        }
        let start = Instant::now();
        let mut notes: Vec<(usize, Note)> = Vec::new();
        for (c, chunk) in self.chunks.iter_mut().enumerate() {
            notes.extend(chunk.notes.drain(..).map(|note| (c, note)));
        }
        let key = |n: &Note| (n.pair.encounter.first, n.pair.encounter.second);
        notes.sort_by_key(|(c, note)| (key(note), *c));
        let mut visits: Vec<Visit<T::Column>> = Vec::with_capacity(notes.len());
        for (k, (c, note)) in notes.iter().enumerate() {
            let copy = k > 0 && key(&notes[k - 1].1) == key(note) && note.list == List::Across;
            if !copy {
                let column = *self.chunks[*c].column(note.list, note.index);
                visits.push(Visit { pair: note.pair, column, ending: false });
            }
        }
        let time = self.time();
        let settled = self.term.settle(&mut visits);
        settled.map_err(|source| SimulationError::Term { time, source })?;
        let mut visits = visits.iter();
        let mut current = None;
        for (k, (c, note)) in notes.iter().enumerate() {
            let copy = k > 0 && key(&notes[k - 1].1) == key(note) && note.list == List::Across;
            if !copy {
                current = visits.next();
            }
            if let Some(visit) = current {
                *self.chunks[*c].column(note.list, note.index) = visit.column;
            }
        }
        self.profile.settling += start.elapsed();
        Ok(())
    }

    fn write(&mut self) -> Result<(), SimulationError> {
        let start = Instant::now();
        let h = self.settings.time_step;
        let kick = if self.step == 0 { 0.5 * h } else { h };
        let moved = self.integrate(kick, h);
        self.step += 1;
        let time = self.time();
        if !moved.check.is_finite() {
            let bad = self.particles.iter().find(|p| {
                !(p.position.is_finite() && p.velocity.is_finite() && p.spin.is_finite())
            });
            let id = bad.map_or(u32::MAX, |p| p.id);
            return Err(SimulationError::NotFinite { id, time });
        }
        self.boundary.move_to(time, time - 0.5 * h);
        self.lists.travel(moved.fastest2.sqrt() * h, self.boundary.speed_bound() * h);
        self.profile.integration += start.elapsed();
        Ok(())
    }

    fn integrate(&mut self, kick: f64, drift: f64) -> Moved {
        let size = self.lists.chunk_size;
        let Particles { places, velocities, class, .. } = &mut self.particles;
        let pushes: Vec<_> = self.lists.classes.iter().map(|c| Push::new(c, kick)).collect();
        let fall = kick * self.settings.gravity;
        let (chunks, rolls) = (&self.chunks, &mut self.rolls);
        let one = |((((chunk, places), velocities), class), rolls): (_, &mut [Roll])| {
            let bodies = Bodies { places, velocities, rolls, class };
            integrate(chunk, bodies, &pushes, fall, drift)
        };
        let mut parts: Vec<&mut [Roll]> = rolls.chunks_mut(size).collect();
        parts.resize_with(chunks.len(), Default::default);
        let both = |a: Moved, b: Moved| Moved {
            fastest2: a.fastest2.max(b.fastest2),
            check: a.check + b.check,
        };
        if chunks.len() > 1 && rayon::current_num_threads() > 1 && self.settings.threads > 1 {
            chunks
                .par_iter()
                .zip(places.par_chunks_mut(size))
                .zip(velocities.par_chunks_mut(size))
                .zip(class.par_chunks(size))
                .zip(parts)
                .map(one)
                .reduce(Moved::default, both)
        } else {
            chunks
                .iter()
                .zip(places.chunks_mut(size))
                .zip(velocities.chunks_mut(size))
                .zip(class.chunks(size))
                .zip(parts)
                .map(one)
                .fold(Moved::default(), both)
        }
    }
}

/// Runs over all chunks, in parallel inside a pool of more than one thread.
fn each<C: Send>(chunks: &mut [Chunk<C>], one: impl Fn(&mut Chunk<C>) + Sync + Send) {
    if chunks.len() > 1 && rayon::current_thread_index().is_some() {
        chunks.par_iter_mut().for_each(one);
    } else {
        chunks.iter_mut().for_each(one);
    }
}

fn threads(threads: usize) -> Result<Option<ThreadPool>, SimulationError> {
    if threads <= 1 {
        return Ok(None);
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let failed = |e: rayon::ThreadPoolBuildError| SimulationError::Threads {
        threads,
        reason: e.to_string(),
    };
    pool.map(Some).map_err(failed)
}

fn check<T: PairTerm>(
    particles: &Particles,
    term: &T,
    settings: &Settings,
) -> Result<Limit, SimulationError> {
    let given = [
        ("time step", Some(settings.time_step)),
        ("skin", settings.skin),
        ("inner skin", settings.inner_skin),
        ("start overlap", Some(settings.start_overlap)),
    ];
    for (quantity, value) in given {
        if let Some(value) = value.filter(|v| !(*v > 0.0 && *v < f64::INFINITY)) {
            return Err(SimulationError::Setting { quantity, value });
        }
    }
    let classes = particles.classes();
    let limit = Limit::packing(classes, &term.stability(classes));
    if settings.time_step > limit.time_step && !settings.allow_unstable {
        return Err(SimulationError::TimeStep {
            time_step: settings.time_step,
            allowed: limit.time_step,
            class: limit.class,
            radius: classes[limit.class].radius(),
            term: limit.term,
        });
    }
    Ok(limit)
}

impl<T: PairTerm, B: Boundary> Simulation<T, B> {
    fn check_overlaps(&mut self) -> Result<(), SimulationError> {
        self.refresh();
        let share = self.settings.start_overlap;
        let view = self.view();
        let fail = |encounter: crate::Encounter, allowed: f64| {
            let (first, second, overlap) = (encounter.first, encounter.second, -encounter.gap);
            Err(SimulationError::StartOverlap { first, second, overlap, allowed })
        };
        for chunk in &self.chunks {
            for &entry in chunk.inside.active.iter().chain(&chunk.across.active) {
                let encounter = view.meet(entry);
                let [a, b] = entry.map(|slot| view.places[slot as usize].r);
                if -encounter.gap > share * a.min(b) {
                    return fail(encounter, share * a.min(b));
                }
            }
            let mut touches = Vec::new();
            for wall in &chunk.walls {
                let Place { x, r } = view.places[wall.slot as usize];
                let near = &chunk.pool[wall.candidates.clone()];
                self.boundary.touches(wall.part, near, x, r, 0.0, &mut touches);
                let deepest = touches.first().filter(|t| -t.gap > share * r);
                if let Some(touch) = deepest {
                    let pair = wall_pass::ending(&view, &self.boundary, wall, touch);
                    return fail(pair.encounter, share * r);
                }
            }
        }
        Ok(())
    }

    /// Lets go of particles outside the domain and of walls that are no longer there, after a last
    /// visit of the term to every pair that ends with them.
    fn leave(&mut self) -> Result<(), SimulationError> {
        let outside = |x: DVec3| {
            self.settings
                .domain
                .is_some_and(|(low, high)| !(x.cmpge(low).all() && x.cmple(high).all()))
        };
        let places = self.particles.places.iter().enumerate();
        let leaving: Vec<u32> =
            places.filter(|(_, p)| outside(p.x)).map(|(slot, _)| slot as u32).collect();
        self.end_pairs(&leaving)?;
        if leaving.is_empty() {
            return Ok(());
        }
        let time = self.time();
        let mut gone: Vec<_> = leaving
            .iter()
            .map(|&slot| Departure { particle: self.particles.particle(slot as usize), time })
            .collect();
        gone.sort_by_key(|d| d.particle.id);
        self.departures.extend(gone);
        self.sort(&leaving);
        Ok(())
    }

    fn end_pairs(&mut self, leaving: &[u32]) -> Result<(), SimulationError> {
        let goes = |slot: u32| leaving.binary_search(&slot).is_ok();
        let (term, boundary) = (&self.term, &self.boundary);
        let view = self.view();
        let stays = |wall: &WallPair<T::Column>| !goes(wall.slot) && boundary.is_present(wall.part);
        let mut visits: Vec<Visit<T::Column>> = Vec::new();
        for chunk in &self.chunks {
            if !leaving.is_empty() {
                for (list, across) in [(&chunk.inside, false), (&chunk.across, true)] {
                    for (&entry, column) in list.active.iter().zip(&list.columns) {
                        let ends = goes(entry[0]) || goes(entry[1]);
                        let ours = !across || chunk.range.contains(&entry[0]);
                        if ends && ours && term.live(column) {
                            let pair = view.pairs::<f64, false>([entry]).pair(0);
                            visits.push(Visit { pair, column: *column, ending: true });
                        }
                    }
                }
            }
            for wall in &chunk.walls {
                if wall.memories.is_empty() || stays(wall) {
                    continue;
                }
                let live = wall.memories.iter().filter(|m| term.live(&m.column));
                visits.extend(live.map(|m| Visit {
                    pair: wall_pass::ending(&view, boundary, wall, &m.touch),
                    column: m.column,
                    ending: true,
                }));
            }
        }
        for chunk in &mut self.chunks {
            chunk.walls.retain(&stays);
        }
        if visits.is_empty() {
            return Ok(());
        }
        visits.sort_by_key(|v| (v.pair.encounter.first, v.pair.encounter.second));
        let time = self.time();
        self.term.settle(&mut visits).map_err(|source| SimulationError::Term { time, source })
    }

    /// Sorts the particles along the Morton curve, without those in `leaving`, cuts them into new
    /// chunks and carries every live column over.
    fn sort(&mut self, leaving: &[u32]) {
        let start = Instant::now();
        let carried = neighbours::Carried::collect(self, leaving);
        let slots: Vec<u32> = if leaving.is_empty() {
            crate::order::morton(&self.particles)
        } else {
            let all = 0..self.particles.len() as u32;
            all.filter(|slot| leaving.binary_search(slot).is_err()).collect()
        };
        self.particles.arrange(&slots);
        if !self.rolls.is_empty() {
            self.rolls = slots.iter().map(|&s| self.rolls[s as usize]).collect();
        }
        self.cut(carried);
        self.profile.neighbours += start.elapsed();
    }

    /// Cuts the particles, in the order they stand in, into chunks that own the carried columns.
    fn cut(&mut self, carried: neighbours::Carried<T::Column>) {
        let size = chunk_size(self.particles.len());
        self.lists.renew(&self.particles, size);
        for chunk in &self.chunks {
            self.lists.overlap = self.lists.overlap.max(chunk.overlap);
            self.profile.pairs += chunk.pair_time;
            self.profile.walls += chunk.wall_time;
        }
        let n = self.particles.len() as u32;
        let rolls = !self.rolls.is_empty();
        self.chunks = (0..n)
            .step_by(size)
            .map(|first| Chunk::new(first..n.min(first + size as u32), rolls))
            .collect();
        carried.hand_out(self);
    }
}
