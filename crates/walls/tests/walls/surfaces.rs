//! What counts as one contact on a mesh.

use crate::{one, touches};
use pendular_walls::build::{open_box, rectangle};
use pendular_walls::glam::{DMat3, DVec3};
use pendular_walls::{Mesh, Plane, Shape, Touch};
use proptest::prelude::*;

const R: f64 = 2.5e-3;

/// Same gap and normal to 1e-12 of a radius and of 1.
fn same(a: &Touch, b: &Touch) -> bool {
    (a.gap - b.gap).abs() < 1e-12 * R && (a.normal - b.normal).length() < 1e-12
}

fn floor(cuts: [u32; 2]) -> Mesh {
    let edge = 0.1;
    let corner = DVec3::new(-0.5 * edge, -0.5 * edge, 0.0);
    rectangle(corner, DVec3::X * edge, DVec3::Y * edge, cuts).unwrap()
}

/// Turns a mesh and makes it anew.
fn turned(mesh: &Mesh, turn: DMat3) -> Mesh {
    let points = mesh.points().iter().map(|p| turn * *p).collect();
    Mesh::new(points, mesh.indices().to_vec()).unwrap()
}

/// Random places over the floor, and places above its seams and vertices.
fn place() -> impl Strategy<Value = (f64, f64)> {
    let on_grid =
        (-4i32..5, -4i32..5).prop_map(|(i, j)| (0.01 * f64::from(i), 0.01 * f64::from(j)));
    let on_seam = (-0.04..0.04, -4i32..5).prop_map(|(x, j): (f64, i32)| (x, 0.01 * f64::from(j)));
    let on_diagonal = (-0.04..0.04).prop_map(|x: f64| (x, x));
    let anywhere = (-0.04..0.04, -0.04..0.04);
    prop_oneof![on_grid, on_seam, on_diagonal, anywhere]
}

