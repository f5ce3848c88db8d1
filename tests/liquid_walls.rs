//! Bridges between a sphere and the parts of a wall.

use pendular::{MeshWalls, SplitMethod};
use pendular_capillary::{AnyCapillary, CapillaryLaw};
use pendular_dem_core::{Class, DVec3, Particles, Settings, Simulation};
use pendular_pair::{Bridge, Mate, Range};
use pendular_walls::{Mesh, Part, Plane, Shape, Walls, build};

use crate::rig::{self, Rub};

const RUB: Rub = Rub { stiffness: 1e4, restitution: 0.8, friction: 0.4, rolling: 2e-5 };

fn floor(cuts: [u32; 2]) -> Mesh {
    let corner = DVec3::new(-5e-3, -5e-3, 0.0);
    build::rectangle(corner, 3e-2 * DVec3::X, 1e-2 * DVec3::Y, cuts).unwrap()
}

/// A wet sphere on a plate that is taken away.
#[test]
fn the_bridge_of_a_wall_that_is_taken_away_goes_back_to_the_bodies() {
    let class = Class::new(1e-3, 2500.0, 0).unwrap();
    let mut particles = Particles::new(vec![class]).unwrap();
    particles.push(0, DVec3::new(1e-3, 1e-4, 1e-3), DVec3::ZERO, DVec3::ZERO).unwrap();
    let plate = Part::new("plate", Shape::Mesh(floor([6, 2]))).until(1e-3);
    let below = Plane::new(DVec3::Z * -3e-3, DVec3::Z, 1.0).unwrap();
    let walls = Walls::new(vec![plate, Part::new("below", Shape::Plane(below))]).unwrap();
    let wet = rig::any_wet(&particles, Some(&walls), vec![4e-10]);
    let rub = Rub { restitution: 0.3, ..RUB };
    let term = (rig::contact(particles.classes(), rub), wet);
    let settings = Settings::new(5e-6);
    let mut simulation = Simulation::new(particles, term, MeshWalls(walls), settings).unwrap();
    simulation.advance(180).unwrap();
    assert!(simulation.time() < 1e-3);
    assert_eq!(simulation.term().1.alive(), 1);
    let volume = simulation.term().1.ledger().in_bridges();
    let cap = 0.5 * (1.0 - 0.75_f64.sqrt());
    assert!((volume / (4e-10 * cap) - 1.0).abs() < 1e-14, "{volume:e}");
    let bridge = (0..10).find(|&k| simulation.term().1.shares(k)[0] > 0.0).unwrap();
    let [to_sphere, to_wall] = simulation.term().1.shares(bridge);
    simulation.advance(100).unwrap();
    let ledger = simulation.term().1.ledger();
    assert_eq!((simulation.term().1.alive(), ledger.in_bridges()), (0, 0.0));
    assert!((ledger.films()[0] - (4e-10 - volume + to_sphere)).abs() < 1e-24);
    let plate: f64 = ledger.walls()[..24].iter().sum();
    assert!((plate - to_wall).abs() < 1e-24 && to_wall > 0.0);
    assert!(ledger.imbalance().abs() < 1e-14);
    // It falls on what is below and is wet again there.
    simulation.advance(10_000).unwrap();
    assert!(simulation.term().1.ledger().imbalance().abs() < 1e-14);
    assert_eq!((simulation.term().1.alive(), simulation.term().1.counts().formed), (1, 2));
}

/// The bridge of a rolling sphere moves from triangle to triangle with its volume.
#[test]
fn a_rolling_sphere_keeps_its_one_bridge_over_many_triangles() {
    let class = Class::new(1e-3, 2500.0, 0).unwrap();
    let run = |shape: Shape| {
        let mut particles = Particles::new(vec![class]).unwrap();
        let start = DVec3::new(0.0, 2.1e-4, 0.99995e-3);
        let velocity = 0.2 * DVec3::new(1.0, 0.1, 0.0);
        let spin = DVec3::Z.cross(velocity) / 1e-3;
        particles.push(0, start, velocity, spin).unwrap();
        let walls = Walls::new(vec![Part::new("floor", shape)]).unwrap();
        let wet = rig::any_wet(&particles, Some(&walls), vec![4e-10]);
        let term = (rig::contact(particles.classes(), RUB), wet);
        let settings = Settings::new(5e-6);
        let mut simulation = Simulation::new(particles, term, MeshWalls(walls), settings).unwrap();
        simulation.advance(2).unwrap();
        let volume = simulation.term().1.ledger().in_bridges();
        for _ in 0..400 {
            simulation.advance(25).unwrap();
            let wet = &simulation.term().1;
            let counts = (wet.counts().formed, wet.counts().ruptured);
            assert_eq!((counts, wet.ledger().in_bridges()), ((1, 0), volume));
            assert!(wet.ledger().walls().iter().all(|&v| v == 0.0));
        }
        rig::at(&simulation, 0)
    };
    let rolled = run(Shape::Mesh(floor([90, 29])));
    assert!(rolled.position.x > 8e-3, "{rolled:?}");
    let plane = run(Shape::Plane(Plane::new(DVec3::ZERO, DVec3::Z, 3e-4).unwrap()));
    assert!((rolled.position - plane.position).length() < 1e-12, "{rolled:?} {plane:?}");
    assert!((rolled.spin - plane.spin).length() < 1e-7);
}

