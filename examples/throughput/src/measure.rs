//! Timing a simulation.

use std::time::Instant;

use pendular::MeshWalls;
use pendular::dem::{DVec3, PairTerm, Particles, Settings, Simulation, SimulationError};

/// What a measurement gives.
pub(crate) struct Measured {
    pub(crate) particles: usize,
    pub(crate) seconds: f64,
    /// Peak resident memory up to the end of the run, MB.
    pub(crate) memory: f64,
    /// State and profile at the end, for people.
    pub(crate) check: String,
    /// Centres at the end, as CSV.
    pub(crate) centres: String,
}

/// Runs `warm` steps, then times `steps`.
pub(crate) fn run<T: PairTerm>(
    particles: Particles,
    term: T,
    walls: MeshWalls,
    settings: Settings,
    warm: u64,
    steps: u64,
) -> Result<Measured, SimulationError> {
    let mut simulation = Simulation::new(particles, term, walls, settings)?;
    simulation.advance(warm)?;
    let (before, passed) = (simulation.profile(), simulation.passes());
    let start = Instant::now();
    simulation.advance(steps)?;
    let seconds = start.elapsed().as_secs_f64();
    let (after, memory) = (simulation.profile(), peak_memory());
    let (mut contacts, mut overlap, mut pairs) = (0_u64, 0.0, 0_u64);
    simulation.for_each_pair(|encounter, _| {
        pairs += 1;
        if encounter.gap < 0.0 {
            contacts += 1;
            overlap -= encounter.gap;
        }
    });
    let (n, passes) = (simulation.particles().len(), simulation.passes());
    let part = |a: std::time::Duration, b: std::time::Duration| (a - b).as_secs_f64();
    let check = format!(
        "kinetic energy {:.6e} J, mean overlap {:.4e} m, mean coordination {:.4}, pairs held {}\n\
         neighbours {:.3} s ({} builds, {} prunes), pairs {:.3} s, walls {:.3} s, settling {:.3} s, \
         integration {:.3} s, resistance {:.3} s, {:.2} passes a step",
        simulation.particles().kinetic_energy(),
        overlap / contacts.max(1) as f64,
        2.0 * contacts as f64 / n as f64,
        pairs,
        part(after.neighbours, before.neighbours),
        after.builds - before.builds,
        after.prunes - before.prunes,
        part(after.pairs, before.pairs),
        part(after.walls, before.walls),
        part(after.settling, before.settling),
        part(after.integration, before.integration),
        part(after.resistance, before.resistance),
        (passes.passes - passed.passes) as f64 / (passes.steps - passed.steps).max(1) as f64,
    );
    let centres = centres(&simulation);
    Ok(Measured { particles: n, seconds, memory, check, centres })
}

fn centres<T: PairTerm>(simulation: &Simulation<T, MeshWalls>) -> String {
    let mut all: Vec<_> = simulation.particles().iter().map(|p| (p.id, p.position)).collect();
    all.sort_by_key(|(id, _)| *id);
    let row = |(id, x): &(u32, DVec3)| format!("{id},{:e},{:e},{:e}\n", x.x, x.y, x.z);
    std::iter::once("id,x,y,z\n".to_owned()).chain(all.iter().map(row)).collect()
}

/// Peak resident memory of this process, MB; 0 where the system does not say.
fn peak_memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok());
    kilobytes.unwrap_or(0.0) / 1024.0
}
