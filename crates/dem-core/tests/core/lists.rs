//! No list may miss a contact.

use std::collections::BTreeSet;

use pendular_dem_core::{Boundary, Partner};

use crate::bed::{RUB, shaken};

#[test]
fn lists_hold_every_contact_of_a_violently_shaken_bed_and_its_walls() {
    let mut simulation = shaken(5, |_| (), RUB);
    let mut touched = 0;
    for round in 0..1_000 {
        simulation.advance(10).unwrap();
        let mut listed = BTreeSet::new();
        simulation.for_each_pair(|encounter, _| {
            if let Partner::Particle(second) = encounter.second {
                assert!(listed.insert((encounter.first, second)), "listed twice");
            }
        });
        let mut at_walls = BTreeSet::new();
        simulation.survey(|pair, _| {
            if let Partner::Wall(part) = pair.encounter.second {
                assert!(at_walls.insert((pair.encounter.first, part)), "listed twice");
            }
        });
        // The lists serve the read at the next step; what touches now touches there too, but for
        // what the last drift has just closed or opened.
        let particles: Vec<_> = simulation.particles().iter().collect();
        let radius = |c: u16| simulation.particles().classes()[usize::from(c)].radius();
        let drift = 2.0 * 5e-6;
        for (k, a) in particles.iter().enumerate() {
            for b in &particles[..k] {
                let gap = (a.position - b.position).length() - radius(a.class) - radius(b.class);
                let key = (a.id.min(b.id), a.id.max(b.id));
                if gap < -drift {
                    assert!(listed.contains(&key), "round {round}: {key:?} at {gap:e} is missed");
                }
            }
        }
        let drift = (1.0 + simulation.boundary().speed_bound()) * 5e-6;
        for particle in &particles {
            for part in 0..5 {
                let (normal, offset) = simulation.boundary().plane(part);
                let gap = particle.position.dot(normal) - offset - radius(particle.class);
                if gap < -drift {
                    touched += 1;
                    let key = (particle.id, part);
                    assert!(at_walls.contains(&key), "round {round}: wall {key:?} at {gap:e}");
                }
            }
        }
    }
    assert!(touched > 100, "walls are hit: {touched}");
    assert_eq!(simulation.step(), 10_000);
    assert!(simulation.profile().builds > 5);
}
