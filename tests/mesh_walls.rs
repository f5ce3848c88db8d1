//! Walls through the whole core: triangles do what the surfaces they stand for do.

use std::f64::consts::TAU;

use pendular::MeshWalls;
use pendular_dem_core::{Class, Contact, DVec3, Particle, Particles, Settings, Simulation};
use pendular_walls::{
    FrameKind, Harmonic, Mesh, Motion, Part, Plane, Shape, Sieve, Walls, Wires, build,
};
use rand_pcg::Pcg64;
use rand_pcg::rand_core::SeedableRng;

use crate::rig::{self, Rub};

type Dry = Simulation<Contact<pendular_contact::Linear>, MeshWalls>;

const RUB: Rub = Rub { stiffness: 1e4, restitution: 0.8, friction: 0.4, rolling: 2e-5 };

fn dry(particles: Particles, parts: Vec<Part>, rub: Rub, settings: Settings) -> Dry {
    let contact = rig::contact(particles.classes(), rub);
    let walls = MeshWalls(Walls::new(parts).unwrap());
    Simulation::new(particles, contact, walls, settings).unwrap()
}

fn one(radius: f64, at: DVec3, velocity: DVec3, spin: DVec3) -> Particles {
    let mut particles = Particles::new(vec![Class::new(radius, 2500.0, 0).unwrap()]).unwrap();
    particles.push(0, at, velocity, spin).unwrap();
    particles
}

/// The plane z = 0 from -12 to 12 mm: a half-space, two triangles, 200 triangles, and 200 whose
/// vertices lie on the path of what moves along y = 0.
fn planes() -> Vec<(&'static str, Shape)> {
    let mesh = |cuts, shift: f64| {
        let corner = DVec3::new(-12e-3, -12e-3 + shift, 0.0);
        Shape::Mesh(build::rectangle(corner, 24e-3 * DVec3::X, 24e-3 * DVec3::Y, cuts).unwrap())
    };
    vec![
        ("half-space", Shape::Plane(Plane::new(DVec3::ZERO, DVec3::Z, 6e-4).unwrap())),
        ("2 triangles", mesh([1, 1], 0.0)),
        ("200 triangles", mesh([10, 10], 1.7e-3)),
        ("200 triangles, vertices on the path", mesh([10, 10], 0.0)),
    ]
}

/// Runs the same sphere on every one of the planes and returns its states every so often.
fn on_all(
    start: impl Fn() -> Particles,
    rub: Rub,
    settings: Settings,
    rounds: usize,
) -> Vec<(&'static str, Vec<Particle>)> {
    let run = |(name, shape)| {
        let mut simulation = dry(start(), vec![Part::new("floor", shape)], rub, settings);
        let round = |_| {
            simulation.advance(100).unwrap();
            rig::at(&simulation, 0)
        };
        (name, (0..rounds).map(round).collect())
    };
    planes().into_iter().map(run).collect()
}

fn assert_same(all: &[(&str, Vec<Particle>)], radius: f64, speed: f64) {
    let (_, plane) = &all[0];
    for (name, path) in &all[1..] {
        for (k, (a, b)) in plane.iter().zip(path).enumerate() {
            let moved = (a.position - b.position).length();
            assert!(moved < 1e-12 * radius.max(1e-3), "{name} {k}: {moved:e} m");
            let sped = (a.velocity - b.velocity).length();
            assert!(sped < 1e-12 * speed.max(1.0), "{name} {k}: {sped:e} m/s");
            let spun = radius * (a.spin - b.spin).length();
            assert!(spun < 1e-12 * speed.max(1.0), "{name} {k}: {spun:e} m/s of spin");
        }
    }
}

/// Dropped obliquely with spin, friction and rolling friction, bouncing over seams and vertices.
#[test]
fn a_plane_is_the_same_plane_in_any_number_of_triangles() {
    for y in [0.0, 3.3e-4] {
        let start = || {
            let velocity = DVec3::new(0.2, 0.0, -0.15);
            one(1.3e-3, DVec3::new(-8e-3, y, 1.5e-3), velocity, DVec3::new(60.0, 150.0, 40.0))
        };
        let all = on_all(start, RUB, Settings::new(2e-6), 400);
        let end = all[0].1[399].position;
        assert!(end.x > 1e-3, "{end}");
        let turns = all[0].1.windows(2).filter(|p| p[0].velocity.z < 0.0 && p[1].velocity.z > 0.0);
        assert!(turns.count() >= 3, "it has hardly bounced");
        assert_same(&all, 1.3e-3, 0.5);
    }
}

