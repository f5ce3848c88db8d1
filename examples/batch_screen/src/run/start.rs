//! A run at its start, or at a checkpoint.

use std::cell::Cell;

use pendular::dem::{Partner, Simulation, SimulationError};
use pendular::{Budget, MeshWalls};

use super::{Job, Run, part_names};
use crate::build::{Built, Derived};
use crate::checkpoint::Checkpoint;
use crate::error::{RunError, SceneError};
use crate::guard::Guard;
use crate::makeup::Makeup;
use crate::scene::Scene;
use crate::screening::Screening;
use crate::spent::Spent;
use crate::tables::Tables;
use crate::tally::{Gone, Tally};
use crate::vtk::Series;

#[expect(clippy::too_many_arguments, reason = "the parts of a built scene, taken apart")]
pub(super) fn begin<'a, T: Makeup>(
    scene: &'a Scene,
    particles: pendular::dem::Particles,
    mut term: T,
    walls: MeshWalls,
    settings: pendular::dem::Settings,
    derived: Derived,
    job: &'a Job,
    from: Option<Checkpoint>,
) -> Result<Run<'a, T>, RunError> {
    let Some(from) = from else {
        let guard = Guard::new(scene, &walls, &derived.class);
        let simulation = Simulation::new(particles, term, walls, settings)
            .map_err(|e| not_begun(scene, &guard, e))?;
        return Run::new(scene, simulation, derived, job);
    };
    let Checkpoint { core, wet, .. } = from.clone();
    if let (Some(stored), Some(wet)) = (wet, term.wet_mut()) {
        wet.resume(stored.state()).map_err(SceneError::from)?;
    }
    let mut broken = None;
    let snapshot = core.snapshot().map(|stored| {
        term.load_pair(stored).unwrap_or_else(|error| {
            broken = Some(error);
            T::Column::default()
        })
    });
    if let Some(error) = broken {
        return Err(SceneError::from(pendular::WetError::from(error)).into());
    }
    let simulation = Simulation::restore(particles, term, walls, settings, snapshot);
    Run::resume(scene, simulation.map_err(SceneError::from)?, derived, job, from)
}

/// Whether a run could begin: nothing overlaps too much.
pub(crate) fn begins(scene: &Scene, built: Built) -> Result<(), SceneError> {
    let Built { particles, walls, contact, mut settings, derived, .. } = built;
    let guard = Guard::new(scene, &walls, &derived.class);
    // The step is judged elsewhere.
    settings.allow_unstable = true;
    let begun = Simulation::new(particles, contact, walls, settings);
    begun.map(drop).map_err(|e| not_begun(scene, &guard, e))
}

/// Why a run cannot begin; overlaps with a part from a file are that part's.
fn not_begun(scene: &Scene, guard: &Guard, error: SimulationError) -> SceneError {
    let SimulationError::StartOverlap { first, second, overlap, allowed } = error else {
        return scene.at("packing", error);
    };
    let [first, second] = [Partner::Particle(first), second].map(|body| guard.body(body));
    let part = scene.parts.iter().position(|part| part.name == second);
    let (key, second) = match part {
        Some(k) => (format!("parts[{k}]"), format!("part `{second}`")),
        None => ("packing".into(), second),
    };
    scene.at(&key, SceneError::StartOverlap { first, second, overlap, allowed })
}

impl<'a, T: Makeup> Run<'a, T> {
    fn new(
        scene: &'a Scene,
        simulation: Simulation<T, MeshWalls>,
        derived: Derived,
        job: &'a Job,
    ) -> Result<Self, RunError> {
        let screening = Screening::new(scene, derived.class.len());
        let classes = scene.classes.len();
        let gone = Gone::none(classes);
        let first = Tally::of(&simulation, &gone, &screening.passed);
        let names = part_names(&simulation);
        let tables = Tables::create(&job.out, scene, &derived, &names, &first)?;
        let allow_unstable = simulation.settings().allow_unstable;
        crate::effective::write(scene, &derived, job, allow_unstable)?;
        let apertures = screening.apertures();
        let guard = Guard::new(scene, simulation.boundary(), &derived.class);
        let vtk = match job.vtk {
            Some(_) => Some(Series::create(&job.out.join("paraview"))?),
            None => None,
        };
        let (frames, vtk_frames, rows, before) = (0, 0, 0, 0.0);
        Ok(Self {
            scene,
            job,
            simulation,
            derived,
            tables,
            vtk,
            screening,
            apertures,
            gone,
            frames,
            vtk_frames,
            rows,
            before,
            budget: Budget::default(),
            limit: f64::INFINITY,
            guard,
            spent: Spent::default(),
            fault: None,
            gone_wrong: None,
            saved: Cell::new(0.0),
        })
    }

    fn resume(
        scene: &'a Scene,
        simulation: Simulation<T, MeshWalls>,
        derived: Derived,
        job: &'a Job,
        from: Checkpoint,
    ) -> Result<Self, RunError> {
        let names = part_names(&simulation);
        let (lengths, start) = (&from.tables, from.start);
        let tables = Tables::resume(&job.out, scene, &derived, &names, lengths, start)?;
        let vtk = match job.vtk {
            // Frames that were written after the checkpoint are written again.
            Some(interval) => {
                let last = (from.vtk_frames as f64 - 0.5) * interval;
                Some(Series::resume(&job.out.join("paraview"), last)?)
            }
            None => None,
        };
        Ok(Self {
            scene,
            job,
            derived,
            tables,
            vtk,
            apertures: from.screening.apertures(),
            screening: from.screening,
            gone: from.gone,
            frames: from.frames,
            vtk_frames: from.vtk_frames,
            rows: from.rows,
            before: from.elapsed,
            budget: from.budget,
            limit: from.limit,
            guard: Guard::new(scene, simulation.boundary(), &from.class),
            spent: from.spent,
            fault: None,
            gone_wrong: None,
            saved: Cell::new(simulation.time()),
            simulation,
        })
    }
}
