//! Where the liquid is: whatever forms, breaks, leaves or is taken away, none of it is lost.

use pendular::{Account, Ledger, MeshWalls, Move, SplitMethod};
use pendular_contact::Linear;
use pendular_dem_core::{
    Class, Contact, DVec3, NoWalls, PairTerm, Particles, Settings, Simulation,
};
use pendular_pair::Mate;
use pendular_transfer::{Split, film, formation};
use pendular_walls::{Harmonic, Motion, Part, Plane, Shape, Walls, Wire, build};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

use crate::lone_pairs::LonePairs;
use crate::rig::{self, AnyWet, Rub};

const RUB: Rub = Rub { stiffness: 1e4, restitution: 0.8, friction: 0.4, rolling: 2e-5 };

/// Spheres of two sizes with random velocities above three wires, in a box of triangles under a
/// lid, all of it shaken.
fn shaken(side: u32) -> (Particles, Walls) {
    let classes = [(1e-3, 2500.0), (1.4e-3, 2000.0)].map(|(r, rho)| Class::new(r, rho, 0).unwrap());
    let mut particles = Particles::new(classes.to_vec()).unwrap();
    let mut random = Pcg64::seed_from_u64(5);
    for k in 0..side.pow(3) {
        let at = [k % side, k / side % side, k / side / side].map(f64::from);
        let mut any = |s: f64| DVec3::from_array([s; 3].map(|s| rig::uniform(&mut random, -s, s)));
        let half = 0.5 * f64::from(side - 1);
        let x = 3e-3 * (DVec3::from_array(at) - DVec3::new(half, half, 0.0));
        let (jitter, v, w) = (any(5e-5), any(0.3), any(300.0));
        particles.push((k % 2) as u16, x + jitter + 7e-3 * DVec3::Z, v, w).unwrap();
    }
    let (half, top) = (1.7e-3 * f64::from(side), 3.2e-3 * f64::from(side) + 7e-3);
    let (low, high) = (DVec3::new(-half, -half, 0.0), DVec3::new(half, half, top));
    let tray = build::open_box(low, high, true, 4e-3).unwrap();
    let lid = Plane::new(DVec3::Z * top, DVec3::NEG_Z, 4.0 * half * half).unwrap();
    let mut parts = vec![Part::new("box", Shape::Mesh(tray)), Part::new("lid", Shape::Plane(lid))];
    for k in 0..3 {
        let y = 2.2e-3 * (f64::from(k) - 1.0);
        let ends = [-half, half].map(|x| DVec3::new(x, y, 4e-3));
        let wire = Wire::new(ends[0], ends[1], 5e-4, 6).unwrap();
        parts.push(Part::new(format!("wire-{k}"), Shape::Wire(wire)));
    }
    let term = |amplitude, phase| Harmonic { amplitude, frequency: 120.0, phase };
    let terms = vec![term(1e-3 * DVec3::Z, 0.0), term(3e-4 * DVec3::X, 1.0)];
    let motion = Motion { terms, ramp: 2e-3 };
    let parts = parts.into_iter().map(|part| part.with_motion(motion.clone()));
    (particles, Walls::new(parts.collect()).unwrap())
}

/// Liquid on two thirds of the particles, up to a fifth of their volume.
fn films(particles: &Particles) -> Vec<f64> {
    let mut random = Pcg64::seed_from_u64(11);
    let mut films = vec![0.0; particles.len()];
    for p in particles.iter() {
        let most = 0.2 * particles.classes()[usize::from(p.class)].mass() / 2000.0;
        let volume = rig::uniform(&mut random, -0.5, 1.0) * most;
        films[p.id as usize] = volume.max(0.0);
    }
    films
}

#[test]
fn the_total_is_kept_and_nothing_is_negative_in_a_shaken_wet_box() {
    let (particles, walls) = shaken(7);
    let wet = rig::any_wet(&particles, Some(&walls), films(&particles));
    let term = (rig::contact(particles.classes(), RUB), wet);
    let boundary = MeshWalls(walls);
    let mut simulation = Simulation::new(particles, term, boundary, Settings::new(5e-6)).unwrap();
    for _ in 0..400 {
        simulation.advance(25).unwrap();
        let ledger = simulation.term().1.ledger();
        assert!(ledger.imbalance().abs() < 1e-12, "{:e}", ledger.imbalance());
        assert!(ledger.films().iter().chain(ledger.walls()).all(|&v| v >= 0.0));
        assert!(ledger.in_bridges() >= 0.0 && ledger.drained() == 0.0);
    }
    let wet = &simulation.term().1;
    let counts = wet.counts();
    assert!(counts.formed > 2_000 && counts.ruptured > 1_500, "{counts:?}");
    // Liquid has come to every kind of wall.
    let on = |part: u32| {
        let walls = &simulation.boundary().0;
        let first = walls.first_element(part) as usize;
        let count = walls.parts()[part as usize].shape.element_count() as usize;
        wet.ledger().walls()[first..first + count].iter().sum::<f64>()
    };
    for part in [0, 2, 3, 4] {
        assert!(on(part) > 0.0, "part {part} is dry");
    }
    // Live bridges between particles have their volume on an open account of their own.
    let mut accounts = std::collections::BTreeSet::new();
    let mut volume = 0.0;
    simulation.for_each_pair(|_, column| {
        if let Some(bridge) = column.1.bridge() {
            assert!(accounts.insert(bridge), "two pairs share bridge {bridge}");
            volume += wet.ledger().volume(Account::Bridge(bridge));
        }
    });
    assert!(accounts.len() as u64 <= wet.alive() && accounts.len() > 100);
    assert!(volume <= wet.ledger().in_bridges() * (1.0 + 1e-12));
}

