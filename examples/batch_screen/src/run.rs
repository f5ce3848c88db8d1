//! The run: steps, passages, rows of results.

use std::path::Path;
use std::time::{Duration, Instant};

use pendular::dem::{Departure, Particle, Profile, Simulation};
use pendular::{Account, MeshWalls};

use crate::build::apparatus::collection;
use crate::build::{Built, Derived, WetTerm};
use crate::error::{RunError, SceneError};
use crate::makeup::Makeup;
use crate::progress::Progress;
use crate::scene::Scene;
use crate::screening::Screening;
use crate::tables::Tables;
use crate::tally::{Gone, Tally};

/// Steps between looks at what has left; the core lets particles leave every 64 steps.
const BATCH: u64 = 64;
/// Frames of the replay.
const FRAMES: u64 = 60;

/// How a run ended.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub(crate) tally: Tally,
    pub(crate) first: Tally,
    pub(crate) steps: u64,
    pub(crate) largest_overlap: f64,
    pub(crate) wall_time: Duration,
    pub(crate) profile: Profile,
}

/// Runs a built scene to its end, writing rows into `out` as it goes.
pub(crate) fn run(
    scene: &Scene,
    built: Built,
    out: &Path,
    progress: &Progress,
) -> Result<Outcome, RunError> {
    let Built { particles, walls, contact, wet, settings, derived } = built;
    match wet {
        None => {
            let simulation = Simulation::new(particles, contact, walls, settings);
            Run::new(scene, simulation.map_err(SceneError::from)?, derived, out)?.go(progress)
        }
        Some(wet) => {
            let simulation = Simulation::new(particles, (contact, wet), walls, settings);
            Run::new(scene, simulation.map_err(SceneError::from)?, derived, out)?.go(progress)
        }
    }
}

struct Run<'a, T: Makeup> {
    scene: &'a Scene,
    simulation: Simulation<T, MeshWalls>,
    tables: Tables,
    screening: Screening,
    apertures: u64,
    gone: Gone,
    frames: u64,
    rows: u64,
}

impl<'a, T: Makeup> Run<'a, T> {
    fn new(
        scene: &'a Scene,
        simulation: Simulation<T, MeshWalls>,
        derived: Derived,
        out: &Path,
    ) -> Result<Self, RunError> {
        let parts = simulation.boundary().0.parts();
        let names: Vec<String> = parts.iter().map(|part| part.name.clone()).collect();
        let tables = Tables::create(out, scene, &derived, &names)?;
        let screening = Screening::new(scene, derived.class.len());
        let classes = scene.classes.len();
        let gone = Gone { collected: vec![0; classes], fines: vec![0.0; classes], escaped: 0 };
        let apertures = screening.apertures();
        Ok(Self { scene, simulation, tables, screening, apertures, gone, frames: 0, rows: 0 })
    }

    fn go(mut self, progress: &Progress) -> Result<Outcome, RunError> {
        let start = Instant::now();
        let step = self.simulation.settings().time_step;
        let last = (self.scene.time / step).round() as u64;
        let at = |k: u64, interval: f64| (k as f64 * interval / step).round() as u64;
        let replay = self.scene.time / FRAMES as f64;
        let first = self.tally();
        loop {
            let now = self.simulation.step();
            if now == at(self.frames, replay) || now == last {
                self.frame()?;
            }
            if now == at(self.rows, self.scene.output_interval) || now == last {
                progress.row(&self.row()?);
            }
            if now >= last {
                break;
            }
            let next = at(self.rows, self.scene.output_interval).min(at(self.frames, replay));
            // Stay on multiples of the batch, so that passages are booked when they happen.
            let steps = (BATCH - now % BATCH).min(next.min(last) - now);
            let advanced = self.simulation.advance(steps);
            self.look()?;
            if let Err(error) = advanced {
                self.row()?;
                return Err(RunError::Simulation(error));
            }
            progress.step(&self.simulation, &self.gone.collected, self.scene.time, start);
        }
        progress.finish();
        Ok(Outcome {
            tally: self.tally(),
            first,
            steps: self.simulation.step(),
            largest_overlap: self.simulation.largest_overlap(),
            wall_time: start.elapsed(),
            profile: self.simulation.profile(),
        })
    }

    fn tally(&self) -> Tally {
        Tally::of(&self.simulation, &self.gone, &self.screening.passed)
    }

    fn row(&mut self) -> Result<Tally, RunError> {
        let tally = self.tally();
        let blocked = self.screening.blocked(&self.simulation);
        self.tables.row(&tally, &blocked, self.apertures)?;
        self.rows += 1;
        Ok(tally)
    }

    fn frame(&mut self) -> Result<(), RunError> {
        let mut particles: Vec<Particle> = self.simulation.particles().iter().collect();
        particles.sort_by_key(|particle| particle.id);
        let wet = self.simulation.term().wet();
        let film = |id: u32| wet.map_or(0.0, |wet| wet.film_thickness(id));
        self.tables.frame(self.simulation.time(), &particles, film)?;
        self.frames += 1;
        Ok(())
    }

    /// Books who has passed the screen and who has been collected.
    fn look(&mut self) -> Result<(), RunError> {
        let mut passages = self.screening.passages(&self.simulation);
        let (low, far) = collection(self.scene);
        for Departure { particle, time } in self.simulation.take_departures() {
            let x = particle.position;
            let collected = x.z < low || (x.x > far && x.z < 0.0);
            if collected {
                self.screening.note(particle, time, &mut passages);
            }
            self.book(&particle, collected);
        }
        let wet = self.simulation.term().wet();
        let film =
            |id: u32| wet.map_or(0.0, |wet: &WetTerm| wet.ledger().volume(Account::Film(id)));
        self.tables.passages(&passages, film)
    }

    fn book(&mut self, particle: &Particle, collected: bool) {
        let class = usize::from(particle.class);
        let film = self.simulation.term_mut().wet_mut().map_or(0.0, |wet| wet.drain(particle.id));
        self.gone.fines[class] += film;
        if collected {
            self.gone.collected[class] += 1;
        } else {
            self.gone.escaped += 1;
        }
    }
}
