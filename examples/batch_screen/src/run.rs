//! The run: steps, passages, rows of results, checkpoints.

mod limit;
mod start;

use std::cell::Cell;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use pendular::dem::{Departure, Implicit, Particle, Passes, Simulation};
use pendular::{Account, Budget, MeshWalls};

use self::start::begin;
pub(crate) use self::start::begins;
use crate::auto::Decision;
use crate::budget;
use crate::build::apparatus::collection;
use crate::build::{Built, Derived, WetTerm};
use crate::checkpoint::{Checkpoint, Core, StoredWet};
use crate::error::RunError;
use crate::frames;
use crate::guard::{Fault, Guard};
use crate::liquid_final;
use crate::makeup::Makeup;
use crate::progress::Progress;
use crate::report;
use crate::scene::Scene;
use crate::screening::Screening;
use crate::spent::Spent;
use crate::tables::{Start, Tables};
use crate::tally::{Gone, Tally};
use crate::vtk::Series;

/// Steps between looks at what has left; the core lets particles leave every 64 steps.
const BATCH: u64 = 64;
/// Frames of the replay.
const FRAMES: u64 = 60;

/// How a run ended.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub(crate) tally: Tally,
    pub(crate) start: Start,
    pub(crate) steps: u64,
    pub(crate) largest_overlap: f64,
    pub(crate) wall_time: Duration,
    pub(crate) budget: Budget,
    /// The least stability limit of the packing at any look, s.
    pub(crate) limit: f64,
    pub(crate) spent: Spent,
    /// How hard implicit drags were to find since the run was started or taken up again.
    pub(crate) passes: Passes,
    /// Why the run stopped before its end, if it did.
    pub(crate) fault: Option<String>,
}

/// What a run is besides its scene.
#[derive(Debug, Clone)]
pub(crate) struct Job {
    /// Folder of the results.
    pub(crate) out: PathBuf,
    /// What the scene was called, its text, and the folder its paths are relative to.
    pub(crate) source: String,
    pub(crate) text: String,
    pub(crate) base: PathBuf,
    /// Time between ParaView frames, s.
    pub(crate) vtk: Option<f64>,
    /// Wall time between checkpoints, s.
    pub(crate) checkpoint_every: f64,
    /// Set when the run is to stop at the next occasion.
    pub(crate) stop: Arc<AtomicBool>,
    /// What was decided for laws that the scene leaves open.
    pub(crate) decided: Vec<Decision>,
}

/// Runs a built scene from its start, or goes on from a checkpoint of it.
pub(crate) fn run(
    scene: &Scene,
    built: Built,
    job: &Job,
    from: Option<Checkpoint>,
    progress: &Progress,
) -> Result<Outcome, RunError> {
    let Built { particles, walls, contact, wet, settings, derived } = built;
    match wet {
        None => begin(scene, particles, contact, walls, settings, derived, job, from)?.go(progress),
        Some(wet) if derived.implicit => {
            let term = Implicit::new((contact, wet));
            begin(scene, particles, term, walls, settings, derived, job, from)?.go(progress)
        }
        Some(wet) => {
            let term = (contact, wet);
            begin(scene, particles, term, walls, settings, derived, job, from)?.go(progress)
        }
    }
}

struct Run<'a, T: Makeup> {
    scene: &'a Scene,
    job: &'a Job,
    simulation: Simulation<T, MeshWalls>,
    derived: Derived,
    tables: Tables,
    vtk: Option<Series>,
    screening: Screening,
    apertures: u64,
    gone: Gone,
    frames: u64,
    vtk_frames: u64,
    rows: u64,
    before: f64,
    budget: Budget,
    limit: f64,
    guard: Guard,
    /// Where the time went before this run was taken up again, and what its results have taken.
    spent: Spent,
    fault: Option<String>,
    /// What the last look has found.
    gone_wrong: Option<Fault>,
    /// Simulated time of the last checkpoint, s.
    saved: Cell<f64>,
}