fn wet_run(change: impl FnOnce(&mut Settings)) -> Vec<u64> {
    wet_run_of(change, |contact, wet| (contact, wet), |term| &term.1)
}

/// A run of contact and liquid in whatever term they are put.
fn wet_run_of<T: PairTerm>(
    change: impl FnOnce(&mut Settings),
    term: impl FnOnce(Contact<Linear>, AnyWet) -> T,
    wet_of: impl Fn(&T) -> &AnyWet,
) -> Vec<u64> {
    let (particles, walls) = shaken(10);
    let wet = rig::any_wet(&particles, Some(&walls), films(&particles));
    let term = term(rig::contact(particles.classes(), RUB), wet);
    let mut settings = Settings::new(5e-6);
    change(&mut settings);
    let mut simulation = Simulation::new(particles, term, MeshWalls(walls), settings).unwrap();
    simulation.advance(1_500).unwrap();
    let wet = wet_of(simulation.term());
    let counts = wet.counts();
    assert!(counts.formed > 1_000 && counts.ruptured > 300, "{counts:?}");
    let mut all = rig::bits(&simulation);
    let ledger = wet.ledger();
    all.extend(ledger.films().iter().chain(ledger.walls()).map(|v| v.to_bits()));
    all
}

#[test]
fn four_pairs_at_a_time_and_one_at_a_time_give_a_wet_run_of_the_same_bits() {
    let four = wet_run(|_| ());
    let lone = wet_run_of(|_| (), |contact, wet| LonePairs((contact, wet)), |term| &term.0.1);
    assert!(four == lone);
    // A term that is absent changes no bit either.
    let none = |contact, wet| ((contact, wet), None::<Contact<Linear>>);
    assert!(four == wet_run_of(|_| (), none, |term| &term.0.1));
}

#[test]
fn neither_threads_nor_skins_change_a_bit_of_a_wet_run() {
    let one = wet_run(|_| ());
    for threads in [2, 3, 8] {
        assert!(wet_run(|s| s.threads = threads) == one, "{threads} threads");
    }
    for (outer, inner) in [(1e-4, 1e-4), (6e-4, 2e-5), (4e-5, 2e-6)] {
        let other = wet_run(|s| (s.skin, s.inner_skin) = (Some(outer), Some(inner)));
        assert!(other == one, "skins {outer} {inner}");
    }
}

#[test]
fn no_liquid_term_and_no_liquid_are_the_dry_run_to_the_bit() {
    let run = || shaken(6);
    let settings = Settings::new(5e-6);
    let (particles, walls) = run();
    let dry = rig::contact(particles.classes(), RUB);
    let mut alone = Simulation::new(particles, dry, MeshWalls(walls), settings).unwrap();
    alone.advance(3_000).unwrap();
    let (particles, walls) = run();
    let term = (rig::contact(particles.classes(), RUB), None::<AnyWet>);
    let mut absent = Simulation::new(particles, term, MeshWalls(walls), settings).unwrap();
    absent.advance(3_000).unwrap();
    assert!(rig::bits(&alone) == rig::bits(&absent), "an absent term is felt");
    let (particles, walls) = run();
    let wet = rig::any_wet(&particles, Some(&walls), vec![0.0; particles.len()]);
    let term = (rig::contact(particles.classes(), RUB), wet);
    let mut waterless = Simulation::new(particles, term, MeshWalls(walls), settings).unwrap();
    waterless.advance(3_000).unwrap();
    assert!(rig::bits(&alone) == rig::bits(&waterless), "liquid that is not there is felt");
}