proptest! {
    #[test]
    fn a_plane_however_it_is_made((x, y) in place(), gap in -1e-4..1e-3, turn in 0.0..6.0) {
        let turn = DMat3::from_rotation_x(turn) * DMat3::from_rotation_y(0.3 * turn);
        let plane = Plane::new(DVec3::ZERO, turn * DVec3::Z, 0.01).unwrap();
        let whole = one(Shape::Plane(plane));
        let centre = turn * DVec3::new(x, y, R + gap);
        let expected = touches(&whole, 0, centre, R, 2e-3);
        prop_assert_eq!(expected.len(), 1);
        prop_assert!(f64::abs(expected[0].gap - gap) < 1e-15);
        // 2 and 200 triangles, and the same from below.
        for cuts in [[1, 1], [10, 10]] {
            let mesh = one(Shape::Mesh(turned(&floor(cuts), turn)));
            let found = touches(&mesh, 0, centre, R, 2e-3);
            prop_assert_eq!(found.len(), 1, "{:?}", found);
            prop_assert!(same(&found[0], &expected[0]), "{:?} {:?}", found, expected);
            let below = turn * DVec3::new(x, y, -R - gap);
            let found = touches(&mesh, 0, below, R, 2e-3);
            prop_assert_eq!(found.len(), 1);
            prop_assert!(f64::abs(found[0].gap - gap) < 1e-12 * R);
            prop_assert!((found[0].normal + expected[0].normal).length() < 1e-12);
        }
    }

    #[test]
    fn an_inner_corner_gives_a_touch_per_face(
        y in -0.04..0.04, gap_floor in -1e-4..1e-4, gap_wall in -1e-4..1e-4,
        lean in -0.7..1.2, turn in 0.0..6.0, cuts in 1u32..7,
    ) {
        // A floor x > 0, and a wall from its edge x = 0 that leans by an angle from the upright.
        let (sin, cos) = f64::sin_cos(lean);
        let edge = DVec3::Y * 0.1;
        let up = DVec3::new(-sin, 0.0, cos) * 0.1;
        let corner = -0.5 * edge;
        let faces = [
            rectangle(corner, DVec3::X * 0.1, edge, [cuts, 2 * cuts]).unwrap(),
            rectangle(corner, up, edge, [cuts, cuts]).unwrap(),
        ];
        let triangles: Vec<[DVec3; 3]> = faces
            .iter()
            .flat_map(|m| m.indices().iter().map(|t| t.map(|v| m.points()[v as usize])))
            .collect();
        let turn = DMat3::from_rotation_z(turn);
        let walls = one(Shape::Mesh(turned(&Mesh::from_triangles(&triangles).unwrap(), turn)));
        // The wall's normal towards the sphere is (cos, 0, sin).
        let (height, off) = (R + gap_floor, R + gap_wall);
        let centre = DVec3::new((off - height * sin) / cos, y, height);
        // In a flat valley unequal gaps can put a foot beyond the end of its face.
        prop_assume!(centre.x > 0.0 && height * cos - centre.x * sin > 0.0);
        let found = touches(&walls, 0, turn * centre, R, 1.5e-4);
        prop_assert_eq!(found.len(), 2, "{:?}", found);
        prop_assert!(found[0].gap <= found[1].gap);
        let expected = [
            Touch { element: 0, gap: gap_floor, normal: turn * -DVec3::Z },
            Touch { element: 0, gap: gap_wall, normal: turn * DVec3::new(-cos, 0.0, -sin) },
        ];
        for e in &expected {
            prop_assert!(found.iter().any(|f| same(f, e)), "{:?} {:?}", found, expected);
        }
    }

    #[test]
    fn a_ridge_gives_one_touch(
        slope in 0.01..1.5, angle in -1.0..1.0, gap in -1e-4..1e-4, y in -0.04..0.04,
    ) {
        // Two faces that fall away from the y axis; the sphere above the ridge, within the fan of
        // directions between the two faces' normals.
        let (sin, cos) = f64::sin_cos(slope);
        let edge = DVec3::Y * 0.1;
        let half = |side: f64| {
            let down = DVec3::new(side * cos, 0.0, -sin) * 0.1;
            rectangle(-0.5 * edge, down, edge, [3, 5]).unwrap()
        };
        let triangles: Vec<[DVec3; 3]> = [half(-1.0), half(1.0)]
            .iter()
            .flat_map(|m| m.indices().iter().map(|t| t.map(|v| m.points()[v as usize])))
            .collect();
        let walls = one(Shape::Mesh(Mesh::from_triangles(&triangles).unwrap()));
        let (tilt_sin, tilt_cos) = f64::sin_cos(angle * slope);
        let out = DVec3::new(tilt_sin, 0.0, tilt_cos);
        let found = touches(&walls, 0, DVec3::Y * y + out * (R + gap), R, 2e-4);
        prop_assert_eq!(found.len(), 1, "{:?}", found);
        prop_assert!(f64::abs(found[0].gap - gap) < 1e-14);
        prop_assert!((found[0].normal + out).length() < 1e-11);
    }
}

#[test]
fn three_faces_meet_in_a_box_corner() {
    let walls =
        one(Shape::Mesh(open_box(DVec3::ZERO, DVec3::new(0.1, 0.2, 0.3), true, 0.013).unwrap()));
    let found = touches(&walls, 0, DVec3::new(R - 1e-5, R - 2e-5, R - 3e-5), R, 0.0);
    let gaps: Vec<f64> = found.iter().map(|t| t.gap).collect();
    assert_eq!(gaps.len(), 3);
    for (gap, expected) in gaps.iter().zip([-3e-5, -2e-5, -1e-5]) {
        assert!((gap - expected).abs() < 1e-17, "{gaps:?}");
    }
    assert_eq!(found[0].normal, -DVec3::Z);
}

#[test]
fn the_free_edge_and_corner_of_a_sheet() {
    let walls = one(Shape::Mesh(floor([10, 10])));
    // Beyond the edge x = 0.05 by 3, above by 4: distance 5.
    let found = touches(&walls, 0, DVec3::new(0.053, 0.0, 0.004), R, 0.01);
    assert_eq!(found.len(), 1);
    assert!((found[0].gap - (0.005 - R)).abs() < 1e-16);
    assert!((found[0].normal - DVec3::new(-0.6, 0.0, -0.8)).length() < 1e-13);
    // Beyond a corner by 2 and 3, above by 6: distance 7.
    let found = touches(&walls, 0, DVec3::new(0.052, 0.053, 0.006), R, 0.01);
    assert_eq!(found.len(), 1);
    assert!((found[0].gap - (0.007 - R)).abs() < 1e-16);
}

