//! Drags that are solved for at the end of the step, at the time step of the contact.

use std::f64::consts::PI;

use pendular::{MeshWalls, SplitMethod, Wet};
use pendular_capillary::AnyCapillary;
use pendular_contact::{Dashpot, Linear};
use pendular_dem_core::{
    Boundary, Class, Contact, DVec3, Implicit, PairContact, PairTerm, Particle, Particles,
    Settings, Simulation,
};
use pendular_lubrication::{
    AdamsPerchard1985, AnyNormalDrag, AnyTangentialDrag, Gap, NormalCurve, NormalDrag, NormalModel,
    TangentialModel,
};
use pendular_pair::{Bridge, Mate};
use pendular_walls::{Part, Plane, Shape, Walls};

use crate::rig;

const R: f64 = 2e-3;
pub(crate) const DENSITY: f64 = 2500.0;
pub(crate) const STIFFNESS: f64 = 1e4;
const ROUGHNESS: f64 = 2e-6;
const G: f64 = 9.81;

fn sphere() -> Class {
    Class::new(R, DENSITY, 0).unwrap()
}

/// A fiftieth of the contact time of two spheres.
fn step() -> f64 {
    PI * (0.5 * sphere().mass() / STIFFNESS).sqrt() / 50.0
}

fn spring(mass: f64, restitution: f64) -> PairContact<Linear> {
    let pull = Dashpot::MayPull;
    let normal = Linear::from_restitution_with(STIFFNESS, restitution, mass, pull).unwrap();
    PairContact { normal, friction: 0.0, rolling_friction: 0.0, tangential_damping: 0.0 }
}

fn contact(classes: &[Class], restitution: f64) -> Contact<Linear> {
    Contact::new(
        classes,
        1,
        move |a, b| spring(a.mass() * b.mass() / (a.mass() + b.mass()), restitution),
        move |a, _| spring(a.mass(), restitution),
    )
}

pub(crate) type AnyWet = Wet<AnyCapillary, Option<AnyNormalDrag>, Option<AnyTangentialDrag>>;

/// One type of term for all tests: each other one would be compiled anew.
pub(crate) type Scene<T> = Simulation<T, MeshWalls>;
pub(crate) type Pairs = (Contact<Linear>, AnyWet);

/// Bridges that drag along the line of centres, as an immersed pair does, and hardly pull.
fn film(particles: &Particles, walls: &Walls, viscosity: f64, films: Vec<f64>) -> AnyWet {
    let near = Gap::Roughness { length: ROUGHNESS }.into();
    let normal = Some(NormalModel::AdamsPerchard1985.with(near));
    let laws = rig::viscous_laws(AnyCapillary::Lambert, normal, None);
    let liquid = rig::liquid(1e-12, viscosity, 0.0);
    rig::wet(liquid, laws, rig::bodies(particles, Some(walls)), films, SplitMethod::Half)
}

pub(crate) fn implicit(
    particles: Particles,
    walls: Walls,
    terms: Pairs,
    settings: Settings,
) -> Scene<Implicit<Pairs>> {
    Simulation::new(particles, Implicit::new(terms), MeshWalls(walls), settings).unwrap()
}

/// A floor out of the way.
fn far() -> Walls {
    let plane = Plane::new(-DVec3::Z, DVec3::Z, 1.0).unwrap();
    Walls::new(vec![Part::new("floor", Shape::Plane(plane))]).unwrap()
}

fn floor() -> Walls {
    let plane = Plane::new(DVec3::ZERO, DVec3::Z, 1.0).unwrap();
    Walls::new(vec![Part::new("floor", Shape::Plane(plane))]).unwrap()
}

/// Spheres one above the other over a floor, each with `gaps` below it.
fn stack(gaps: &[f64]) -> Particles {
    let mut particles = Particles::new(vec![sphere()]).unwrap();
    let mut z = 0.0;
    for gap in gaps {
        z += gap + R;
        particles.push(0, z * DVec3::Z, DVec3::ZERO, DVec3::ZERO).unwrap();
        z += R;
    }
    particles
}

fn heights<T: PairTerm, B: Boundary>(simulation: &Simulation<T, B>) -> Vec<f64> {
    let mut all: Vec<Particle> = simulation.particles().iter().collect();
    all.sort_by_key(|p| p.id);
    all.iter().map(|p| p.position.z).collect()
}

fn gaps<T: PairTerm, B: Boundary>(simulation: &Simulation<T, B>) -> Vec<f64> {
    let mut below = -R;
    let gap = |z: f64| {
        let gap = z - below - 2.0 * R;
        below = z;
        gap
    };
    heights(simulation).into_iter().map(gap).collect()
}