/// Yade's checkLiquidMigration: unit spheres 0, 1, 2 with 0 in the middle and films 0.03, 0.04,
/// 0.05, of which each keeps 0.01. What a sphere can give is divided by its contacts, a bridge holds
/// at most 0.03, shares in proportion. That rule is the caller's; the booking is the ledger's.
#[test]
fn the_bookkeeping_of_yade() {
    let mut ledger = Ledger::new(vec![0.03, 0.04, 0.05], 0);
    let bridges = [ledger.open_bridge(), ledger.open_bridge()];
    let mut moves = Vec::new();
    for (bridge, outer) in bridges.into_iter().zip([1, 2]) {
        let can = |id: u32, contacts: f64| (ledger.volume(Account::Film(id)) - 0.01) / contacts;
        let (middle, own) = (can(0, 2.0), can(outer, 1.0));
        let scale = 0.03 / (middle + own);
        let to = Account::Bridge(bridge);
        for (id, volume) in [(0, scale * middle), (outer, scale * own)] {
            moves.push(Move { from: Account::Film(id), to, volume });
        }
    }
    ledger.book(&mut moves).unwrap();
    let near = |ledger: &Ledger, expected: [f64; 3]| {
        let all = ledger.films().iter().zip(expected);
        assert!(all.clone().all(|(a, b)| (a - b).abs() < 1e-16), "{:?}", ledger.films());
    };
    for bridge in bridges {
        assert!((ledger.volume(Account::Bridge(bridge)) - 0.03).abs() < 1e-16);
    }
    near(&ledger, [0.03 - 0.0075 - 0.006, 0.04 - 0.0225, 0.05 - 0.024]);
    let back = |bridge, split: Split, outer| {
        let from = Account::Bridge(bridge);
        let [first, second] = split.shares(0.03);
        [(0, first), (outer, second)].map(|(id, volume)| Move {
            from,
            to: Account::Film(id),
            volume,
        })
    };
    let mut own = ledger.clone();
    let shares = [Split::new(0.25).unwrap(), Split::new(0.2).unwrap()];
    let moves = [back(bridges[0], shares[0], 1), back(bridges[1], shares[1], 2)];
    own.book(&mut moves.concat()).unwrap();
    near(&own, [0.03, 0.04, 0.05]);
    let moves = [back(bridges[0], Split::HALF, 1), back(bridges[1], Split::HALF, 2)];
    ledger.book(&mut moves.concat()).unwrap();
    near(&ledger, [0.0465, 0.0325, 0.041]);
}

/// The same three spheres through the core, with Shi & McCarthy's claims: both bridges form in one
/// step from one state, so the middle one gives the same to both.
#[test]
fn two_bridges_of_one_step_see_the_same_state() {
    let class = Class::new(1.0, 1000.0, 0).unwrap();
    let mut particles = Particles::new(vec![class]).unwrap();
    particles.push(0, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO).unwrap();
    for side in [-1.0, 1.0] {
        let out = side * DVec3::Y;
        particles.push(0, 2.0 * out, 0.1 * out, DVec3::ZERO).unwrap();
    }
    let bodies = rig::bodies(&particles, None);
    let films = vec![0.03, 0.04, 0.05];
    let laws = rig::static_laws(rig::NoPull);
    let wet = rig::wet(rig::liquid(0.07, 1e-3, 0.0), laws, bodies, films, SplitMethod::Half);
    let mut simulation = Simulation::new(particles, wet, NoWalls, rig::weightless(1e-2)).unwrap();
    simulation.advance(1).unwrap();
    let cap = 0.5 * (1.0 - 0.75_f64.sqrt());
    let near = |films: &[f64], expected: [f64; 3]| {
        assert!(films.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-16), "{films:?}");
    };
    let left = [0.03 * (1.0 - 2.0 * cap), 0.04 * (1.0 - cap), 0.05 * (1.0 - cap)];
    near(simulation.term().ledger().films(), left);
    let volumes = [cap * (0.03 + 0.04), cap * (0.03 + 0.05)];
    let mut seen = 0;
    simulation.for_each_pair(|encounter, column| {
        let volume = simulation.term().ledger().volume(Account::Bridge(column.bridge().unwrap()));
        let pendular_dem_core::Partner::Particle(second) = encounter.second else { panic!() };
        let outer = encounter.first.max(second) as usize;
        assert!((volume - volumes[outer - 1]).abs() < 1e-16);
        seen += 1;
    });
    assert_eq!(seen, 2);
    simulation.advance(2_000).unwrap();
    assert_eq!(simulation.term().alive(), 0);
    let half = volumes.map(|v| 0.5 * v);
    let expected = [left[0] + half[0] + half[1], left[1] + half[0], left[2] + half[1]];
    near(simulation.term().ledger().films(), expected);
}

