//! Single spheres against what mechanics says of them.

use pendular_dem_core::{Class, DVec3, NoWalls, PairTerm, Particles, Settings, Simulation};

use crate::bed::{RUB, Rub, Tray, block, contact};

fn pair(rub: Rub, speed: f64, dt: f64) -> f64 {
    let class = Class::new(2e-3, 2500.0, 0).unwrap();
    let small = Class::new(1e-3, 2500.0, 0).unwrap();
    let mut particles = Particles::new(vec![class, small]).unwrap();
    let v = DVec3::X * speed;
    particles.push(0, DVec3::ZERO, v, DVec3::ZERO).unwrap();
    particles.push(1, DVec3::X * 3.01e-3, -v, DVec3::ZERO).unwrap();
    let term = contact(particles.classes(), rub);
    let settings = Settings { gravity: DVec3::ZERO, ..Settings::new(dt) };
    let mut simulation = Simulation::new(particles, term, NoWalls, settings).unwrap();
    simulation.advance((2e-3 / dt) as u64).unwrap();
    let velocity = |id| simulation.particles().get(id).unwrap().velocity;
    (velocity(1).x - velocity(0).x) / (2.0 * speed)
}

#[test]
fn head_on_restitution_converges_to_what_was_asked_for() {
    for restitution in [0.98, 0.8, 0.5, 0.2] {
        let rub = Rub { restitution, friction: 0.0, ..RUB };
        let e = pair(rub, 0.5, 2e-7);
        assert!((e - restitution).abs() < 2e-3, "{restitution}: {e}");
    }
}

#[test]
fn restitution_one_loses_nothing() {
    let rub = Rub { restitution: 1.0, friction: 0.0, ..RUB };
    assert!((pair(rub, 0.5, 1e-7) - 1.0).abs() < 1e-4);
}

/// One sphere on a floor, in contact at its equilibrium overlap.
fn on_floor(
    rub: Rub,
    velocity: DVec3,
    spin: DVec3,
    gravity: DVec3,
    dt: f64,
) -> Simulation<impl PairTerm, Tray> {
    let class = Class::new(2.5e-3, 1358.0, 0).unwrap();
    let mut particles = Particles::new(vec![class]).unwrap();
    let overlap = class.mass() * -gravity.z / rub.stiffness;
    particles.push(0, DVec3::Z * (2.5e-3 - overlap), velocity, spin).unwrap();
    let term = contact(particles.classes(), rub);
    let settings = Settings { gravity, ..Settings::new(dt) };
    Simulation::new(particles, term, Tray::still(None), settings).unwrap()
}

const DOWN: DVec3 = DVec3::new(0.0, 0.0, -9.81);

#[test]
fn a_sliding_sphere_ends_rolling_with_five_sevenths() {
    // v = v0 − μ g t until t = 2 v0/(7 μ g); then rolling with 5/7 v0.
    // A dashpot ends the ringing of the tangential spring.
    let rub = Rub { friction: 0.3, restitution: 0.5, sliding: 0.1, ..RUB };
    let mut simulation = on_floor(rub, DVec3::X * 0.1, DVec3::ZERO, DOWN, 2e-6);
    simulation.advance(2_500).unwrap();
    let p = simulation.particles().get(0).unwrap();
    let expected = 0.1 - 0.3 * 9.81 * 5e-3;
    assert!((p.velocity.x - expected).abs() < 2e-5, "{} {expected}", p.velocity.x);
    simulation.advance(10_000).unwrap();
    let p = simulation.particles().get(0).unwrap();
    assert!((p.velocity.x - 0.1 * 5.0 / 7.0).abs() < 1e-4, "{}", p.velocity.x);
    assert!((p.spin.y * 2.5e-3 - p.velocity.x).abs() < 1e-3);
}

#[test]
fn oblique_impact_in_full_sliding() {
    // Sliding throughout: Δv_t = μ (1 + e) v_n, and the spin takes 5/2 of it over r.
    let rub = Rub { friction: 0.1, restitution: 0.8, ..RUB };
    let class = Class::new(2.5e-3, 1358.0, 0).unwrap();
    let mut particles = Particles::new(vec![class]).unwrap();
    let v = DVec3::new(1.0, 0.0, -0.3);
    particles.push(0, DVec3::Z * 2.51e-3, v, DVec3::ZERO).unwrap();
    let term = contact(particles.classes(), rub);
    let settings = Settings { gravity: DVec3::ZERO, ..Settings::new(1e-7) };
    let mut simulation = Simulation::new(particles, term, Tray::still(None), settings).unwrap();
    simulation.advance(20_000).unwrap();
    let p = simulation.particles().get(0).unwrap();
    assert!((p.velocity.z - 0.24).abs() < 2e-4, "{}", p.velocity.z);
    let lost = 0.1 * 1.8 * 0.3;
    assert!((p.velocity.x - (1.0 - lost)).abs() < 1e-4, "{}", p.velocity.x);
    assert!((p.spin.y * 2.5e-3 - 2.5 * lost).abs() < 1e-3, "{}", p.spin.y);
}

