//! Where a scene at rest stops being stable: found by running it.

use crate::rig::{Fault, Scene, stored};

/// Kinetic energy over that of the disturbance at a short step which no stable scene reaches: a
/// disturbance at 0.99 of the edge beats by a factor of 50 at most.
const GROWTH: f64 = 100.0;
/// Steps at which the disturbance itself is measured.
const BASE: u64 = 400;
/// The edge is sought between these multiples of the predicted limit.
const SPAN: (f64, f64) = (0.25, 8.0);
/// Halvings of that interval, in logarithms: 3 ‰.
const HALVINGS: u32 = 10;

/// The limit that the library predicts and the edge that is found.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    /// `Simulation::limit_now` of the scene at rest, s, safety included.
    pub(crate) limit: f64,
    /// `Simulation::limit`, s: twelve contacts, known before the run.
    pub(crate) packed: f64,
    /// Longest step at which a disturbance does not grow, s.
    pub(crate) edge: f64,
    /// What sets the limit.
    pub(crate) term: &'static str,
}

impl Edge {
    /// Whether the limit lies inside the stable region and within a factor of 2 of its edge.
    pub(crate) fn holds(&self) -> bool {
        (1.0..=2.0).contains(&(self.edge / self.limit)) && self.packed <= self.edge
    }
}

/// Largest kinetic energy within `steps`, J; infinite where the scene is no longer finite.
fn liveliest(scene: &mut Scene, steps: u64) -> f64 {
    let mut most = 0.0;
    for _ in 0..steps {
        if scene.advance(1).is_err() {
            return f64::INFINITY;
        }
        most = f64::max(most, scene.particles().kinetic_energy());
    }
    most
}

/// Kinetic, stored and potential energy, J.
fn energy(scene: &Scene) -> f64 {
    let (particles, gravity) = (scene.particles(), scene.gravity());
    let mass = |class: u16| particles.classes()[usize::from(class)].mass();
    let potential = particles.iter().map(|p| -mass(p.class) * gravity.dot(p.position)).sum::<f64>();
    particles.kinetic_energy() + stored(scene) + potential
}

/// Whether within `steps` more energy than `enough`, J, comes from nowhere. A sphere that slips into
/// a gap is lively too, but has its energy from its weight.
fn grows(scene: &mut Scene, steps: u64, enough: f64) -> bool {
    // Bridges form in the first step.
    if scene.advance(1).is_err() {
        return true;
    }
    let start = energy(scene);
    let mut lively = enough;
    for _ in 0..steps {
        if scene.advance(1).is_err() {
            return true;
        }
        let kinetic = scene.particles().kinetic_energy();
        if kinetic > lively {
            if energy(scene) - start > 0.5 * enough {
                return true;
            }
            lively = 1.1 * kinetic;
        }
    }
    false
}

/// Bisects the edge of a scene at rest: `still` builds it for a time step, `noisy` with a disturbance.
pub(crate) fn find(
    mut still: impl FnMut(f64) -> Result<Scene, Fault>,
    mut noisy: impl FnMut(f64) -> Result<Scene, Fault>,
    steps: u64,
) -> Result<Edge, Fault> {
    // Any step does for a first look; then one that moves nothing.
    let guess = still(1e-9)?.limit().time_step;
    let mut scene = still(1e-3 * guess)?;
    scene.advance(2)?;
    let limit = scene.limit_now();
    let packed = scene.limit().time_step;
    let (mut low, mut high) = (SPAN.0 * limit.time_step, SPAN.1 * limit.time_step);
    let enough = GROWTH * liveliest(&mut noisy(low)?, BASE);
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if grows(&mut noisy(middle)?, steps, enough) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Ok(Edge { limit: limit.time_step, packed, edge: low, term: limit.term })
}
