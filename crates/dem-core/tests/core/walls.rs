//! Moving walls.

use pendular_dem_core::{Class, DVec3, Particles, Settings, Simulation};

use crate::bed::{RUB, Rub, Tray, contact};

#[test]
fn a_grain_at_rest_on_a_gently_shaken_plate_moves_with_it() {
    // Below 1 g the grain never leaves the plate; its speed is the plate's.
    let class = Class::new(1e-3, 2500.0, 0).unwrap();
    let mut particles = Particles::new(vec![class]).unwrap();
    let rub = Rub { stiffness: 1e5, restitution: 0.3, ..RUB };
    let sag = class.mass() * 9.81 / rub.stiffness;
    let (amplitude, frequency) = (5e-5, 50.0);
    let w = std::f64::consts::TAU * frequency;
    particles.push(0, DVec3::Z * (1e-3 - sag), DVec3::Z * amplitude * w, DVec3::ZERO).unwrap();
    let term = contact(particles.classes(), rub);
    let tray = Tray { half: None, amplitude, frequency, height: 0.0, speed: 0.0 };
    let mut simulation = Simulation::new(particles, term, tray, Settings::new(1e-6)).unwrap();
    for _ in 0..100 {
        simulation.advance(1_000).unwrap();
        let p = simulation.particles().get(0).unwrap();
        let t = simulation.time();
        let plate = amplitude * (w * t).sin();
        assert!((p.position.z - plate - 1e-3 + sag).abs() < 2e-8, "{t}");
        let speed = amplitude * w * (w * (t - 5e-7)).cos();
        assert!((p.velocity.z - speed).abs() < 1e-5, "{t}");
    }
}