/// A stack of spheres that sinks under its weight: gap k closes at the rate of the weight above it
/// over the drag, ln(S + s_r) by (N − k) m g/K. K is that of two spheres or of a sphere and a plane.
/// So many pairs of `others`, 400 times as heavy, run into each other beside it.
fn drained(count: usize, viscosity: f64, steps: u64, others: u32) -> Vec<f64> {
    let spheres = stack(&vec![5e-6; count]);
    let heavy = Class::new(R, 400.0 * DENSITY, 0).unwrap();
    let mut particles = Particles::new(vec![sphere(), heavy]).unwrap();
    for sphere in spheres.iter() {
        particles.push(0, sphere.position, DVec3::ZERO, DVec3::ZERO).unwrap();
    }
    for n in 0..others {
        let at = DVec3::new(0.0, (f64::from(n) + 4.0) * 2.5 * R, 0.5);
        particles.push(1, at, 0.05 * DVec3::X, DVec3::ZERO).unwrap();
        particles.push(1, at + 2.1 * R * DVec3::X, -0.05 * DVec3::X, DVec3::ZERO).unwrap();
    }
    let walls = floor();
    let wet = film(&particles, &walls, viscosity, vec![1e-9; particles.len()]);
    let terms = (contact(particles.classes(), 0.8), wet);
    let mut simulation = implicit(particles, walls, terms, Settings::new(step()));
    // The first steps find the impulses and the speeds.
    simulation.advance(200).unwrap();
    let (before, start) = (gaps(&simulation), simulation.time());
    simulation.advance(steps).unwrap();
    let time = simulation.time() - start;
    let both = before.iter().zip(gaps(&simulation)).take(count).enumerate();
    let rates = both.map(|(k, (before, after))| {
        let weight = (count - k) as f64 * sphere().mass() * G;
        let reduced = if k == 0 { R } else { 0.5 * R };
        let strength = 6.0 * PI * viscosity * reduced * reduced;
        let sunk = ((before + ROUGHNESS) / (after + ROUGHNESS)).ln();
        sunk / (weight / strength * time)
    });
    rates.collect()
}

#[test]
fn a_sphere_settles_on_a_plane_at_the_rate_of_lubrication() {
    let cases = [(1.0, 4_000, 2e-4), (10.0, 20_000, 3e-6), (100.0, 40_000, 3e-8)];
    for (viscosity, steps, allowed) in cases {
        let off = (drained(1, viscosity, steps, 0)[0] - 1.0).abs();
        println!("settling, η = {viscosity} Pa s: {off:.1e}");
        assert!(off < allowed, "η = {viscosity}: {off}");
    }
}

#[test]
fn stacks_drain_as_their_weight_says() {
    let cases = [(3, 10.0, 2e-4), (3, 100.0, 3e-6), (10, 10.0, 1e-2), (10, 100.0, 2e-4)];
    for (count, viscosity, allowed) in cases {
        let rates = drained(count, viscosity, 2_000, 0);
        let off = rates.iter().fold(0.0_f64, |most, rate| most.max((rate - 1.0).abs()));
        println!("stack of {count}, η = {viscosity} Pa s: {off:.1e}");
        assert!(off < allowed, "{count} at η = {viscosity}: {rates:?}");
    }
}

/// What is loud elsewhere does not drown what is quiet here.
#[test]
fn a_stack_drains_as_its_weight_says_whatever_goes_on_beside_it() {
    for (viscosity, allowed) in [(10.0, 1e-2), (100.0, 1e-3)] {
        let rates = drained(10, viscosity, 500, 300);
        let off = rates.iter().fold(0.0_f64, |most, rate| most.max((rate - 1.0).abs()));
        println!("stack of 10 beside others, η = {viscosity} Pa s: {off:.1e}");
        assert!(off < allowed, "η = {viscosity}: {rates:?}");
    }
}

