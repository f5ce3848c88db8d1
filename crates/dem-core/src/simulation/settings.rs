//! What a simulation is told, and whether it can be done.

use glam::DVec3;

use crate::limit::Limit;
use crate::particles::Particles;
use crate::{Boundary, PairTerm, SimulationError};

/// What a simulation needs to know besides bodies and laws.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Time step, s.
    pub time_step: f64,
    /// Gravity, m/s².
    pub gravity: DVec3,
    /// Threads, 1 to [`crate::MOST_THREADS`]; results do not depend on them. Those beyond one wait for
    /// work without sleeping while [`crate::Simulation::advance`] runs.
    pub threads: usize,
    /// Corners of the box that particles may be in, m; one outside leaves the scene.
    pub domain: Option<(DVec3, DVec3)>,
    /// Skin of the outer neighbour lists, m; `None` chooses it. Results do not depend on it.
    pub skin: Option<f64>,
    /// Skin of the active lists, m; `None` chooses it. Results do not depend on it.
    pub inner_skin: Option<f64>,
    /// Largest overlap at the start, as a share of the smaller radius.
    pub start_overlap: f64,
    /// An implicit term's passes over all pairs stop when further ones are to change the impulses by less
    /// than this share of them, more than 0. Results depend on it a little.
    pub pass_tolerance: f64,
    /// Goes on with a time step above the stability limit.
    pub allow_unstable: bool,
}

impl Settings {
    /// Earth's gravity along −z, one thread, no bounds, at most 5 % overlap at the start, passes down to
    /// changes of 1 %.
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
            pass_tolerance: 1e-2,
            allow_unstable: false,
        }
    }
}

/// Refuses walls of a material that the term does not know.
pub(super) fn check_walls<T: PairTerm, B: Boundary>(
    term: &T,
    boundary: &B,
) -> Result<(), SimulationError> {
    match (boundary.materials(), term.wall_materials()) {
        (used, Some(known)) if used > known => {
            Err(SimulationError::WallMaterial { material: used - 1, known })
        }
        _ => Ok(()),
    }
}

/// The stability limit, if the settings can be used.
pub(super) fn check<T: PairTerm>(
    particles: &Particles,
    term: &T,
    settings: &Settings,
) -> Result<Limit, SimulationError> {
    let given = [
        ("time step", Some(settings.time_step)),
        ("skin", settings.skin),
        ("inner skin", settings.inner_skin),
        ("start overlap", Some(settings.start_overlap)),
        ("pass tolerance", Some(settings.pass_tolerance)),
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
