//! Beds of spheres whose drags are solved for at the end of the step.

use std::f64::consts::PI;

use pendular::{MeshWalls, SplitMethod};
use pendular_capillary::AnyCapillary;
use pendular_dem_core::{
    Class, DVec3, Implicit, Impulse, PairTerm, Particle, Particles, Settings, Simulation,
};
use pendular_lubrication::{Gap, NormalModel, TangentialModel};
use pendular_walls::{Harmonic, Motion, Part, Plane, Shape, Walls};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

use crate::implicit_drag::{DENSITY, Pairs, STIFFNESS, Scene, implicit};
use crate::lone_pairs::LoneResistances;
use crate::rig;

/// Wet spheres of two sizes, a few micrometres apart, from a `height` m over a floor that shakes.
fn bed(side: u32, viscosity: f64, tension: f64, height: f64) -> (Particles, Walls, Pairs) {
    let classes = [1e-3, 1.25e-3].map(|r| Class::new(r, DENSITY, 0).unwrap());
    let mut particles = Particles::new(classes.to_vec()).unwrap();
    let mut random = Pcg64::seed_from_u64(5);
    for k in 0..side.pow(3) {
        let [i, j, k] = [k % side, k / side % side, k / side / side];
        let at = DVec3::new(f64::from(i), f64::from(j), f64::from(k));
        let mut jitter = || rig::uniform(&mut random, -5e-7, 5e-7);
        let at = 2.252e-3 * at + DVec3::new(jitter(), jitter(), jitter() + height);
        let class = ((i + j + k) % 2) as u16;
        particles.push(class, at, DVec3::ZERO, DVec3::ZERO).unwrap();
    }
    let shake = Harmonic { amplitude: 3e-4 * DVec3::Z, frequency: 50.0, phase: 0.0 };
    let plane = Shape::Plane(Plane::new(DVec3::ZERO, DVec3::Z, 1.0).unwrap());
    let floor = Part::new("floor", plane).with_motion(Motion::harmonic(shake));
    let walls = Walls::new(vec![floor]).unwrap();
    let near = Gap::Roughness { length: 1e-6 }.into();
    let laws = rig::viscous_laws(
        AnyCapillary::Lambert,
        Some(NormalModel::Pitois2000.with(near)),
        Some(TangentialModel::Popov2010.with(near)),
    );
    let bodies = rig::bodies(&particles, Some(&walls));
    let films = vec![1e-9; particles.len()];
    let wet =
        rig::wet(rig::liquid(tension, viscosity, 0.3), laws, bodies, films, SplitMethod::Half);
    let rub = rig::Rub { stiffness: STIFFNESS, restitution: 0.6, friction: 0.3, rolling: 1e-5 };
    let terms = (rig::contact(&classes, rub), wet);
    (particles, walls, terms)
}

/// A sixtieth of the contact time of the smaller spheres of a bed.
fn bed_step() -> f64 {
    PI * (0.5 * Class::new(1e-3, DENSITY, 0).unwrap().mass() / STIFFNESS).sqrt() / 60.0
}

fn places<T: PairTerm>(simulation: &Scene<T>) -> Vec<DVec3> {
    let mut all: Vec<Particle> = simulation.particles().iter().collect();
    all.sort_by_key(|p| p.id);
    all.iter().map(|p| p.position).collect()
}

fn rms(a: &[DVec3], b: &[DVec3]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(a, b)| (*a - *b).length_squared()).sum();
    (sum / a.len() as f64).sqrt()
}

/// A shaken wet bed against explicit drag in steps 100 times as fine, where the explicit drag of the
/// coarse step blows up.
#[test]
fn a_shaken_viscous_bed_goes_where_fine_explicit_steps_take_it() {
    let (h, steps, finer) = (bed_step(), 2_000, 100_u32);
    let loose = |h: f64| Settings { allow_unstable: true, ..Settings::new(h) };
    let (particles, walls, terms) = bed(3, 10.0, 0.07, 1.245e-3);
    let mut coarse = implicit(particles.clone(), walls, terms, Settings::new(h));
    let before = places(&coarse);
    coarse.advance(steps).unwrap();
    let run = |h: f64, steps: u64| {
        let (particles, walls, terms) = bed(3, 10.0, 0.07, 1.245e-3);
        let mut fine = Scene::new(particles, terms, MeshWalls(walls), loose(h)).unwrap();
        fine.advance(steps).map(|()| places(&fine))
    };
    let fine = run(h / f64::from(finer), steps * u64::from(finer)).unwrap();
    let (off, moved) = (rms(&places(&coarse), &fine), rms(&before, &fine));
    println!("shaken bed: {:.1e} of the way", off / moved);
    assert!(off < 5e-5 * moved, "{off:e} of {moved:e}");
    let passes = coarse.passes();
    assert_eq!((passes.steps, passes.at_most), (steps, 0), "{passes:?}");
    let blown = run(h, steps);
    let blown = blown.map(|at| rms(&at, &fine) / moved);
    assert!(
        !blown.as_ref().is_ok_and(|off| *off < 1.0),
        "explicit drag holds here: {blown:?} {}",
        off / moved
    );
}

