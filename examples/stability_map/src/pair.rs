//! Two wet spheres that bounce in the well of their bridge.

use pendular::dem::DVec3;

use crate::case::Outcome;
use crate::edge::Edge;
use crate::impact::RADIUS;
use crate::rig::{Fault, Matter, mass, stored};
use crate::row::{self, NEAR};

/// Longest time, s, and longest in limits: a very viscous pair is at rest long before.
const TIME: f64 = 5e-3;
const LIMITS: f64 = 2000.0;

/// The edge of the pair at rest, held together by its bridge.
pub(crate) fn edge(matter: &Matter) -> Result<Edge, Fault> {
    row::edge(2, matter)
}

/// The pair parts from near contact with half the speed that it needs to escape.
///
/// Error: the largest rise of the total energy over its lowest so far, over the depth of the well.
/// State: kinetic energy at the end over that depth.
pub(crate) fn run(matter: &Matter, h: f64, limit: f64) -> Result<Outcome, Fault> {
    let mut formed = row::scene(row::row(2, NEAR), matter, 1e-12)?;
    formed.advance(1)?;
    let well = -stored(&formed);
    let speed = 0.5 * (2.0 * well / (0.5 * mass(RADIUS))).sqrt();
    let mut spheres = row::row(2, NEAR);
    spheres[0].2 = -0.5 * speed * DVec3::X;
    spheres[1].2 = 0.5 * speed * DVec3::X;
    let mut scene = row::scene(spheres, matter, h)?;
    // The bridge forms in the first step and releases its energy: booked, not from nowhere.
    scene.advance(1)?;
    let steps = (TIME.min(LIMITS * limit) / h).ceil() as u64;
    let Ok(rise) = row::rise(&mut scene, steps) else {
        return Ok(Outcome { error: f64::INFINITY, state: f64::INFINITY });
    };
    Ok(Outcome { error: rise / well, state: scene.particles().kinetic_energy() / well })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rig::{Drag, Film};

    #[test]
    fn the_limit_of_a_viscous_pair_is_its_edge_times_the_safety() {
        let matter = Matter {
            stiffness: 1e4,
            restitution: 0.8,
            liquid: Some(Film::thin(10.0)),
            drag: Drag::Explicit,
        };
        let found = edge(&matter).unwrap();
        assert_eq!(found.term, "viscous drag");
        assert!((found.limit / found.edge - 0.7).abs() < 0.01, "{found:?}");
    }

    #[test]
    fn a_fine_step_makes_no_energy_and_ends_at_rest() {
        let matter = Matter {
            stiffness: 1e4,
            restitution: 0.5,
            liquid: Some(Film::thin(1e-2)),
            drag: Drag::Explicit,
        };
        let limit = edge(&matter).unwrap().limit;
        let fine = run(&matter, 0.05 * limit, limit).unwrap();
        assert!(fine.error < 0.01 && fine.state < 1e-3, "{fine:?}");
    }
}
