//! The run: steps, passages, rows of results.

use std::path::Path;
use std::time::{Duration, Instant};

use pendular::contact::Linear;
use pendular::dem::{Boundary, Contact, Departure, PairTerm, Simulation};
use pendular::{Account, Counts, Ledger, MeshWalls};

use crate::build::{Built, Derived, WetTerm};
use crate::error::RunError;
use crate::output::Output;
use crate::progress::Progress;
use crate::scene::Scene;

/// Steps between looks at what has left; the core lets particles leave every 64 steps.
const BATCH: u64 = 64;

/// The two make-ups of a screening run: dry, and with liquid.
pub(crate) trait Makeup: PairTerm {
    /// The liquid, if there is any.
    fn wet(&self) -> Option<&WetTerm>;
    /// The liquid, to be changed.
    fn wet_mut(&mut self) -> Option<&mut WetTerm>;
}

impl Makeup for Contact<Linear> {
    fn wet(&self) -> Option<&WetTerm> {
        None
    }

    fn wet_mut(&mut self) -> Option<&mut WetTerm> {
        None
    }
}

impl Makeup for (Contact<Linear>, WetTerm) {
    fn wet(&self) -> Option<&WetTerm> {
        Some(&self.1)
    }

    fn wet_mut(&mut self) -> Option<&mut WetTerm> {
        Some(&mut self.1)
    }
}

/// What a run knows of itself at one moment.
#[derive(Debug, Clone)]
pub(crate) struct Tally {
    /// Simulated time, s.
    pub(crate) time: f64,
    /// Particles of each class above the screen.
    pub(crate) above: Vec<u64>,
    /// Particles of each class that passed.
    pub(crate) passed: Vec<u64>,
    /// Particles that left in any other way.
    pub(crate) escaped: u64,
    /// Liquid on the particles of each class above the screen, m³.
    pub(crate) film: Vec<f64>,
    /// Liquid that left on particles, m³.
    pub(crate) fines: f64,
    /// Liquid on each wall part, m³.
    pub(crate) parts: Vec<f64>,
    /// Liquid in bridges, m³.
    pub(crate) bridges: f64,
    /// How many bridges there were and are.
    pub(crate) counts: Counts,
    /// (total − initial total)/initial total of the liquid.
    pub(crate) imbalance: f64,
}

/// How a run ended.
#[derive(Debug)]
pub(crate) struct Outcome {
    pub(crate) tally: Tally,
    pub(crate) first: Tally,
    pub(crate) steps: u64,
    pub(crate) largest_overlap: f64,
    pub(crate) wall_time: Duration,
    pub(crate) profile: pendular::dem::Profile,
}

/// Runs a built scene to its end, writing rows into `out` as it goes.
pub(crate) fn run(
    scene: &Scene,
    built: Built,
    out: &Path,
    progress: &Progress,
) -> Result<Outcome, RunError> {
    let Built { particles, walls, contact, wet, settings, derived } = built;
    let start = |e| RunError::Scene(crate::error::SceneError::Simulation(e));
    match wet {
        None => {
            let simulation = Simulation::new(particles, contact, walls, settings).map_err(start)?;
            Run::new(scene, simulation, derived, out)?.go(progress)
        }
        Some(wet) => {
            let term = (contact, wet);
            let simulation = Simulation::new(particles, term, walls, settings).map_err(start)?;
            Run::new(scene, simulation, derived, out)?.go(progress)
        }
    }
}

struct Run<'a, T: Makeup> {
    scene: &'a Scene,
    simulation: Simulation<T, MeshWalls>,
    derived: Derived,
    output: Output,
    passed: Vec<u64>,
    escaped: u64,
    fines: f64,
    first: Option<Tally>,
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
        let output = Output::create(out, scene, &derived, &names)?;
        let passed = vec![0; scene.classes.len()];
        Ok(Self { scene, simulation, derived, output, passed, escaped: 0, fines: 0.0, first: None })
    }

    fn go(mut self, progress: &Progress) -> Result<Outcome, RunError> {
        let start = Instant::now();
        let step = self.simulation.settings().time_step;
        let last = (self.scene.time / step).round() as u64;
        let row_at = |k: u64| (k as f64 * self.scene.output_interval / step).round() as u64;
        let first = self.tally();
        self.output.row(&first)?;
        self.first = Some(first);
        let mut row = 1;
        while self.simulation.step() < last {
            let to = row_at(row).min(last);
            let now = self.simulation.step();
            // Stay on multiples of the batch, so that passages are booked when they happen.
            let steps = (BATCH - now % BATCH).min(to - now);
            let advanced = self.simulation.advance(steps);
            self.book_departures();
            if let Err(error) = advanced {
                self.output.row(&self.tally())?;
                return Err(RunError::Simulation(error));
            }
            if self.simulation.step() == to {
                let tally = self.tally();
                self.output.row(&tally)?;
                progress.row(&tally);
                row += 1;
            }
            progress.step(&self.simulation, &self.passed, self.scene.time, start);
        }
        progress.finish();
        let tally = self.tally();
        let first = self.first.take().unwrap_or_else(|| tally.clone());
        Ok(Outcome {
            tally,
            first,
            steps: self.simulation.step(),
            largest_overlap: self.simulation.largest_overlap(),
            wall_time: start.elapsed(),
            profile: self.simulation.profile(),
        })
    }

    /// Books what left: through the screen as fines, anything else as escaped.
    fn book_departures(&mut self) {
        for Departure { particle, .. } in self.simulation.take_departures() {
            let film = self.simulation.term_mut().wet_mut().map_or(0.0, |w| w.drain(particle.id));
            self.fines += film;
            let sideways = particle.position.truncate().length();
            let radius = 0.5e-3 * self.scene.screen.diameter_mm;
            if particle.position.z < self.derived.outlet && sideways <= radius {
                self.passed[usize::from(particle.class)] += 1;
            } else {
                self.escaped += 1;
            }
        }
    }

    fn tally(&self) -> Tally {
        let mut above = vec![0; self.passed.len()];
        let mut film = vec![0.0; self.passed.len()];
        let wet = self.simulation.term().wet();
        for particle in self.simulation.particles().iter() {
            let class = usize::from(particle.class);
            above[class] += 1;
            film[class] += wet.map_or(0.0, |wet| wet.ledger().volume(Account::Film(particle.id)));
        }
        Tally {
            time: self.simulation.time(),
            above,
            passed: self.passed.clone(),
            escaped: self.escaped,
            film,
            fines: self.fines,
            parts: self.on_parts(),
            bridges: wet.map_or(0.0, |wet| wet.ledger().in_bridges()),
            counts: wet.map_or_else(Counts::default, WetTerm::counts),
            imbalance: wet.map_or(0.0, |wet| wet.ledger().imbalance()),
        }
    }

    /// Liquid on each wall part, m³.
    fn on_parts(&self) -> Vec<f64> {
        let walls = &self.simulation.boundary().0;
        let elements = self.simulation.term().wet().map_or(&[][..], |w| Ledger::walls(w.ledger()));
        (0..walls.parts().len() as u32)
            .map(|part| {
                let first = walls.first_element(part) as usize;
                let count = walls.parts()[part as usize].shape.element_count() as usize;
                elements.get(first..first + count).map_or(0.0, |e| e.iter().sum())
            })
            .collect()
    }
}

/// Largest speed of any wall, m/s.
pub(crate) fn wall_speed(walls: &MeshWalls) -> f64 {
    walls.speed_bound()
}