/// Syrup between spheres that land on each other: the tolerance buys accuracy with passes.
#[test]
fn a_finer_tolerance_of_the_passes_leads_nearer_to_the_settled_impulses() {
    let run = |pass_tolerance: f64| {
        let (particles, walls, terms) = bed(6, 100.0, 0.07, 1.245e-3);
        let settings = Settings { pass_tolerance, ..Settings::new(bed_step()) };
        let mut simulation = implicit(particles, walls, terms, settings);
        let before = places(&simulation);
        simulation.advance(500).unwrap();
        let passes = simulation.passes();
        let after = places(&simulation);
        let moved = rms(&before, &after);
        (after, moved, passes.passes as f64 / passes.steps as f64)
    };
    let (settled, moved, _) = run(1e-9);
    let mut last = (f64::INFINITY, 0.0);
    for tolerance in [0.1, Settings::new(1.0).pass_tolerance, 3e-4] {
        let (after, _, passes) = run(tolerance);
        let off = rms(&after, &settled) / moved;
        println!("tolerance {tolerance}: {passes:.1} passes a step, {off:.1e} of the way");
        assert!(off < last.0 && passes > last.1, "{tolerance}: {off} {passes} {last:?}");
        last = (off, passes);
    }
    assert!(last.0 < 1e-4, "{last:?}");
}

/// Whatever the velocities become between two steps, drags only take energy: what was remembered
/// of the last step is scaled down to what brakes.
#[test]
fn remembered_impulses_never_drive() {
    for viscosity in [0.1, 10.0, 1000.0] {
        let (particles, walls, (_, wet)) = bed(4, viscosity, 1e-15, 0.1);
        let rub = rig::Rub { stiffness: 1e-9, restitution: 1.0, friction: 0.0, rolling: 0.0 };
        let free = move |p: &Particles, wet| (rig::contact(p.classes(), rub), wet);
        let settings = rig::weightless(1e-6);
        let terms = free(&particles, wet);
        let mut simulation = implicit(particles, walls, terms, settings);
        simulation.advance(1).unwrap();
        let mut random = Pcg64::seed_from_u64(9);
        let mut braked = 0.0;
        for round in 0..60 {
            let mut snapshot = simulation.snapshot();
            for p in &mut snapshot.particles {
                let mut any = |s: f64| rig::uniform(&mut random, -s, s);
                p.velocity = DVec3::new(any(0.01), any(0.01), any(0.01));
                p.spin = DVec3::new(any(10.0), any(10.0), any(10.0));
            }
            let fresh = |impulse| Impulse { charged: f64::INFINITY, ..impulse };
            let state = simulation.term().inner().1.state();
            let (particles, walls, (_, mut wet)) = bed(4, viscosity, 1e-15, 0.1);
            wet.resume(state).unwrap();
            let hold = |hold: pendular::Hold| wet.column(hold.bridge()).unwrap();
            let snapshot = snapshot
                .map(|((spring, bridge), impulse)| ((spring, hold(bridge)), fresh(impulse)));
            let terms = Implicit::new(free(&particles, wet));
            let walls = MeshWalls(walls);
            simulation = Simulation::restore(particles, terms, walls, settings, snapshot).unwrap();
            let mut energy = simulation.particles().kinetic_energy();
            for _ in 0..3 {
                simulation.advance(1).unwrap();
                let now = simulation.particles().kinetic_energy();
                assert!(now <= energy * (1.0 + 1e-12), "η {viscosity} {round}: {energy} {now}");
                braked += 1.0 - now / energy;
                energy = now;
            }
        }
        assert!(braked > 1.0, "{braked}");
    }
}

#[test]
fn threads_and_skins_do_not_change_a_bit_of_implicit_drags() {
    let run = |settings: Settings| {
        let (particles, walls, terms) = bed(13, 5.0, 0.07, 1.245e-3);
        let mut simulation = implicit(particles, walls, terms, settings);
        simulation.advance(400).unwrap();
        assert!(simulation.term().inner().1.alive() > 3_000);
        rig::bits(&simulation)
    };
    let h = bed_step();
    let one = run(Settings::new(h));
    for threads in [2, 3] {
        assert!(one == run(Settings { threads, ..Settings::new(h) }), "{threads} threads");
    }
    let (skin, inner_skin) = (Some(4e-4), Some(1e-5));
    assert!(one == run(Settings { skin, inner_skin, ..Settings::new(h) }), "skins");
}

/// What resists in several pairs at once is to the bit what resists in each.
#[test]
fn resistances_one_at_a_time_give_the_same_bits() {
    let settings = || Settings::new(bed_step());
    let (particles, walls, terms) = bed(9, 1.0, 0.07, 1.245e-3);
    let mut at_once = implicit(particles, walls, terms, settings());
    let (particles, walls, terms) = bed(9, 1.0, 0.07, 1.245e-3);
    let terms = Implicit::new(LoneResistances(terms));
    let mut each = Scene::new(particles, terms, MeshWalls(walls), settings()).unwrap();
    at_once.advance(300).unwrap();
    each.advance(300).unwrap();
    assert!(at_once.term().inner().1.alive() > 1_000);
    assert!(rig::bits(&at_once) == rig::bits(&each));
}

/// A run that is stopped and goes on ends with the same bits.
#[test]
fn a_snapshot_holds_the_impulses() {
    let h = bed_step();
    let (particles, walls, terms) = bed(9, 20.0, 0.07, 1.245e-3);
    let mut simulation = implicit(particles, walls, terms, Settings::new(h));
    simulation.advance(200).unwrap();
    let (state, snapshot) = (simulation.term().inner().1.state(), simulation.snapshot());
    let (particles, walls, (contact, mut wet)) = bed(9, 20.0, 0.07, 1.245e-3);
    wet.resume(state).unwrap();
    let hold = |hold: pendular::Hold| wet.column(hold.bridge()).unwrap();
    let snapshot = snapshot.map(|((spring, bridge), impulse)| ((spring, hold(bridge)), impulse));
    let terms = Implicit::new((contact, wet));
    let walls = MeshWalls(walls);
    let mut again =
        Simulation::restore(particles, terms, walls, Settings::new(h), snapshot).unwrap();
    simulation.advance(200).unwrap();
    again.advance(200).unwrap();
    assert!(rig::bits(&simulation) == rig::bits(&again));
}