/// Two spheres that approach each other through liquid stop where m* v + G is used up, also where
/// they would cross the whole gap in a step.
#[test]
fn the_stopping_distance_spends_the_momentum() {
    for (viscosity, speed) in [(1.0, 0.5), (10.0, 2.0), (100.0, 20.0)] {
        let particles = rig::two([sphere(); 2], 1e-4, [0.5 * speed, -0.5 * speed]);
        let wet = film(&particles, &far(), viscosity, rig::films_for(1e-9, [R; 2]));
        let terms = (contact(particles.classes(), 0.8), wet);
        let mut simulation = implicit(particles, far(), terms, rig::weightless(step()));
        let state = |s: &Scene<Implicit<Pairs>>| {
            let [a, b] = [0, 1].map(|id| rig::at(s, id));
            (b.position.x - a.position.x - 2.0 * R, b.velocity.x - a.velocity.x)
        };
        let bridge = Bridge::new(R, Mate::Sphere { radius: R }, 1e-9, [0.0; 2], 0.07).unwrap();
        let law = AdamsPerchard1985 { near: Gap::Roughness { length: ROUGHNESS }.into() };
        let curve = law.curve(&bridge, viscosity).unwrap();
        let mass = 0.5 * sphere().mass();
        let (gap, rate) = state(&simulation);
        let start = mass * rate + curve.impulse(gap);
        simulation.advance(40_000).unwrap();
        let (gap, rate) = state(&simulation);
        assert!(rate.abs() < 1e-9 && gap > 1e-6 && gap < 9.9e-5, "η = {viscosity}: {gap:e}");
        // To one in a million, of the momentum and so of the gap.
        let lost = (start - curve.impulse(gap)).abs() / (mass * speed);
        println!("stopping, η = {viscosity} Pa s, {speed} m/s: {lost:.1e} of the momentum lost");
        assert!(lost < 1e-6, "η = {viscosity}: {lost:e} {gap:e}");
    }
}

/// As `rebound_is_daviss_with_the_logarithm_plus_one` but with a time step 200 times as long, in
/// which the spheres travel as far as they are rough. The mean over the place of the first step.
#[test]
fn the_mean_rebound_is_daviss_at_the_contacts_step() {
    let (speed, e_dry, volume) = (0.5, 0.8, 1e-11);
    for stokes in [1110.0, 111.0, 37.0, 18.5, 3.0] {
        let reduced = 0.5 * sphere().mass();
        let viscosity = reduced * speed / (stokes * 6.0 * PI * 0.25 * R * R);
        let mut mean = 0.0;
        let mut film_gap = 0.0;
        const OFFSETS: u32 = 16;
        for k in 0..OFFSETS {
            let offset = f64::from(k) / f64::from(OFFSETS) * speed * step();
            let films = rig::films_for(volume, [R; 2]);
            let particles = rig::two([sphere(); 2], 6e-5 + offset, [0.5 * speed, -0.5 * speed]);
            let wet = film(&particles, &far(), viscosity, films);
            film_gap = 2.0 * wet.film_thickness(0);
            let terms = (contact(&[sphere(); 2], e_dry), wet);
            let mut simulation = implicit(particles, far(), terms, rig::weightless(step()));
            simulation.advance(600).unwrap();
            let out = rig::at(&simulation, 1).velocity.x - rig::at(&simulation, 0).velocity.x;
            mean += out / speed / f64::from(OFFSETS);
        }
        let log = |gap: f64| (1.0 + gap / ROUGHNESS).ln() + 1.0;
        let expected = e_dry - (e_dry * log(film_gap) + log(volume.cbrt())) / stokes;
        let off = (mean - expected.max(0.0)).abs();
        println!("mean rebound, St = {stokes}: {off:.1e}");
        assert!(off < 2e-3, "St {stokes}: {mean} for {expected}");
    }
}

fn momenta(particles: &Particles) -> (DVec3, DVec3) {
    let one = |p: Particle| {
        let class = particles.classes()[usize::from(p.class)];
        let m = class.mass();
        (m * p.velocity, m * p.position.cross(p.velocity) + class.inertia() * p.spin)
    };
    particles.iter().map(one).fold((DVec3::ZERO, DVec3::ZERO), |(a, b), (c, d)| (a + c, b + d))
}