/// Rolling without slip over 10 seams and along a row of vertices: nothing is felt.
#[test]
fn a_rolling_sphere_does_not_feel_a_seam() {
    let r = 1.3e-3;
    let class = Class::new(r, 2500.0, 0).unwrap();
    let rub = Rub { rolling: 0.0, restitution: 0.6, ..RUB };
    let settings = Settings::new(2e-6);
    let sunk = class.mass() * 9.81 / rub.stiffness;
    for (y, across) in [(0.0, 0.0), (4e-4, 0.13)] {
        let start = || {
            let velocity = 0.4 * DVec3::new(1.0, across, 0.0);
            // About the centre, over the ground: the lever is the radius.
            let spin = DVec3::Z.cross(velocity) / r;
            one(r, DVec3::new(-10e-3, y, r - sunk), velocity, spin)
        };
        let all = on_all(start, rub, settings, 240);
        assert_same(&all, r, 0.4);
        for (name, path) in &all {
            for p in path {
                assert!((p.velocity.x - 0.4).abs() < 1e-12, "{name}: {}", p.velocity.x);
                assert!((p.position.z - (r - sunk)).abs() < 1e-15, "{name}: {:e}", p.position.z);
            }
            assert!(path[239].position.x > 8e-3);
        }
    }
}

/// Height above the axes at which a disc of radius `r`, `side` from the axis of a wire, rests on
/// the regular polygon of `sides` sides around the circle of radius `w`, one side on top.
fn height_on_prism(r: f64, side: f64, w: f64, sides: u32) -> f64 {
    let angle = |k: u32| TAU * (f64::from(k) + 0.5) / f64::from(sides);
    let corner = w / (0.5 * TAU / f64::from(sides)).cos();
    let mut height = f64::NEG_INFINITY;
    for k in 0..sides / 4 {
        // On the corner, if it is the nearest point; a face is never nearer than its corners
        // unless the foot of the perpendicular lies on it.
        let (sin, cos) = angle(k).sin_cos();
        let aside = side - corner * sin;
        if aside.abs() <= r {
            height = height.max(corner * cos + (r * r - aside * aside).sqrt());
        }
        let normal = TAU * f64::from(k) / f64::from(sides);
        let z = (w + r - side * normal.sin()) / normal.cos();
        let along = side * normal.cos() - z * normal.sin();
        if along.abs() <= w * (0.5 * TAU / f64::from(sides)).tan() {
            height = height.max(z);
        }
    }
    height
}

/// A 10 mm sphere in an aperture of 8 mm between wires of 2 mm touches four of them at once and
/// rests √(6² − 5²) = 3.317 mm above their axes.
#[test]
fn a_sphere_rests_in_an_aperture() {
    let fit = build::Fit::Circumscribed;
    let kinds = [
        (Wires::Cylinders, 11f64.sqrt() * 1e-3),
        (Wires::Prisms { sides: 16, fit }, height_on_prism(5e-3, 5e-3, 1e-3, 16)),
        (Wires::Prisms { sides: 64, fit }, height_on_prism(5e-3, 5e-3, 1e-3, 64)),
    ];
    for (wires, height) in kinds {
        let sieve = Sieve {
            aperture: 8e-3,
            wire_diameter: 2e-3,
            frame_radius: 0.03,
            frame_bottom: -0.01,
            frame_top: 0.03,
            wires,
            frame: FrameKind::Cylinder { patches: [12, 2] },
            element_length: 10e-3,
        };
        let class = Class::new(5e-3, 1342.5, 0).unwrap();
        let mut particles = Particles::new(vec![class]).unwrap();
        let start = DVec3::new(1e-5, -2e-5, height + 1e-4);
        particles.push(0, start, DVec3::ZERO, DVec3::ZERO).unwrap();
        let rub = Rub { stiffness: 1e5, restitution: 0.3, ..RUB };
        let settings = Settings::new(4e-6);
        let mut simulation = dry(particles, sieve.parts().unwrap(), rub, settings);
        simulation.advance(100_000).unwrap();
        let p = rig::at(&simulation, 0);
        // Four contacts carry the weight: each gives way by m g/(4 k cos) along its normal, with
        // cos the height over 6 mm, and the sphere sinks by that over cos.
        let cos = 3.317 / 6.0;
        let sunk = class.mass() * 9.81 / (4.0 * 1e5 * cos * cos);
        assert!((p.position.z - height).abs() < 2.0 * sunk + 1e-9, "{wires:?} {}", p.position.z);
        assert!(p.velocity.length() < 1e-6, "{wires:?}: {p:?}");
        assert!(p.position.truncate().length() < 3e-5);
        let near = if matches!(wires, Wires::Prisms { sides: 16, .. }) { 5e-5 } else { 4e-6 };
        assert!((p.position.z - 3.317e-3).abs() < near, "{wires:?}: {}", p.position.z);
    }
}

