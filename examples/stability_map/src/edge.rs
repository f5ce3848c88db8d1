//! Where a scene at rest stops being stable: found by running it.

use crate::rig::{Fault, Scene};

/// Kinetic energy over the largest at a short step which no stable scene reaches: a disturbance at
/// 0.99 of the edge beats by a factor of 50 at most.
const GROWTH: f64 = 100.0;
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

/// Largest kinetic energy within `steps`, J; looks no further once it is above `enough`. A scene that
/// is no longer finite has an infinite one.
fn liveliest(scene: &mut Scene, steps: u64, enough: f64) -> f64 {
    let mut most = 0.0;
    for _ in 0..steps {
        if scene.advance(1).is_err() {
            return f64::INFINITY;
        }
        most = f64::max(most, scene.particles().kinetic_energy());
        if most > enough {
            break;
        }
    }
    most
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
    // For as long as it is watched at the limit: a sphere that slips into a gap does so at any step.
    let base = (steps as f64 / SPAN.0) as u64;
    let enough = GROWTH * liveliest(&mut noisy(low)?, base, f64::INFINITY);
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        if liveliest(&mut noisy(middle)?, steps, enough) <= enough {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(Edge { limit: limit.time_step, packed, edge: low, term: limit.term })
}