/// A pair of unequal spheres that slip on each other in a bridge.
fn sheared(
    viscosity: f64,
    tangential: TangentialModel,
    h: f64,
    time: f64,
    at_the_end: bool,
) -> (Particles, Particles) {
    let classes = [1e-3, 1.5e-3].map(|r| Class::new(r, DENSITY, 0).unwrap());
    let mut particles = Particles::new(classes.to_vec()).unwrap();
    particles.push(0, DVec3::ZERO, 0.05 * DVec3::Y, 20.0 * DVec3::Z).unwrap();
    let apart = 2.5e-3 + 3e-6;
    particles.push(1, apart * DVec3::X, DVec3::ZERO, DVec3::new(3.0, 0.0, -15.0)).unwrap();
    let near = Gap::Roughness { length: 1e-6 }.into();
    let normal = Some(NormalModel::Pitois2000.with(near));
    let laws = rig::viscous_laws(AnyCapillary::Lambert, normal, Some(tangential.with(near)));
    let films = rig::films_for(2e-11, [1e-3, 1.5e-3]);
    let bodies = rig::bodies(&particles, Some(&far()));
    let wet = rig::wet(rig::liquid(0.07, viscosity, 0.3), laws, bodies, films, SplitMethod::Half);
    let rub = rig::Rub { stiffness: 1e4, restitution: 0.6, friction: 0.3, rolling: 0.0 };
    let terms = (rig::contact(&classes, rub), wet);
    let steps = (time / h).round() as u64;
    let start = particles.clone();
    let end = if at_the_end {
        let mut simulation = implicit(particles, far(), terms, rig::weightless(h));
        simulation.advance(steps).unwrap();
        simulation.particles().clone()
    } else {
        let settings = rig::weightless(h);
        let mut simulation = Scene::new(particles, terms, MeshWalls(far()), settings).unwrap();
        simulation.advance(steps).unwrap();
        simulation.particles().clone()
    };
    (start, end)
}

#[test]
fn implicit_drags_keep_momentum_and_angular_momentum() {
    for &tangential in TangentialModel::ALL.iter().filter(|m| m.name() != "goldman-literal") {
        let (start, end) = sheared(10.0, tangential, 2e-6, 6e-3, true);
        let ((p, l), (q, k)) = (momenta(&start), momenta(&end));
        assert!((p - q).length() < 1e-12 * p.length(), "{}", tangential.name());
        assert!((l - k).length() < 1e-12 * l.length(), "{}: {l} {k}", tangential.name());
    }
}

#[test]
fn a_sheared_pair_goes_where_a_thousand_times_finer_explicit_steps_take_it() {
    let h = 2e-6;
    for viscosity in [1.0, 10.0] {
        let model = TangentialModel::Popov2010;
        let (start, fine) = sheared(viscosity, model, h / 1000.0, 2e-3, false);
        let (_, coarse) = sheared(viscosity, model, h, 2e-3, true);
        for id in [0, 1] {
            let at = |p: &Particles| p.get(id).unwrap().position;
            let moved = (at(&fine) - at(&start)).length();
            let off = (at(&coarse) - at(&fine)).length();
            println!("sheared, η = {viscosity} Pa s, sphere {id}: {:.1e} of the way", off / moved);
            assert!(off < 5e-5 * moved, "η = {viscosity}: {off:e} of {moved:e}");
        }
        let (_, explicit) = sheared(viscosity, model, h, 2e-3, false);
        let off = explicit.get(0).unwrap().position - fine.get(0).unwrap().position;
        if viscosity > 5.0 {
            assert!(off.is_nan() || off.length() >= 1e-5, "explicit drag is unstable here: {off}");
        }
    }
}

/// Rolling friction ends with the contact, though the bridge lives on.
#[test]
fn a_wet_sphere_that_lifts_off_keeps_its_spin() {
    let class = sphere();
    let mut particles = Particles::new(vec![class]).unwrap();
    particles.push(0, (R - 1e-6) * DVec3::Z, DVec3::ZERO, 20.0 * DVec3::X).unwrap();
    let wet = film(&particles, &floor(), 1e-3, vec![1e-9]);
    let rub = PairContact { rolling_friction: 1e-5, ..spring(class.mass(), 0.8) };
    let contact = Contact::new(&[class], 1, move |_, _| rub, move |_, _| rub);
    let mut simulation = implicit(particles, floor(), (contact, wet), rig::weightless(step()));
    let mut spins = Vec::new();
    for _ in 0..400 {
        simulation.advance(1).unwrap();
        let now = rig::at(&simulation, 0);
        if now.position.z - R > 1e-7 {
            spins.push(now.spin.x);
        }
    }
    assert!(simulation.term().inner().1.alive() == 1 && spins.len() > 100, "{}", spins.len());
    assert!(spins[0] < 20.0 && spins.iter().all(|spin| *spin == spins[0]), "{spins:?}");
}