/// Where a bridge breaks, the wall's share lies on the triangle that is nearest then.
#[test]
fn a_bridge_that_moved_on_breaks_over_its_last_triangle() {
    let class = Class::new(1e-3, 2500.0, 0).unwrap();
    let mut particles = Particles::new(vec![class]).unwrap();
    let start = DVec3::new(2e-4, 2.1e-4, 1e-3);
    particles.push(0, start, DVec3::new(2.0, 0.3, 0.2), DVec3::ZERO).unwrap();
    let mesh = floor([60, 20]);
    let corners: Vec<_> =
        mesh.indices().iter().map(|t| t.map(|v| mesh.points()[v as usize])).collect();
    let walls = Walls::new(vec![Part::new("floor", Shape::Mesh(mesh))]).unwrap();
    let bodies = rig::bodies(&particles, Some(&walls));
    let laws = rig::static_laws(rig::NoPull);
    let liquid = rig::liquid(0.07, 1e-3, 0.3);
    let wet = rig::wet(liquid, laws, bodies, vec![4e-10], SplitMethod::Half);
    let settings = rig::weightless(5e-6);
    let mut simulation = Simulation::new(particles, wet, MeshWalls(walls), settings).unwrap();
    let mut foot = DVec3::ZERO;
    simulation.advance(1).unwrap();
    while simulation.term().alive() > 0 {
        let at = rig::at(&simulation, 0).position;
        foot = DVec3::new(at.x, at.y, 0.0);
        simulation.advance(1).unwrap();
    }
    assert!(foot.x > 2e-3, "{foot}");
    let ledger = simulation.term().ledger();
    let wetted: Vec<_> = (0..corners.len()).filter(|&k| ledger.walls()[k] > 0.0).collect();
    assert_eq!(wetted.len(), 1);
    let [a, b, c] = corners[wetted[0]];
    let area = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).z.abs();
    let parts = area(foot, a, b) + area(foot, b, c) + area(foot, c, a);
    assert!((parts / area(a, b, c) - 1.0).abs() < 1e-9, "{foot} is not in {a} {b} {c}");
    assert!(ledger.imbalance().abs() < 1e-14);
}

/// A sphere drifts from the floor of a box to its side: one bridge with the part, always at the
/// nearest surface, handed on where the side becomes nearer, with its volume.
#[test]
fn a_bridge_is_handed_on_from_the_floor_to_the_side_of_a_part() {
    let r = 1e-3;
    // So heavy that the liquid hardly bends the path.
    let class = Class::new(r, 1e7, 0).unwrap();
    let mut particles = Particles::new(vec![class]).unwrap();
    let side = 10e-3;
    let (low, high) = (DVec3::new(0.0, -6e-3, 0.0), DVec3::new(side, 6e-3, 8e-3));
    let tray = build::open_box(low, high, true, 2.5e-3).unwrap();
    let walls = Walls::new(vec![Part::new("box", Shape::Mesh(tray))]).unwrap();
    let start = DVec3::new(side - r - 3e-4, 2.3e-4, r);
    let velocity = 0.05 * DVec3::new(1.0, 0.0, 1.0);
    particles.push(0, start, velocity, DVec3::ZERO).unwrap();
    let bodies = rig::bodies(&particles, Some(&walls));
    let laws = rig::static_laws(AnyCapillary::Lambert);
    let liquid = rig::liquid(0.07, 1e-3, 0.3);
    let wet = rig::wet(liquid, laws, bodies, vec![4e-10], SplitMethod::Half);
    let h = 1e-5;
    let settings = rig::weightless(h);
    let mut simulation = Simulation::new(particles, wet, MeshWalls(walls), settings).unwrap();
    simulation.advance(1).unwrap();
    let volume = simulation.term().ledger().in_bridges();
    let bridge = Bridge::new(r, Mate::PLANE, volume, [0.3; 2], 0.07).unwrap();
    let range = Range::Extrapolate;
    let mut seen = [0, 0];
    for _ in 0..500 {
        let before = rig::at(&simulation, 0);
        simulation.advance(1).unwrap();
        let after = rig::at(&simulation, 0);
        let gaps = [before.position.z - r, side - before.position.x - r];
        let to = usize::from(gaps[1] < gaps[0]);
        seen[to] += 1;
        let towards = [DVec3::NEG_Z, DVec3::X][to];
        let pull = AnyCapillary::Lambert.force(&bridge, gaps[to], range).unwrap();
        let felt = class.mass() / h * (after.velocity - before.velocity);
        assert!((felt - pull * towards).length() < 1e-6 * pull, "{gaps:?}: {felt} {pull:e}");
        let wet = simulation.term();
        assert_eq!((wet.counts().formed, wet.counts().ruptured), (1, 0));
        assert_eq!(wet.ledger().in_bridges(), volume);
    }
    assert!(seen[0] > 100 && seen[1] > 100, "{seen:?}");
}
