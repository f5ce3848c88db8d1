//! No list may miss a contact.

use std::collections::BTreeSet;

use pendular_dem_core::Partner;

use crate::bed::{RUB, shaken};

#[test]
fn lists_hold_every_contact_of_a_violently_shaken_bed() {
    let mut simulation = shaken(5, |_| (), RUB);
    for round in 0..200 {
        simulation.advance(50).unwrap();
        let mut listed = BTreeSet::new();
        simulation.for_each_pair(|encounter, _| {
            if let Partner::Particle(second) = encounter.second {
                assert!(listed.insert((encounter.first, second)), "listed twice");
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
    }
    assert!(simulation.profile().builds > 5);
}