/// A POM sphere rolls to rest in the time that its rolling friction says, and stays there.
#[test]
fn a_rolling_sphere_comes_to_rest_in_time_and_without_creep() {
    let (r, speed, rolling) = (2.5e-3, 0.05, 5.97e-5);
    let class = Class::new(r, 1358.0, 0).unwrap();
    let mut particles = Particles::new(vec![class]).unwrap();
    let sag = class.mass() * G / 1e5;
    let (at, v) = ((r - sag) * DVec3::Z, speed * DVec3::X);
    particles.push(0, at, v, speed / r * DVec3::Y).unwrap();
    let wet = film(&particles, &floor(), 1e-3, vec![0.0]);
    // A fifth of the critical damping across, or the spring there would swing for ever.
    let tangential_damping = 0.4 * (2.0 / 7.0 * 1e5 * 2.0 / 7.0 * class.mass()).sqrt();
    let normal = Linear::from_restitution(1e5, 0.8, class.mass()).unwrap();
    let normal = normal.with_tangential_ratio(2.0 / 7.0).unwrap();
    let rub = PairContact { normal, friction: 0.35, rolling_friction: rolling, tangential_damping };
    let contact = || Contact::new(&[class], 1, move |_, _| rub, move |_, _| rub);
    let terms = (contact(), wet);
    let h = PI * (class.mass() / 1e5).sqrt() / 50.0;
    let mut simulation = implicit(particles, floor(), terms, Settings::new(h));
    // Rolling without sliding: 7/5 m v' = −μ m g/r.
    let stop = speed / (rolling * G / (1.4 * r));
    simulation.advance((0.98 * stop / h) as u64).unwrap();
    let now = rig::at(&simulation, 0).velocity.x;
    assert!((now / (0.02 * speed) - 1.0).abs() < 0.03, "{now:e}");
    simulation.advance((0.04 * stop / h) as u64).unwrap();
    let rest = rig::at(&simulation, 0);
    assert!(rest.spin.length() * r < 1e-12, "{:e}", rest.spin.length());
    assert!(rest.velocity.x.abs() < 1e-9, "{:e}", rest.velocity.x);
    simulation.advance(20_000).unwrap();
    let crept = (rig::at(&simulation, 0).position.x - rest.position.x) / (20_000.0 * h);
    assert!(crept.abs() < 1e-9, "{crept:e} m/s");
    // On half the critical slope, tilted gravity, it does not creep.
    let slope = 0.5 * rolling / r;
    let tilted = G * DVec3::new(slope, 0.0, -1.0).normalize();
    let mut particles = Particles::new(vec![class]).unwrap();
    particles.push(0, at, DVec3::ZERO, DVec3::ZERO).unwrap();
    let wet = film(&particles, &floor(), 1e-3, vec![0.0]);
    let settings = Settings { gravity: tilted, ..Settings::new(h) };
    let terms = (contact(), wet);
    let mut simulation = implicit(particles, floor(), terms, settings);
    simulation.advance(20_000).unwrap();
    let start = rig::at(&simulation, 0).position.x;
    simulation.advance(20_000).unwrap();
    let crept = (rig::at(&simulation, 0).position.x - start) / (20_000.0 * h);
    assert!(crept.abs() < 1e-9, "{crept:e} m/s");
}

/// Two spheres that their bridge holds together turn about each other as one body: whatever the
/// viscosity, nothing brakes that.
#[test]
fn a_pair_that_turns_as_one_body_keeps_its_energy() {
    for viscosity in [1.0, 100.0] {
        let spin = 20.0 * DVec3::Z;
        let class = sphere();
        let mut particles = Particles::new(vec![class]).unwrap();
        let half = (R - 2e-8) * DVec3::X;
        particles.push(0, -half, spin.cross(-half), spin).unwrap();
        particles.push(0, half, spin.cross(half), spin).unwrap();
        let near = Gap::Roughness { length: ROUGHNESS }.into();
        let laws = rig::viscous_laws(
            AnyCapillary::Lambert,
            Some(NormalModel::Pitois2000.with(near)),
            Some(TangentialModel::JeffreyOnishi1984.with(near)),
        );
        let bodies = rig::bodies(&particles, Some(&far()));
        let films = rig::films_for(1e-10, [R; 2]);
        let liquid = rig::liquid(0.07, viscosity, 0.3);
        let wet = rig::wet(liquid, laws, bodies, films, SplitMethod::Half);
        let rub = rig::Rub { stiffness: 1e4, restitution: 0.6, friction: 0.3, rolling: 1e-5 };
        let terms = (rig::contact(&[class], rub), wet);
        let mut simulation = implicit(particles, far(), terms, rig::weightless(step()));
        simulation.advance(100).unwrap();
        let before = simulation.particles().kinetic_energy();
        let turn = (1.0 / spin.z / step()) as u64;
        simulation.advance(turn).unwrap();
        let now = simulation.particles().kinetic_energy();
        println!("turning as one body, η = {viscosity} Pa s: {:.1e}", now / before - 1.0);
        assert!((now / before - 1.0).abs() < 1e-5, "η {viscosity}: {}", now / before - 1.0);
        assert_eq!(simulation.term().inner().1.alive(), 1);
    }
}