/// Fast spheres rain on a box of triangles and on a sieve that is too fine for them.
#[test]
fn nothing_falls_through() {
    let mesh = build::open_box(
        DVec3::new(-12e-3, -12e-3, 0.0),
        DVec3::new(12e-3, 12e-3, 40e-3),
        true,
        3e-3,
    );
    let boxed = vec![Part::new("box", Shape::Mesh(mesh.unwrap()))];
    let sieve = |wires| Sieve {
        aperture: 1.6e-3,
        wire_diameter: 0.8e-3,
        frame_radius: 17e-3,
        frame_bottom: -5e-3,
        frame_top: 40e-3,
        wires,
        frame: FrameKind::Prism { sides: 24, bands: 4 },
        element_length: 5e-3,
    };
    let prisms = Wires::Prisms { sides: 8, fit: build::Fit::Circumscribed };
    let scenes = [
        ("box", boxed),
        ("cylinders", sieve(Wires::Cylinders).parts().unwrap()),
        ("prisms", sieve(prisms).parts().unwrap()),
    ];
    for (name, parts) in scenes {
        let class = Class::new(1e-3, 2500.0, 0).unwrap();
        let mut particles = Particles::new(vec![class]).unwrap();
        let mut random = Pcg64::seed_from_u64(2);
        for k in 0..150 {
            let at = [k % 5, k / 5 % 5, k / 25].map(|k| 3e-3 * f64::from(k));
            let mut any = |s: f64| rig::uniform(&mut random, -s, s);
            let x = DVec3::from_array(at) + DVec3::new(-6e-3, -6e-3, 4e-3);
            let v = DVec3::new(any(1.0), any(1.0), -3.0 + any(1.0));
            let jitter = DVec3::new(any(3e-4), any(3e-4), any(3e-4));
            particles.push(0, x + jitter, v, DVec3::ZERO).unwrap();
        }
        let rub = Rub { stiffness: 1e5, ..RUB };
        let mut simulation = dry(particles, parts, rub, Settings::new(1e-6));
        for _ in 0..20 {
            simulation.advance(1_000).unwrap();
            for p in simulation.particles().iter() {
                let x = p.position;
                let aside = x.truncate().abs().max_element();
                let inside = if name == "box" {
                    x.z > 0.8e-3 && aside < 11.2e-3
                } else {
                    x.z > 0.3e-3 && x.truncate().length() < 16.2e-3
                };
                // Who bounced out over the rim may be anywhere.
                assert!(inside || x.z > 39e-3, "{name}: {x} at {}", simulation.time());
            }
        }
        assert!(simulation.largest_overlap() < 0.15, "{name}: {}", simulation.largest_overlap());
    }
}