#[test]
fn two_edges_of_a_slot_are_two_touches() {
    // Two coplanar sheets, a slot of 6 mm between them, a sphere of 5 mm radius sunk into it.
    let edge = DVec3::Y * 0.1;
    let left = rectangle(DVec3::new(-0.1, -0.05, 0.0), DVec3::X * 0.097, edge, [1, 1]).unwrap();
    let right = rectangle(DVec3::new(0.003, -0.05, 0.0), DVec3::X * 0.097, edge, [1, 1]).unwrap();
    let triangles: Vec<[DVec3; 3]> = [left, right]
        .iter()
        .flat_map(|m| m.indices().iter().map(|t| t.map(|v| m.points()[v as usize])))
        .collect();
    let walls = one(Shape::Mesh(Mesh::from_triangles(&triangles).unwrap()));
    let found = touches(&walls, 0, DVec3::Z * 4e-3, 5e-3, 1e-9);
    assert_eq!(found.len(), 2);
    assert!((found[0].normal + found[1].normal - DVec3::Z * -1.6).length() < 1e-12);
}

#[test]
fn the_back_of_a_thick_wall_is_hidden() {
    let walls = one(Shape::Mesh(
        open_box(DVec3::ZERO, DVec3::new(0.02, 0.02, 1e-3), true, f64::INFINITY).unwrap(),
    ));
    // From below the floor: the sides and their upper edges lie behind it.
    let found = touches(&walls, 0, DVec3::new(0.01, 0.01, -R), R, 0.015);
    assert_eq!(found.len(), 1);
}

#[test]
fn a_step_within_the_tolerance_is_none() {
    // Two sheets side by side, the second 10 nm higher; the sphere rests on the first.
    let edge = DVec3::Y * 0.1;
    let sheet = |x, z| rectangle(DVec3::new(x, -0.05, z), DVec3::X * 0.1, edge, [3, 3]).unwrap();
    let triangles: Vec<[DVec3; 3]> = [sheet(-0.1, 0.0), sheet(0.0, 1e-8)]
        .iter()
        .flat_map(|m| m.indices().iter().map(|t| t.map(|v| m.points()[v as usize])))
        .collect();
    let mesh = Mesh::from_triangles(&triangles).unwrap();
    let count = |mesh: &Mesh| {
        let centre = DVec3::new(-2e-4, 0.0, R - 1e-4);
        touches(&one(Shape::Mesh(mesh.clone())), 0, centre, R, 0.0).len()
    };
    assert_eq!(count(&mesh), 2);
    assert_eq!(count(&mesh.clone().with_tolerance(2e-8)), 1);
    assert_eq!(count(&mesh.with_tolerance(f64::NAN)), 2);
}

#[test]
fn faces_rounded_to_single_precision_are_one_floor() {
    // A floor at an odd height, tilted, through an STL file: its vertices are off by rounding.
    let turn = DMat3::from_rotation_x(0.37) * DMat3::from_rotation_y(-0.21);
    let mesh = turned(&floor([20, 20]).shifted(DVec3::new(0.3, -0.2, 0.123)).unwrap(), turn);
    let file = tempfile::NamedTempFile::new().unwrap();
    mesh.write_stl(&mut file.as_file(), 1.0).unwrap();
    let walls = one(Shape::Mesh(Mesh::from_stl(file.path(), 1.0).unwrap()));
    let mut doubled = 0;
    for k in 0..20_000u32 {
        let at = |step: f64| 0.09 * (f64::from(k) * step).fract() - 0.045;
        let place = DVec3::new(0.3 + at(0.754877666), -0.2 + at(0.569840291), 0.123 + R - 1e-5);
        let found = touches(&walls, 0, turn * place, R, 0.0);
        doubled += usize::from(found.len() != 1);
        assert!((found[0].gap + 1e-5).abs() < 1e-7);
    }
    assert_eq!(doubled, 0);
}
