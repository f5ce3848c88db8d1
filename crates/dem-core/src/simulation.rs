use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;
use rayon::ThreadPool;
use rayon::prelude::*;

use crate::chunk::{Chunk, Roll};
use crate::implicit::Inverse;
use crate::integrate::{Bodies, Moved, Push, integrate};
use crate::limit::Limit;
use crate::order::chunk_size;
use crate::particles::Particles;
use crate::pass;
use crate::view::View;
use crate::{Boundary, PairTerm, Profile, SimulationError, wall_pass};

mod built;
mod deepest;
mod implicit;
mod leaving;
mod neighbours;
mod settings;
mod settling;
mod skins;
mod snapshot;
mod survey;
mod threads;

pub use settings::Settings;
use settings::{check, check_walls};
pub use snapshot::{RollState, Snapshot, WallMemory};
pub use threads::MOST_THREADS;
use threads::{attended, each, parallel};

/// Steps between looks for particles that left the scene or walls that were taken away.
const LEAVE_EVERY: u64 = 64;
/// Steps between sortings of the particles. Constant: the order decides the order of sums.
const SORT_EVERY: u64 = 16_384;

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
    pool: Option<Arc<ThreadPool>>,
    /// A step has failed: what is left of it cannot be gone on from.
    failed: bool,
    step: u64,
    lists: neighbours::State,
    departures: Vec<Departure>,
    profile: Profile,
    limit: Limit,
    /// What the impulses that pairs across chunks remember do to the momenta of the particles; zero
    /// between steps.
    pushed: Vec<crate::chunk::Sum>,
    /// 1/m and 1/I of the classes, for an implicit term.
    inverse: Vec<[f64; 2]>,
    passes: crate::Passes,
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
        check_walls(&term, &boundary)?;
        let lists = neighbours::State::new(&particles, &settings);
        let start = Roll { spin: DVec3::ZERO, contacts: 1.0 };
        let rolls = vec![start; if term.rolls() { particles.len() } else { 0 }];
        let inverse = if T::IMPLICIT { Inverse::of(particles.classes()) } else { Vec::new() };
        Ok(Self {
            particles,
            term,
            boundary,
            settings,
            chunks: Vec::new(),
            rolls,
            pool: threads::pool(settings.threads)?,
            failed: false,
            step: 0,
            lists,
            departures: Vec::new(),
            profile: Profile::default(),
            limit,
            pushed: Vec::new(),
            inverse,
            passes: crate::Passes::default(),
        })
    }

    /// Goes on for `steps` time steps.
    ///
    /// # Errors
    /// [`SimulationError`] if a term cannot settle or a particle's state is no longer finite, and
    /// [`SimulationError::Failed`] ever after.
    pub fn advance(&mut self, steps: u64) -> Result<(), SimulationError> {
        if self.failed {
            return Err(SimulationError::Failed { time: self.time() });
        }
        let particles = self.particles.len();
        let chunks = particles.div_ceil(chunk_size(particles));
        let done = match self.pool.clone().filter(|_| chunks > 1) {
            None => self.steps(steps),
            Some(pool) => attended(&pool, chunks - 1, || self.steps(steps)),
        };
        self.failed = done.is_err();
        done
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
        View::new(&self.particles, &self.rolls, &self.inverse, self.times())
    }

    /// The time step and how far velocities lag behind positions, s.
    fn times(&self) -> [f64; 2] {
        // At the start velocities and positions are of the same time.
        let lag = if self.step == 0 { 0.0 } else { 0.5 * self.settings.time_step };
        [self.settings.time_step, lag]
    }

    fn read(&mut self) {
        let mut chunks = std::mem::take(&mut self.chunks);
        let (view, term, boundary) = (self.view(), &self.term, &self.boundary);
        each(&mut chunks, self.settings.threads, |chunk| {
            chunk.clear();
            pass::read(&view, term, chunk);
            wall_pass::read(&view, term, boundary, chunk);
        });
        self.chunks = chunks;
    }

    fn write(&mut self) -> Result<(), SimulationError> {
        let start = Instant::now();
        let h = self.settings.time_step;
        let kick = if self.step == 0 { 0.5 * h } else { h };
        let moved =
            if T::IMPLICIT { self.write_implicit(kick, h) } else { self.integrate(kick, h) };
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
        if !T::IMPLICIT {
            self.profile.integration += start.elapsed();
        }
        Ok(())
    }

    fn integrate(&mut self, kick: f64, drift: f64) -> Moved {
        let size = self.lists.chunk_size;
        let Particles { places, velocities, class, .. } = &mut self.particles;
        let pushes: Vec<_> = self.lists.classes.iter().map(|c| Push::new(c, kick)).collect();
        let fall = kick * self.settings.gravity;
        let (chunks, rolls) = (&mut self.chunks, &mut self.rolls);
        let one = |((((chunk, places), velocities), class), rolls): (_, &mut [Roll])| {
            let bodies = Bodies { places, velocities, rolls, class };
            integrate(chunk, bodies, &pushes, fall, drift)
        };
        let mut parts: Vec<&mut [Roll]> = rolls.chunks_mut(size).collect();
        parts.resize_with(chunks.len(), Default::default);
        let both = |a: Moved, b: Moved| a.with(b);
        if parallel(chunks.len(), self.settings.threads) {
            chunks
                .par_iter_mut()
                .zip(places.par_chunks_mut(size))
                .zip(velocities.par_chunks_mut(size))
                .zip(class.par_chunks(size))
                .zip(parts)
                .map(one)
                .reduce(Moved::default, both)
        } else {
            chunks
                .iter_mut()
                .zip(places.chunks_mut(size))
                .zip(velocities.chunks_mut(size))
                .zip(class.chunks(size))
                .zip(parts)
                .map(one)
                .fold(Moved::default(), both)
        }
    }
}