/// Three large spheres around a small one with a thick film claim more than there is: they get all
/// of it, in proportion to their claims.
#[test]
fn overdrawn_claims_of_one_step_are_scaled_in_proportion() {
    let radii = [2e-4, 5e-3, 5e-3, 6e-3];
    let classes = radii.map(|r| Class::new(r, 2500.0, 0).unwrap());
    let mut particles = Particles::new(classes.to_vec()).unwrap();
    particles.push(0, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO).unwrap();
    let gap = 1.2e-3;
    for k in 1..4_u16 {
        let (sin, cos) = (std::f64::consts::TAU / 3.0 * f64::from(k)).sin_cos();
        let distance = radii[0] + radii[usize::from(k)] + gap;
        particles.push(k, distance * DVec3::new(cos, sin, 0.0), DVec3::ZERO, DVec3::ZERO).unwrap();
    }
    let bodies = rig::bodies(&particles, None);
    let own = 3e-10;
    let thick = film::volume(radii[0], gap).unwrap();
    let films = vec![thick, own, own, own];
    let laws = rig::static_laws(rig::NoPull);
    let wet = rig::wet(rig::liquid(0.07, 1e-3, 0.0), laws, bodies, films, SplitMethod::Half);
    let mut simulation = Simulation::new(particles, wet, NoWalls, rig::weightless(1e-6)).unwrap();
    simulation.advance(1).unwrap();
    let fraction =
        |r, other| formation::sphere_fraction(r, Mate::Sphere { radius: other }).unwrap();
    let claims = [1, 2, 3].map(|k| fraction(radii[0], radii[k]));
    let all: f64 = claims.iter().sum();
    assert!(all > 1.0, "nothing is overdrawn: {all}");
    let ledger = simulation.term().ledger();
    let mut seen = 0;
    simulation.for_each_pair(|encounter, column| {
        let pendular_dem_core::Partner::Particle(second) = encounter.second else { panic!() };
        let k = second as usize;
        let volume = ledger.volume(Account::Bridge(column.bridge().unwrap()));
        let expected = thick * claims[k - 1] / all + own * fraction(radii[k], radii[0]);
        assert!((volume / expected - 1.0).abs() < 1e-12, "{k}: {volume:e} {expected:e}");
        seen += 1;
    });
    assert_eq!(seen, 3);
    assert!((0.0..1e-15 * thick).contains(&ledger.films()[0]), "{:e}", ledger.films()[0]);
    assert!(ledger.imbalance().abs() < 1e-15);
}

/// Three spheres in a row fly out of the scene, the middle one's bridges with them.
#[test]
fn the_bridges_of_a_particle_that_leaves_go_back_to_the_bodies() {
    let classes = [1e-3, 1.5e-3].map(|r| Class::new(r, 2500.0, 0).unwrap());
    let mut particles = Particles::new(classes.to_vec()).unwrap();
    let velocity = 0.2 * DVec3::Z;
    for (class, x) in [(0, 0.0), (1, 2.5e-3), (0, 5e-3)] {
        // The middle one is ahead.
        let z = if class == 1 { 1e-4 } else { 0.0 };
        particles.push(class, DVec3::new(x, 0.0, z), velocity, DVec3::ZERO).unwrap();
    }
    let wet = rig::any_wet(&particles, None, vec![2e-10, 7e-10, 3e-10]);
    let domain = Some((DVec3::splat(-0.1), DVec3::new(0.1, 0.1, 1.2e-4)));
    let settings = Settings { domain, ..rig::weightless(1e-6) };
    let mut simulation = Simulation::new(particles, wet, NoWalls, settings).unwrap();
    simulation.advance(64).unwrap();
    assert_eq!((simulation.term().alive(), simulation.take_departures().len()), (2, 0));
    let mut expected = simulation.term().ledger().films().to_vec();
    simulation.for_each_pair(|encounter, column| {
        let pendular_dem_core::Partner::Particle(second) = encounter.second else { panic!() };
        let shares = simulation.term().shares(column.bridge().unwrap());
        assert!(shares[0] > 0.0 && shares[1] > 0.0);
        expected[encounter.first as usize] += shares[0];
        expected[second as usize] += shares[1];
    });
    simulation.advance(64).unwrap();
    let gone = simulation.take_departures();
    assert_eq!((gone.len(), gone[0].particle.id), (1, 1));
    assert_eq!((simulation.term().alive(), simulation.term().ledger().in_bridges()), (0, 0.0));
    for (now, expected) in simulation.term().ledger().films().iter().zip(&expected) {
        assert!((now / expected - 1.0).abs() < 1e-14);
    }
    let drained = simulation.term_mut().drain(1);
    assert!((drained / expected[1] - 1.0).abs() < 1e-14);
    let ledger = simulation.term().ledger();
    assert_eq!((ledger.films()[1], ledger.drained()), (0.0, drained));
    assert!(ledger.imbalance().abs() < 1e-15);
    simulation.advance(1_000).unwrap();
    assert_eq!(simulation.particles().len(), 0, "the others follow");
}
