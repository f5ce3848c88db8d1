//! Rolling friction: a POM sphere of 5 mm on a plane, critical slope 1.37 degrees.

use pendular_dem_core::{Class, DVec3, PairTerm, Particles, Settings, Simulation};

use crate::bed::{RUB, Rub, Tray, contact};

const RADIUS: f64 = 2.5e-3;
const ARM: f64 = 5.97e-5;
const GRAVITY: f64 = 9.81;
const STEP: f64 = 2e-6;

/// The sphere at its rest overlap, rolling at `speed`, on a plane that is inclined by `slope`.
fn rolling(speed: f64, slope: f64, sliding: f64) -> Simulation<impl PairTerm, Tray> {
    let rub = Rub { stiffness: 1e5, friction: 0.3484, rolling: ARM, sliding, ..RUB };
    let class = Class::new(RADIUS, 1358.0, 0).unwrap();
    let gravity = GRAVITY * DVec3::new(slope.sin(), 0.0, -slope.cos());
    let centre = RADIUS + class.mass() * gravity.z / rub.stiffness;
    let mut particles = Particles::new(vec![class]).unwrap();
    let spin = DVec3::Y * speed / RADIUS;
    particles.push(0, DVec3::Z * centre, DVec3::X * speed, spin).unwrap();
    let term = contact(&[class], rub);
    let settings = Settings { gravity, ..Settings::new(STEP) };
    Simulation::new(particles, term, Tray::still(None), settings).unwrap()
}

/// Speed of the centre and of the surface by spin, m/s.
fn speeds<T: PairTerm>(simulation: &Simulation<T, Tray>) -> f64 {
    let p = simulation.particles().get(0).unwrap();
    p.velocity.length().max(RADIUS * p.spin.length())
}

#[test]
fn a_sphere_stops_at_the_exact_time_and_stands_still() {
    // a = g μ_roll/(1.4 r): 0.05 m/s last for 0.2988 s.
    let exact = 0.05 * 1.4 * RADIUS / (GRAVITY * ARM);
    assert!((exact - 0.2988).abs() < 5e-5);
    let mut simulation = rolling(0.05, 0.0, 0.3);
    let mut stopped = f64::INFINITY;
    while simulation.time() < 0.31 {
        simulation.advance(25).unwrap();
        // A tenth of a millimetre per second is lost in 0.6 ms.
        if speeds(&simulation) < 1e-4 {
            stopped = stopped.min(simulation.time());
        }
    }
    let expected = exact - 1e-4 / 0.05 * exact;
    assert!((stopped - expected).abs() < 2e-4, "{stopped} {expected}");
    simulation.advance(50_000).unwrap();
    assert!(speeds(&simulation) < 1e-12, "{:e}", speeds(&simulation));
}

#[test]
fn no_creep_at_half_the_critical_slope_and_the_right_acceleration_at_twice() {
    let critical = (ARM / RADIUS).atan();
    let place = |s: &Simulation<_, Tray>| s.particles().get(0).unwrap().position.x;
    let mut held = rolling(0.0, 0.5 * critical, 0.3);
    held.advance(25_000).unwrap();
    let before = place(&held);
    held.advance(100_000).unwrap();
    let crept = place(&held) - before;
    assert!(crept.abs() < 1e-12, "crept {crept:e} m in 0.2 s");
    let slope = 2.0 * critical;
    let mut free = rolling(0.0, slope, 0.3);
    let speed = |s: &Simulation<_, Tray>| s.particles().get(0).unwrap().velocity.x;
    free.advance(25_000).unwrap();
    let before = speed(&free);
    free.advance(100_000).unwrap();
    let found = (speed(&free) - before) / 0.2;
    let exact = GRAVITY / 1.4 * (slope.sin() - slope.cos() * ARM / RADIUS);
    assert!((found / exact - 1.0).abs() < 2e-4, "{found} {exact}");
}
