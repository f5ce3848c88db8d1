//! Looks at all pairs between two steps.

use pendular_dem_core::{Class, DVec3, NoWalls, Pair, Particles, Partner, Settings, Simulation};

use crate::bed::{RUB, Rub, Tray, block, contact};

/// Three spheres in a row, each overlapping the next by 1 µm, the last one beside them.
fn row() -> Particles {
    let class = Class::new(1e-3, 2500.0, 0).unwrap();
    let mut particles = Particles::new(vec![class]).unwrap();
    for x in [0.0, 1.999e-3, 3.998e-3, 9e-3] {
        particles.push(0, DVec3::X * x, DVec3::ZERO, DVec3::ZERO).unwrap();
    }
    particles
}

#[test]
fn a_survey_sees_every_touching_pair_once_and_what_acts_in_it() {
    let particles = row();
    let term = contact(particles.classes(), Rub { rolling: 1e-5, ..RUB });
    let settings = Settings { gravity: DVec3::ZERO, ..Settings::new(1e-6) };
    let mut simulation = Simulation::new(particles, term, NoWalls, settings).unwrap();
    simulation.advance(1).unwrap();
    let mut seen = Vec::new();
    simulation.survey(|pair: &Pair, spring| {
        let forces = simulation.term().forces(pair, spring);
        let elastic = RUB.stiffness * -pair.encounter.gap;
        // The spheres move apart by now: the dashpot takes a little off the spring's force.
        assert!(forces.normal > 0.9 * elastic && forces.normal < elastic, "{forces:?}");
        let power = (elastic - forces.normal) * pair.separation_speed;
        assert!((forces.normal_power / power - 1.0).abs() < 1e-9);
        seen.push((pair.encounter.first, pair.encounter.second));
    });
    seen.sort_unstable();
    assert_eq!(seen, [(0, Partner::Particle(1)), (1, Partner::Particle(2))]);
}

#[test]
fn the_limit_as_it_is_counts_the_contacts_there_are() {
    let particles = row();
    let mass = particles.classes()[0].mass();
    let term = contact(particles.classes(), Rub { restitution: 1.0, ..RUB });
    let settings = Settings { gravity: DVec3::ZERO, ..Settings::new(1e-6) };
    let mut simulation = Simulation::new(particles, term, NoWalls, settings).unwrap();
    simulation.advance(1).unwrap();
    // The row's own fastest motion: the middle against both ends, 3 k_n/m. The bound comes from below.
    let exact = 0.9 * 2.0 / (3.0 * RUB.stiffness / mass).sqrt();
    let now = simulation.limit_now().time_step;
    assert!(now < exact && now > 0.995 * exact, "{now} {exact}");
    assert!(now > simulation.limit().time_step);
}

#[test]
fn the_limit_of_one_pair_and_of_a_sphere_at_a_wall_is_exact() {
    let class = Class::new(1e-3, 2500.0, 0).unwrap();
    let mass = class.mass();
    for (second, reduced) in [(true, 0.5 * mass), (false, mass)] {
        let mut particles = Particles::new(vec![class]).unwrap();
        // The pair hangs in the air.
        let height = if second { 5e-3 } else { 0.9999e-3 };
        particles.push(0, DVec3::Z * height, DVec3::ZERO, DVec3::ZERO).unwrap();
        if second {
            let above = DVec3::Z * (height + 1.9999e-3);
            particles.push(0, above, DVec3::ZERO, DVec3::ZERO).unwrap();
        }
        let term = contact(&[class], Rub { restitution: 1.0, ..RUB });
        let settings = Settings { gravity: DVec3::ZERO, ..Settings::new(1e-6) };
        let tray = Tray::still(None);
        let mut simulation = Simulation::new(particles, term, tray, settings).unwrap();
        simulation.advance(1).unwrap();
        // k_t = 2/7 k_n: across it 3.5 k_t = k_n as well.
        let expected = 0.9 * 2.0 / (RUB.stiffness / reduced).sqrt();
        let now = simulation.limit_now().time_step;
        assert!((now / expected - 1.0).abs() < 1e-12, "{second}: {now} {expected}");
    }
}

#[test]
fn a_survey_is_the_same_on_any_number_of_threads() {
    let look = |threads| {
        let settings = Settings { threads, ..Settings::new(2e-6) };
        let particles = block(11, 0.1, 5);
        let term = contact(particles.classes(), RUB);
        let tray = Tray::still(Some(2e-2));
        let mut simulation = Simulation::new(particles, term, tray, settings).unwrap();
        simulation.advance(3000).unwrap();
        let mut seen = Vec::new();
        simulation
            .survey(|pair, _| seen.push((pair.encounter.second, pair.encounter.gap.to_bits())));
        assert!(seen.iter().any(|(second, _)| matches!(second, Partner::Wall(_))));
        seen
    };
    assert_eq!(look(1), look(3));
}