impl<T: Makeup> Run<'_, T> {
    fn go(mut self, progress: &Progress) -> Result<Outcome, RunError> {
        let begun = Instant::now();
        let mut saved = begun;
        let step = self.simulation.settings().time_step;
        let last = (self.scene.time / step).round() as u64;
        let at = |k: u64, interval: f64| row_at(k, interval, step);
        let replay = self.scene.time / FRAMES as f64;
        let vtk_at = |k: u64| self.job.vtk.map_or(u64::MAX, |interval| at(k, interval));
        let interval = self.scene.output_interval;
        if self.rows > 0 && self.simulation.step() >= last {
            // Taken up again after its end: there is nothing left to do.
            return self.finish(begun);
        }
        if self.simulation.step() == 0 {
            // From here on the run can be taken up again, whenever it is killed. A bed at rest has no
            // columns to go on from: what it says of the limit is kept.
            self.limit = self.limit.min(self.simulation.limit_now().time_step);
            self.save(begun)?;
        }
        progress.begin(self.simulation.step(), self.simulation.time());
        let mut output = Instant::now();
        loop {
            let now = self.simulation.step();
            // Intervals shorter than a step give one frame or row a step.
            if at(self.frames, replay) <= now || (now == last && self.frames <= FRAMES) {
                self.frame()?;
                while at(self.frames, replay) <= now && self.frames <= FRAMES {
                    self.frames += 1;
                }
            }
            if vtk_at(self.vtk_frames) <= now {
                self.vtk_frame()?;
                while vtk_at(self.vtk_frames) <= now {
                    self.vtk_frames += 1;
                }
            }
            if at(self.rows, interval) <= now || now == last {
                progress.row(&self.row()?);
                while at(self.rows, interval) <= now {
                    self.rows += 1;
                }
            }
            if now >= last {
                break;
            }
            let next =
                at(self.rows, interval).min(at(self.frames, replay)).min(vtk_at(self.vtk_frames));
            // Stay on multiples of the batch, so that passages are booked when they happen.
            let steps = (BATCH - now % BATCH).min(next.min(last) - now);
            self.spent.output += output.elapsed();
            let advanced = self.simulation.advance(steps);
            output = Instant::now();
            self.look()?;
            let sound = match advanced {
                Ok(()) => self.guard.look(&self.simulation, &self.screening),
                Err(error) => Err(self.guard.broken(&error, self.simulation.time())),
            };
            // Before anything is saved: a broken state never takes the place of a sound one.
            if let Err(fault) = sound.and_then(|()| self.gone_wrong.take().map_or(Ok(()), Err)) {
                progress.finish();
                return Err(self.stop_at(fault, begun));
            }
            if self.simulation.step().is_multiple_of(budget::EVERY) {
                budget::look(&self.simulation, &mut self.budget);
            }
            let stop = self.job.stop.load(Ordering::Relaxed);
            if stop || saved.elapsed().as_secs_f64() >= self.job.checkpoint_every {
                self.save(begun)?;
                saved = Instant::now();
            }
            if stop {
                progress.finish();
                return Err(RunError::Stopped { folder: self.job.out.clone() });
            }
            progress.step(&self.simulation, &self.gone.collected, self.scene.time);
        }
        progress.finish();
        self.save(begun)?;
        self.spent.output += output.elapsed();
        let outcome = self.finish(begun)?;
        self.summary(&outcome)?;
        Ok(outcome)
    }

    /// Writes what only the end of a run has.
    fn finish(&self, begun: Instant) -> Result<Outcome, RunError> {
        liquid_final::write(&self.job.out, self.scene, &self.simulation, &self.tally())?;
        Ok(self.outcome(begun))
    }

    /// Writes the last outputs of a state that cannot be, and says what is wrong with it.
    fn stop_at(&mut self, fault: Fault, begun: Instant) -> RunError {
        self.fault = Some(format!("t = {:.6} s: {}", fault.time, fault.what));
        let sound = self.simulation.particles().kinetic_energy().is_finite();
        // Whatever else fails now, the fault is what there is to say.
        let _ = if sound { self.row().map(|_| ()) } else { Ok(()) };
        let _ = self.summary(&self.outcome(begun));
        RunError::Guard { fault, folder: self.job.out.clone(), saved: self.saved.get() }
    }

    /// How the run stands.
    fn outcome(&self, begun: Instant) -> Outcome {
        Outcome {
            tally: self.tally(),
            start: self.tables.start(),
            steps: self.simulation.step(),
            largest_overlap: self.simulation.largest_overlap(),
            wall_time: begun.elapsed() + Duration::from_secs_f64(self.before),
            budget: self.budget,
            limit: self.limit,
            spent: self.spent.with(&self.simulation.profile()),
            passes: self.simulation.passes(),
            fault: self.fault.clone(),
        }
    }

    /// Writes how the run stands: a summary for people and pages, a checkpoint to go on from.
    fn save(&self, begun: Instant) -> Result<(), RunError> {
        let checkpoint = Checkpoint {
            source: self.job.source.clone(),
            scene: self.job.text.clone(),
            base: self.job.base.clone(),
            time: self.scene.time,
            time_step: self.simulation.settings().time_step,
            seed: self.scene.seed,
            allow_unstable: self.simulation.settings().allow_unstable,
            vtk: self.job.vtk,
            class: self.derived.class.clone(),
            core: Core::of(&self.simulation),
            wet: self.simulation.term().wet().map(StoredWet::of),
            screening: self.screening.clone(),
            gone: self.gone.clone(),
            start: self.tables.start(),
            budget: self.budget,
            limit: self.limit,
            decided: self.job.decided.clone(),
            files: self.derived.files.clone(),
            tables: self.tables.lengths()?,
            rows: self.rows,
            frames: self.frames,
            vtk_frames: self.vtk_frames,
            elapsed: self.before + begun.elapsed().as_secs_f64(),
            spent: self.spent.with(&self.simulation.profile()),
        };
        self.summary(&self.outcome(begun))?;
        checkpoint.write(&self.job.out)?;
        self.saved.set(self.simulation.time());
        Ok(())
    }

    fn summary(&self, outcome: &Outcome) -> Result<(), RunError> {
        let path = self.job.out.join("summary.json");
        let settings = self.simulation.settings();
        let parts = part_names(&self.simulation);
        let source = &self.job.source;
        let source = (source.as_str(), &self.job.decided[..]);
        report::summary(&path, self.scene, source, settings, &self.derived, outcome, &parts)
    }

    fn tally(&self) -> Tally {
        Tally::of(&self.simulation, &self.gone, &self.screening.passed)
    }

    fn row(&mut self) -> Result<Tally, RunError> {
        let tally = self.tally();
        let (now, settings) = (self.simulation.step(), self.simulation.settings());
        let at = |row: u64| row_at(row, self.scene.output_interval, settings.time_step);
        let last = (self.scene.time / settings.time_step).round() as u64;
        if limit::is_due(now, self.rows.checked_sub(1).map(at), last) {
            self.stable()?;
        }
        let blocked = self.screening.blocked(&self.simulation);
        self.tables.row(&tally, &blocked, self.apertures)?;
        Ok(tally)
    }

    /// Stops where the packing has become so stiff that the time step is above its limit.
    fn stable(&mut self) -> Result<(), RunError> {
        let (now, settings) = (self.simulation.limit_now(), self.simulation.settings());
        self.limit = self.limit.min(now.time_step);
        if settings.time_step <= now.time_step || settings.allow_unstable {
            return Ok(());
        }
        Err(RunError::Unstable {
            time: self.simulation.time(),
            time_step: settings.time_step,
            allowed: now.time_step,
            class: self.scene.classes[now.class].name.clone(),
            term: now.term,
        })
    }

    fn frame(&mut self) -> Result<(), RunError> {
        let mut particles: Vec<Particle> = self.simulation.particles().iter().collect();
        particles.sort_by_key(|particle| particle.id);
        let wet = self.simulation.term().wet();
        let film = |id: u32| wet.map_or(0.0, |wet| wet.film_thickness(id));
        self.tables.frame(self.simulation.time(), &particles, film)
    }

    fn vtk_frame(&mut self) -> Result<(), RunError> {
        if let Some(series) = &mut self.vtk {
            series.frame(&frames::frame(&self.simulation))?;
        }
        Ok(())
    }

    /// Books who has passed the screen and who has been collected.
    fn look(&mut self) -> Result<(), RunError> {
        let mut passages = self.screening.passages(&self.simulation);
        let mut wrong = Ok(());
        let (low, far) = collection(self.scene);
        for Departure { particle, time } in self.simulation.take_departures() {
            let x = particle.position;
            let collected = x.z < low || (x.x > far && x.z < 0.0);
            if collected {
                self.screening.note(particle, time, &mut passages);
            } else {
                wrong = wrong.and(self.guard.escaped(particle.id, x, time));
            }
            self.book(&particle, collected);
        }
        let classes = self.simulation.particles().classes();
        let radii: Vec<f64> = classes.iter().map(|class| class.radius()).collect();
        self.gone_wrong = wrong.and(self.guard.passed(&passages, &radii)).err();
        let wet = self.simulation.term().wet();
        let film =
            |id: u32| wet.map_or(0.0, |wet: &WetTerm| wet.ledger().volume(Account::Film(id)));
        self.tables.passages(&passages, film)
    }

    fn book(&mut self, particle: &Particle, collected: bool) {
        let class = usize::from(particle.class);
        let film = self.simulation.term_mut().wet_mut().map_or(0.0, |wet| wet.drain(particle.id));
        let gone = &mut self.gone;
        let (count, liquid) = match collected {
            true => (&mut gone.collected, &mut gone.fines),
            false => (&mut gone.escaped, &mut gone.taken),
        };
        count[class] += 1;
        liquid[class] += film;
    }
}

/// The step at which something is due for the `k`-th time.
fn row_at(k: u64, interval: f64, step: f64) -> u64 {
    (k as f64 * interval / step).round() as u64
}

fn part_names<T: Makeup>(simulation: &Simulation<T, MeshWalls>) -> Vec<String> {
    simulation.boundary().0.parts().iter().map(|part| part.name.clone()).collect()
}