#[test]
fn a_rolling_sphere_stops_when_rolling_friction_says_so() {
    // a = g μ_roll/(1.4 r): 0.05 m/s stop after 0.2988 s.
    let rub = Rub { stiffness: 1e5, friction: 0.3484, rolling: 5.97e-5, sliding: 0.3, ..RUB };
    let spin = DVec3::Y * (0.05 / 2.5e-3);
    let mut simulation = on_floor(rub, DVec3::X * 0.05, spin, DOWN, 2e-6);
    simulation.advance((0.15 / 2e-6) as u64).unwrap();
    let p = simulation.particles().get(0).unwrap();
    let expected = 0.05 * (1.0 - 0.15 / 0.2988);
    assert!((p.velocity.x - expected).abs() < 2e-4, "{} {expected}", p.velocity.x);
    simulation.advance((0.2 / 2e-6) as u64).unwrap();
    let p = simulation.particles().get(0).unwrap();
    assert!(p.velocity.length() < 1e-9 && p.spin.length() < 1e-6, "{p:?}");
}

#[test]
fn rolling_friction_holds_a_sphere_on_half_the_critical_slope() {
    let critical: f64 = 5.97e-5 / 2.5e-3;
    let rub = Rub { stiffness: 1e5, friction: 0.3484, rolling: 5.97e-5, ..RUB };
    let slope = |share: f64| {
        let angle = (share * critical).atan();
        DVec3::new(9.81 * angle.sin(), 0.0, -9.81 * angle.cos())
    };
    let mut held = on_floor(rub, DVec3::ZERO, DVec3::ZERO, slope(0.5), 2e-6);
    held.advance(100_000).unwrap();
    let p = held.particles().get(0).unwrap();
    assert!(p.position.x < 1e-6, "crept {} m in 0.2 s", p.position.x);
    let mut free = on_floor(rub, DVec3::ZERO, DVec3::ZERO, slope(2.0), 2e-6);
    free.advance(100_000).unwrap();
    // Rolling down at twice the critical slope: a = (5/7) g (sin α − cos α μ_roll/r).
    let expected = 0.2 * 5.0 / 7.0 * 9.81 * critical;
    let p = free.particles().get(0).unwrap();
    assert!((p.velocity.x / expected - 1.0).abs() < 5e-3, "{} {expected}", p.velocity.x);
}

#[test]
fn momentum_is_kept_to_rounding_and_energy_never_grows() {
    let particles = block(6, 0.3, 3);
    let rub = Rub { rolling: 2e-5, ..RUB };
    let term = contact(particles.classes(), rub);
    let settings = Settings { gravity: DVec3::ZERO, ..Settings::new(5e-6) };
    let momentum = |p: &Particles| {
        let mass = |c: u16| p.classes()[usize::from(c)].mass();
        p.iter().map(|one| mass(one.class) * one.velocity).sum::<DVec3>()
    };
    let angular = |p: &Particles| {
        let class = |c: u16| p.classes()[usize::from(c)];
        let one = |one: pendular_dem_core::Particle| {
            let kind = class(one.class);
            // Positions half a step back, to the time of the velocities.
            let x = one.position - 2.5e-6 * one.velocity;
            kind.mass() * x.cross(one.velocity) + kind.inertia() * one.spin
        };
        p.iter().map(one).sum::<DVec3>()
    };
    let scale: f64 =
        particles.iter().map(|p| p.velocity.length()).sum::<f64>() * particles.classes()[0].mass();
    let before = momentum(&particles);
    let mut energy = particles.kinetic_energy();
    let mut simulation = Simulation::new(particles, term, NoWalls, settings).unwrap();
    simulation.advance(1).unwrap();
    let turning = angular(simulation.particles());
    for _ in 0..10 {
        simulation.advance(400).unwrap();
        let now = simulation.particles().kinetic_energy();
        assert!(now <= energy * (1.0 + 1e-3), "{now} {energy}");
        energy = now;
    }
    assert!((momentum(simulation.particles()) - before).length() < 1e-13 * scale);
    let drift = (angular(simulation.particles()) - turning).length();
    assert!(drift < 2e-4 * turning.length(), "{drift:e} of {:e}", turning.length());
}
