//! Bad input is a typed error.

use pendular_contact::Linear;
use pendular_dem_core::{
    Class, Contact, DVec3, MOST_THREADS, NoWalls, PairContact, ParticleError, Particles, Partner,
    Settings, Simulation, SimulationError,
};

use crate::bed::{RUB, Tray, contact};

fn one() -> Particles {
    let mut particles = Particles::new(vec![Class::new(1e-3, 2500.0, 0).unwrap()]).unwrap();
    particles.push(0, DVec3::Z * 2e-3, DVec3::ZERO, DVec3::ZERO).unwrap();
    particles
}

#[test]
fn classes_and_particles() {
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(
            Class::new(radius, 1.0, 0),
            Err(ParticleError::Class { quantity: "radius", .. })
        ));
    }
    let mut particles = one();
    let nan = DVec3::new(0.0, f64::NAN, 0.0);
    assert!(matches!(
        particles.push(0, nan, DVec3::ZERO, DVec3::ZERO),
        Err(ParticleError::NotFinite { quantity: "position", id: 1 })
    ));
    assert!(matches!(
        particles.push(1, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO),
        Err(ParticleError::UnknownClass { class: 1, classes: 1 })
    ));
    assert_eq!(particles.len(), 1);
}

#[test]
fn a_step_too_long_names_the_class_and_the_limit() {
    let particles = one();
    let term = contact(particles.classes(), RUB);
    let error = Simulation::new(particles, term, NoWalls, Settings::new(1e-3)).unwrap_err();
    let said = error.to_string();
    let SimulationError::TimeStep { allowed, class, term, .. } = error else { panic!("{said}") };
    assert!(class == 0 && allowed > 1e-6 && allowed < 1e-4 && term.contains("contact"));
    assert!(said.contains("class 0"), "{said}");
}

#[test]
fn the_limit_lies_below_the_edge_of_one_contact_and_within_reach_of_it() {
    let particles = one();
    let term = contact(particles.classes(), RUB);
    let mass = particles.classes()[0].mass();
    let simulation = Simulation::new(particles, term, NoWalls, Settings::new(1e-7)).unwrap();
    let single = 2.0 * (0.5 * mass / RUB.stiffness).sqrt();
    let share = simulation.limit().time_step / single;
    assert!(share > 0.2 && share < 0.6, "{share}");
}

#[test]
fn overlaps_at_the_start_are_refused() {
    let mut particles = one();
    particles.push(0, DVec3::Z * 3.5e-3, DVec3::ZERO, DVec3::ZERO).unwrap();
    let term = contact(particles.classes(), RUB);
    let error = Simulation::new(particles, term, NoWalls, Settings::new(1e-6)).unwrap_err();
    assert!(matches!(error, SimulationError::StartOverlap { .. }), "{error}");
    let mut sunk = Particles::new(vec![Class::new(1e-3, 2500.0, 0).unwrap()]).unwrap();
    sunk.push(0, DVec3::Z * 5e-4, DVec3::ZERO, DVec3::ZERO).unwrap();
    let term = contact(sunk.classes(), RUB);
    let error = Simulation::new(sunk, term, Tray::still(None), Settings::new(1e-6)).unwrap_err();
    assert!(matches!(error, SimulationError::StartOverlap { .. }), "{error}");
}

#[test]
fn walls_of_a_material_without_law_are_refused() {
    let law = PairContact {
        normal: Linear::from_restitution(1e4, 0.8, 1e-6).unwrap(),
        friction: 0.0,
        rolling_friction: 0.0,
        tangential_damping: 0.0,
    };
    for (materials, good) in [(0, false), (1, true), (2, true)] {
        let term = Contact::new(one().classes(), materials, move |_, _| law, move |_, _| law);
        let set_up = Simulation::new(one(), (term, ()), Tray::still(None), Settings::new(1e-7));
        match set_up {
            Ok(_) => assert!(good),
            Err(SimulationError::WallMaterial { material: 0, known: 0 }) => assert!(!good),
            Err(other) => panic!("{other}"),
        }
    }
}

#[test]
fn the_deepest_overlap_says_who() {
    let mut particles = one();
    particles.push(0, DVec3::Z * 3.98e-3, DVec3::ZERO, DVec3::ZERO).unwrap();
    let term = contact(particles.classes(), RUB);
    let tray = Tray { height: 0.99e-3, ..Tray::still(None) };
    let simulation = Simulation::new(particles, term, tray, Settings::new(1e-6)).unwrap();
    let (share, encounter) = simulation.deepest().unwrap();
    assert!((share - 0.02).abs() < 1e-9, "{share}");
    assert_eq!((encounter.first, encounter.second), (0, Partner::Particle(1)));
}

#[test]
fn settings_that_make_no_sense() {
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let term = contact(one().classes(), RUB);
        let error = Simulation::new(one(), term, NoWalls, Settings::new(step)).unwrap_err();
        assert!(matches!(error, SimulationError::Setting { quantity: "time step", .. }));
    }
    for pass_tolerance in [0.0, f64::NAN] {
        let (term, settings) = (contact(one().classes(), RUB), Settings::new(1e-7));
        let settings = Settings { pass_tolerance, ..settings };
        let error = Simulation::new(one(), term, NoWalls, settings).unwrap_err();
        assert!(matches!(error, SimulationError::Setting { quantity: "pass tolerance", .. }));
    }
    for threads in [0, MOST_THREADS + 1, usize::MAX] {
        let (term, settings) = (contact(one().classes(), RUB), Settings::new(1e-7));
        let error = Simulation::new(one(), term, NoWalls, Settings { threads, ..settings });
        let said = error.unwrap_err().to_string();
        assert_eq!(said, format!("could not start {threads} threads: allowed: 1 to 1024"));
    }
}

#[test]
fn an_unstable_run_stops_instead_of_going_on_with_nan() {
    let mut particles = one();
    for k in 1..4 {
        let at = DVec3::Z * (2e-3 + 1.999e-3 * f64::from(k));
        particles.push(0, at, DVec3::ZERO, DVec3::ZERO).unwrap();
    }
    let term = contact(particles.classes(), RUB);
    let settings = Settings { allow_unstable: true, ..Settings::new(1e150) };
    let mut simulation = Simulation::new(particles, term, Tray::still(None), settings).unwrap();
    let error = simulation.advance(100).unwrap_err();
    assert!(matches!(error, SimulationError::NotFinite { .. }), "{error}");
    let again = simulation.advance(1).unwrap_err();
    assert!(matches!(again, SimulationError::Failed { .. }), "{again}");
}

#[test]
fn particles_leave_and_their_ids_stay() {
    let mut particles = one();
    particles.push(0, DVec3::Z * 0.05, DVec3::ZERO, DVec3::ZERO).unwrap();
    let term = contact(particles.classes(), RUB);
    let domain = Some((DVec3::splat(-0.1), DVec3::new(0.1, 0.1, 0.049)));
    let settings = Settings { domain, ..Settings::new(1e-6) };
    let mut simulation = Simulation::new(particles, term, Tray::still(None), settings).unwrap();
    simulation.advance(64).unwrap();
    let gone = simulation.take_departures();
    assert_eq!((gone.len(), gone[0].particle.id), (1, 1));
    assert!(simulation.particles().get(0).is_some() && simulation.particles().get(1).is_none());
    simulation.advance(64).unwrap();
    assert!(simulation.take_departures().is_empty());
}