/// Below 1 g a sphere never leaves a vibrating plate: it has the plate's place and velocity, on
/// triangles as on a half-space.
#[test]
fn a_sphere_rides_on_a_vibrating_part() {
    let (amplitude, frequency, r) = (5e-5, 50.0, 1.3e-3);
    let w = TAU * frequency;
    let term = Harmonic { amplitude: amplitude * DVec3::Z, frequency, phase: 0.0 };
    let class = Class::new(r, 2500.0, 0).unwrap();
    let rub = Rub { stiffness: 1e5, restitution: 0.3, ..RUB };
    let sunk = class.mass() * 9.81 / rub.stiffness;
    for (name, shape) in planes() {
        let part = Part::new("plate", shape).with_motion(Motion::harmonic(term));
        let start = DVec3::new(2.2e-3, 3e-4, r - sunk);
        let particles = one(r, start, amplitude * w * DVec3::Z, DVec3::ZERO);
        let mut simulation = dry(particles, vec![part], rub, Settings::new(1e-6));
        for _ in 0..50 {
            simulation.advance(1_000).unwrap();
            let (p, t) = (rig::at(&simulation, 0), simulation.time());
            let rest = start + amplitude * (w * t).sin() * DVec3::Z;
            assert!((p.position - rest).length() < 2e-8, "{name} {t}: {}", p.position - rest);
            let speed = amplitude * w * (w * (t - 5e-7)).cos();
            assert!((p.velocity.z - speed).abs() < 2e-5, "{name} {t}");
            assert!(p.velocity.truncate().length() < 1e-12, "{name} {t}: {}", p.velocity);
        }
    }
}

/// A sphere on a part that vibrates sideways is taken along by friction: the plate's
/// velocity counts, not only its place.
#[test]
fn friction_takes_a_sphere_along_with_a_part() {
    let (amplitude, frequency, r) = (2e-4, 20.0, 1.3e-3);
    let w = TAU * frequency;
    // Still at t = 0, then off along x.
    let term = Harmonic { amplitude: amplitude * DVec3::X, frequency, phase: 0.25 * TAU };
    let class = Class::new(r, 2500.0, 0).unwrap();
    let rub = Rub { rolling: 0.0, friction: 2.0, ..RUB };
    let sunk = class.mass() * 9.81 / rub.stiffness;
    let mut ends = Vec::new();
    for (_, shape) in planes() {
        let part = Part::new("plate", shape).with_motion(Motion::harmonic(term));
        let start = DVec3::new(2.2e-3, 3e-4, r - sunk);
        let particles = one(r, start, DVec3::ZERO, DVec3::ZERO);
        let mut simulation = dry(particles, vec![part], rub, Settings::new(2e-6));
        // Half a period.
        let steps = (0.5 / frequency / 2e-6) as u64;
        simulation.advance(steps).unwrap();
        ends.push(rig::at(&simulation, 0));
        // Rolling without slip on a plate at speed u: v = 2/7 u; the plate went back by 2 A.
        let moved = ends[ends.len() - 1].position.x - start.x;
        assert!((moved / (-2.0 / 7.0 * 2.0 * amplitude) - 1.0).abs() < 2e-2, "{moved:e}");
        assert!((w * amplitude - simulation.boundary().0.speed_bound()).abs() < 1e-12);
    }
    for end in &ends[1..] {
        assert!((end.position - ends[0].position).length() < 1e-14);
    }
}

/// The same mesh out of one and out of two parts.
#[test]
fn two_parts_that_meet_at_a_seam_carry_a_resting_sphere() {
    let half = |x: f64| -> Mesh {
        let corner = DVec3::new(x, -5e-3, 0.0);
        build::rectangle(corner, 5e-3 * DVec3::X, 1e-2 * DVec3::Y, [2, 2]).unwrap()
    };
    let parts = vec![
        Part::new("left", Shape::Mesh(half(-5e-3))),
        Part::new("right", Shape::Mesh(half(0.0))),
    ];
    let r = 1.3e-3;
    let particles = one(r, DVec3::new(0.0, 1e-4, r), DVec3::ZERO, DVec3::ZERO);
    let mass = particles.classes()[0].mass();
    let rub = Rub { restitution: 0.3, ..RUB };
    let mut simulation = dry(particles, parts, rub, Settings::new(5e-6));
    simulation.advance(20_000).unwrap();
    let p = rig::at(&simulation, 0);
    // Each part is a surface of its own: two contacts carry the weight.
    let sunk = mass * 9.81 / (2.0 * rub.stiffness);
    assert!((p.position.z - (r - sunk)).abs() < 1e-3 * sunk, "{:e}", r - p.position.z);
    assert!(p.velocity.length() < 1e-9 && p.position.x.abs() < 1e-12);
}
