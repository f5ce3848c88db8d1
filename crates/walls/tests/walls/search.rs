//! The three levels of search agree with asking everything.

use pendular_walls::build::{Fit, open_box, plate};
use pendular_walls::glam::DVec3;
use pendular_walls::{FrameKind, Harmonic, Motion, Part, Plane, Shape, Sieve, Touch, Walls, Wires};
use proptest::prelude::*;
use std::sync::LazyLock;

/// A shaken screen of prisms, one of round wires below it, a box, a plate, a floor until t = 0.1.
static WALLS: LazyLock<Walls> = LazyLock::new(|| {
    let sieve = Sieve {
        aperture: 4e-3,
        wire_diameter: 1e-3,
        frame_radius: 0.03,
        frame_bottom: -0.01,
        frame_top: 0.02,
        wires: Wires::Prisms { sides: 8, fit: Fit::EqualVolume },
        frame: FrameKind::Prism { sides: 24, bands: 2 },
        element_length: 0.01,
    };
    let round =
        Sieve { wires: Wires::Cylinders, frame: FrameKind::Cylinder { patches: [3, 2] }, ..sieve };
    let term = |amplitude: [f64; 3], phase| Harmonic {
        amplitude: DVec3::from_array(amplitude),
        frequency: 50.6,
        phase,
    };
    let motion = Motion {
        terms: vec![term([0.0, 1e-4, 9e-4], 0.0), term([3e-4, 0.0, 0.0], 1.0)],
        ramp: 0.05,
    };
    let shake = |part: Part| part.with_motion(motion.clone());
    let mut parts: Vec<Part> = sieve.parts().unwrap().into_iter().map(shake).collect();
    for mut part in round.parts().unwrap() {
        part.name += " round";
        part.motion = Motion::harmonic(term([0.0, 0.0, 2e-3], 2.0));
        parts.push(part);
    }
    let min = DVec3::new(-0.035, -0.035, -0.02);
    let mesh = open_box(min, -min, true, 0.015).unwrap();
    parts.push(Part::new("bin", Shape::Mesh(mesh)));
    let mesh = plate(DVec3::new(0.0, 0.0, 0.01), 0.03, 0.03, 0.4, [2, 2]).unwrap();
    parts.push(Part::new("plate", Shape::Mesh(mesh)));
    let plane = Plane::new(DVec3::Z * -0.015, DVec3::Z, 1.0).unwrap();
    parts.push(Part::new("floor", Shape::Plane(plane)).until(0.1));
    Walls::new(parts).unwrap()
});

/// Touches with every part and every triangle.
fn brute(walls: &Walls, centre: DVec3, radius: f64, reach: f64) -> Vec<(u32, Touch)> {
    let mut found = Vec::new();
    let mut out = Vec::new();
    for (k, part) in walls.parts().iter().enumerate() {
        let everything: Vec<u32> = (0..part.shape.element_count()).collect();
        walls.touches(k as u32, &everything, centre, radius, reach, &mut out);
        found.extend(out.iter().map(|t| (k as u32, *t)));
    }
    found
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn a_list_with_skin_misses_no_touch(
        place in prop::array::uniform3(-0.036..0.036), time in 0.0..0.2, later in -2e-3..2e-3,
        step in prop::array::uniform3(-1.0..1.0), far in 0.0..1.0,
        radius in 1e-3..4e-3, reach in 0.0..1e-3,
    ) {
        let mut walls = WALLS.clone();
        let centre = DVec3::from_array(place);
        // The lists are made at one moment …
        walls.move_to(time, time);
        let before: Vec<DVec3> =
            (0..walls.parts().len() as u32).map(|k| walls.displacement(k)).collect();
        let sphere_moves = 1e-3;
        let skin = sphere_moves + walls.speed_bound() * f64::abs(later);
        let mut near = Vec::new();
        walls.near(centre, radius + reach + skin, &mut near);
        prop_assert!(near.is_sorted());
        let lists: Vec<Vec<u32>> = near
            .iter()
            .map(|part| {
                let mut list = Vec::new();
                walls.candidates(*part, centre, radius + reach + skin, &mut list);
                list
            })
            .collect();
        // … and used at another.
        walls.move_to(time + later, time);
        for (k, old) in before.iter().enumerate() {
            let moved = walls.displacement(k as u32).distance(*old);
            prop_assert!(moved <= walls.speed_bound() * f64::abs(later) + 1e-15);
        }
        let centre = centre + DVec3::from_array(step).normalize_or_zero() * (far * sphere_moves);
        let mut found = Vec::new();
        let mut out = Vec::new();
        for (part, list) in near.iter().zip(&lists) {
            walls.touches(*part, list, centre, radius, reach, &mut out);
            found.extend(out.iter().map(|t| (*part, *t)));
        }
        // A floor that is back in time was not listed: only lists made before count.
        let floor = walls.parts().len() as u32 - 1;
        let mut expected = brute(&walls, centre, radius, reach);
        if time >= 0.1 {
            expected.retain(|(part, _)| *part != floor);
        }
        prop_assert_eq!(found, expected);
    }
}

#[test]
fn the_search_meets_touches_at_all() {
    // The test above would pass on walls that are never touched.
    let mut meshes = 0;
    let mut others = 0;
    for k in 0..2000u32 {
        let at = |step: f64| 0.07 * (f64::from(k) * step).fract() - 0.035;
        let centre = DVec3::new(at(0.8191725), at(0.6710436), at(0.5497005));
        for (part, _) in brute(&WALLS, centre, 2.5e-3, 5e-4) {
            let mesh = matches!(WALLS.parts()[part as usize].shape, Shape::Mesh(_));
            if mesh { meshes += 1 } else { others += 1 }
        }
    }
    assert!(meshes > 500 && others > 500, "{meshes} {others}");
}

#[test]
fn a_part_is_taken_away_at_its_time() {
    let mut walls = WALLS.clone();
    let floor = walls.parts().len() as u32 - 1;
    let centre = DVec3::new(0.0, 0.0, -0.013);
    let (mut near, mut out) = (Vec::new(), Vec::new());
    for (time, present) in [(0.0, true), (0.0999, true), (0.1, false), (5.0, false)] {
        walls.move_to(time, time);
        assert_eq!(walls.is_present(floor), present);
        walls.near(centre, 3e-3, &mut near);
        assert_eq!(near.contains(&floor), present);
        walls.touches(floor, &[], centre, 3e-3, 0.0, &mut out);
        assert_eq!(out.len(), usize::from(present));
    }
}

#[test]
fn pose_and_velocity_have_their_own_times() {
    let mut walls = WALLS.clone();
    walls.move_to(0.123, 0.1225);
    let motion = &walls.parts()[0].motion;
    assert_eq!(walls.displacement(0), motion.displacement(0.123));
    assert_eq!(walls.velocity(0), motion.velocity(0.1225));
    assert_eq!(walls.time(), 0.123);
    let still = walls.parts().len() as u32 - 2;
    assert_eq!((walls.displacement(still), walls.velocity(still)), (DVec3::ZERO, DVec3::ZERO));
    assert!(walls.speed_bound() >= walls.velocity(0).length());
    assert_eq!(walls.tessellation(0, 8).points[0], {
        let Shape::Mesh(mesh) = &walls.parts()[0].shape else { panic!() };
        mesh.points()[0] + walls.displacement(0)
    });
}

#[test]
fn walls_can_be_shared_between_threads() {
    fn shareable<T: Send + Sync>(_: &T) {}
    shareable(&*WALLS);
}
