//! A small sphere rolls out of the crevice between two large ones, and the order of the integrator.

use pendular_contact::{Dashpot, Linear};
use pendular_dem_core::{
    Class, Contact, DVec3, Encounter, Load, NoWalls, Pair, PairContact, PairTerm, Particles,
    Partner, Settings, Simulation, StabilityLoad,
};

use crate::bed::{RUB, Rub, Tray, contact};

const GRAVITY: f64 = 9.81;
const LARGE: f64 = 5e-3;

/// Weight of particle 2, which particle 0 bears: so the large ones need no support.
#[derive(Debug)]
struct Weight(f64);

impl PairTerm for Weight {
    type Column = ();

    fn reach(&self) -> f64 {
        LARGE
    }

    fn idle(&self, encounter: &Encounter, (): &mut ()) -> bool {
        (encounter.first, encounter.second) != (0, Partner::Particle(2))
    }

    fn load(&self, pair: &Pair, (): &mut ()) -> Load {
        // In overlap the contact beside this term decides that nothing is idle.
        if self.idle(&pair.encounter, &mut ()) {
            return Load::default();
        }
        let up = self.0 * DVec3::Z;
        let along = up.dot(pair.normal);
        let shear = up - along * pair.normal;
        // A weight turns nothing: what the shear force would do to the small one is taken back.
        let couple = pair.levers[1] * pair.normal.cross(shear);
        Load { tension: along, shear, couple, ..Load::default() }
    }

    fn live(&self, (): &()) -> bool {
        false
    }

    fn stability(&self, classes: &[Class]) -> Vec<StabilityLoad> {
        vec![StabilityLoad::default(); classes.len()]
    }
}

/// Angle from the top at which the small sphere has left its track by 2 % of the track's radius.
fn lift_off(ratio: f64, steps_per_contact: f64) -> f64 {
    let small = LARGE / ratio;
    let classes = [Class::new(LARGE, 1e15, 0).unwrap(), Class::new(small, 2500.0, 0).unwrap()];
    let track = ((LARGE + small).powi(2) - LARGE * LARGE).sqrt();
    let mut particles = Particles::new(classes.to_vec()).unwrap();
    for side in [-1.0, 1.0] {
        particles.push(0, DVec3::X * side * LARGE, DVec3::ZERO, DVec3::ZERO).unwrap();
    }
    let (sin, cos) = 1_f64.to_radians().sin_cos();
    let top = track * DVec3::new(0.0, sin, cos);
    particles.push(1, top, DVec3::ZERO, DVec3::ZERO).unwrap();
    let mass = classes[1].mass();
    let normal = Linear::from_restitution_with(1e4, 0.5, mass, Dashpot::MayPull).unwrap();
    let normal = normal.with_tangential_ratio(0.8235).unwrap();
    let law = PairContact { normal, friction: 0.5, rolling_friction: 0.0, tangential_damping: 0.0 };
    let contact = Contact::new(&classes, 0, move |_, _| law, |_, _| law);
    let h = std::f64::consts::PI * (mass / 1e4).sqrt() / steps_per_contact;
    let settings = Settings { gravity: DVec3::ZERO, ..Settings::new(h) };
    let term = (contact, Weight(mass * GRAVITY));
    let mut simulation = Simulation::new(particles, term, NoWalls, settings).unwrap();
    let stride = (2e-5 / h).ceil() as u64;
    while simulation.time() < 2.0 {
        simulation.advance(stride).unwrap();
        let at = simulation.particles().get(2).unwrap().position;
        if at.y.hypot(at.z) > 1.02 * track {
            return at.y.atan2(at.z).to_degrees();
        }
    }
    f64::INFINITY
}

/// With the normal of the full step a sphere of ratio 10 and more is drawn into the crevice and
/// never leaves. The angles are those of an independent program with half-step normals, good to 0.1
/// degrees over its steps; the rest is the stride in which this test looks.
#[test]
fn a_small_sphere_leaves_the_crevice_at_any_size_ratio() {
    for (ratio, steps, expected) in [
        (2.0, 50.0, 75.6),
        (5.0, 50.0, 78.5),
        (10.0, 50.0, 82.4),
        (20.0, 20.0, 88.6),
        (50.0, 20.0, 102.1),
    ] {
        let angle = lift_off(ratio, steps);
        assert!((angle - expected).abs() < 0.6, "ratio {ratio}: {angle} for {expected}");
    }
}

/// Height of a sphere that bounces on its contact spring without leaving the floor, minus the exact
/// one, at a time that all steps share.
fn deviation(steps: u64, restitution: f64) -> f64 {
    let (radius, stiffness) = (2.5e-3, 1e4);
    let class = Class::new(radius, 1358.0, 0).unwrap();
    let rest = radius - class.mass() * GRAVITY / stiffness;
    let amplitude = 0.5 * (radius - rest);
    let rub = Rub { stiffness, restitution, friction: 0.0, ..RUB };
    let mut particles = Particles::new(vec![class]).unwrap();
    particles.push(0, DVec3::Z * (rest + amplitude), DVec3::ZERO, DVec3::ZERO).unwrap();
    let law = Linear::from_restitution(stiffness, restitution, class.mass()).unwrap();
    let damping = pendular_contact::NormalContact::damping(&law, 0.0);
    let (omega0, decay) = ((stiffness / class.mass()).sqrt(), 0.5 * damping / class.mass());
    let omega = (omega0 * omega0 - decay * decay).sqrt();
    let time = 15.3 / omega0;
    let settings = Settings {
        gravity: DVec3::NEG_Z * GRAVITY,
        allow_unstable: true,
        ..Settings::new(time / steps as f64)
    };
    let term = contact(&[class], rub);
    let mut simulation = Simulation::new(particles, term, Tray::still(None), settings).unwrap();
    simulation.advance(steps).unwrap();
    let swing = (omega * time).cos() + decay / omega * (omega * time).sin();
    let exact = rest + amplitude * (-decay * time).exp() * swing;
    (simulation.particles().get(0).unwrap().position.z - exact) / amplitude
}

#[test]
fn second_order_for_forces_of_position_and_first_for_a_dashpot() {
    for (restitution, order) in [(1.0, 2.0), (0.8, 1.0)] {
        let errors = [60, 120, 240, 480, 960].map(|steps| deviation(steps, restitution).abs());
        for pair in errors.windows(2).skip(1) {
            let found = (pair[0] / pair[1]).log2();
            assert!((found - order).abs() < 0.1, "e {restitution}: {errors:?}, order {found}");
        }
    }
}
