//! The same bits, whatever the threads and the skins.

use pendular_contact::Linear;
use pendular_dem_core::{Contact, Settings, Simulation};

use crate::bed::{RUB, Rub, Tray, block, contact, shaken};

fn state<T: pendular_dem_core::PairTerm>(simulation: &Simulation<T, Tray>) -> Vec<u64> {
    let mut all: Vec<_> = simulation.particles().iter().collect();
    all.sort_by_key(|p| p.id);
    all.iter()
        .flat_map(|p| [p.position, p.velocity, p.spin])
        .flat_map(|v| v.to_array())
        .map(f64::to_bits)
        .collect()
}

fn run(change: impl FnOnce(&mut Settings)) -> Vec<u64> {
    let rub = Rub { rolling: 2e-5, ..RUB };
    let mut simulation: Simulation<Contact<Linear>, Tray> = shaken(13, change, rub);
    simulation.advance(2_000).unwrap();
    state(&simulation)
}

#[test]
fn threads_do_not_change_a_bit() {
    // 2197 spheres are four chunks.
    let one = run(|_| ());
    for threads in [2, 3, 8] {
        assert!(run(|s| s.threads = threads) == one, "{threads} threads");
    }
}

#[test]
fn skins_do_not_change_a_bit() {
    let one = run(|_| ());
    for (outer, inner) in [(1e-4, 1e-4), (3e-4, 1e-5), (8e-4, 5e-5), (5e-5, 2e-6)] {
        let other = run(|s| (s.skin, s.inner_skin) = (Some(outer), Some(inner)));
        assert!(other == one, "skins {outer} {inner}");
    }
}

#[test]
fn an_absent_term_is_none_to_the_bit() {
    let particles = block(6, 0.3, 9);
    let tray = Tray::still(Some(0.011));
    let settings = Settings::new(5e-6);
    let dry = contact(particles.classes(), RUB);
    let mut alone = Simulation::new(particles.clone(), dry, tray.clone(), settings).unwrap();
    alone.advance(2_000).unwrap();
    let both = (contact(particles.classes(), RUB), None::<Contact<Linear>>);
    let mut with_none = Simulation::new(particles, both, tray, settings).unwrap();
    with_none.advance(2_000).unwrap();
    assert!(state(&alone) == state(&with_none));
}
