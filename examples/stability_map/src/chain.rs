//! Three wet spheres in a row: the first runs into two that touch.

use pendular::dem::DVec3;

use crate::case::Outcome;
use crate::edge::Edge;
use crate::impact::{RADIUS, SPEED};
use crate::rig::{Fault, Matter, mass};
use crate::row::{self, NEAR};

const TIME: f64 = 1e-3;
const LIMITS: f64 = 2000.0;

/// The edge of the row at rest.
pub(crate) fn edge(matter: &Matter) -> Result<Edge, Fault> {
    row::edge(3, matter)
}

/// Error: the largest rise of the total energy over its lowest so far, over the energy of the first
/// sphere. State: the last sphere's speed at the end over the first one's at the start.
pub(crate) fn run(matter: &Matter, h: f64, limit: f64) -> Result<Outcome, Fault> {
    let overlap = row::pull(matter)? / matter.stiffness;
    let mut spheres = row::row(3, -overlap);
    spheres[0].1 -= DVec3::X * (NEAR + overlap);
    spheres[0].2 = DVec3::X * SPEED;
    let mut scene = row::scene(spheres, matter, h)?;
    scene.advance(1)?;
    let steps = (TIME.min(LIMITS * limit) / h).ceil() as u64;
    let Ok(rise) = row::rise(&mut scene, steps) else {
        return Ok(Outcome { error: f64::INFINITY, state: f64::INFINITY });
    };
    let last = scene.particles().get(2).map_or(f64::NAN, |p| p.velocity.x);
    Ok(Outcome { error: rise / (0.5 * mass(RADIUS) * SPEED * SPEED), state: last / SPEED })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rig::{Drag, Film};

    #[test]
    fn the_edge_of_a_row_of_three_is_its_fastest_motion() {
        // The middle one against both ends: 3 k_n/m, and nearly no damping.
        let matter = Matter {
            stiffness: 1e4,
            restitution: 0.999,
            liquid: Some(Film::thin(1e-6)),
            drag: Drag::Explicit,
        };
        let found = edge(&matter).unwrap();
        let expected = 2.0 / (3.0 * matter.stiffness / mass(RADIUS)).sqrt();
        assert!((found.edge / expected - 1.0).abs() < 0.01, "{found:?} {expected:e}");
        assert!(found.holds());
    }
}
