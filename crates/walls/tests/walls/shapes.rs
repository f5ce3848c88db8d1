//! Wires and frames.

use crate::{one, touches};
use pendular_walls::build::{Fit, Prism};
use pendular_walls::glam::DVec3;
use pendular_walls::{Frame, Shape, Touch, Wire};
use proptest::prelude::*;

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    prop::array::uniform3(-size..size).prop_map(DVec3::from_array)
}

/// The nearest touch at any distance.
fn nearest(shape: Shape, centre: DVec3, radius: f64) -> Touch {
    touches(&one(shape), 0, centre, radius, 1e3)[0]
}

proptest! {
    #[test]
    fn wires_against_parry(start in vector(1.0), end in vector(1.0), centre in vector(2.0)) {
        use parry3d::math::{Pose, Rotation};
        use parry3d::query::PointQuery;
        prop_assume!(start.distance(end) > 1e-3);
        let wire = Wire::new(start, end, 0.3, 4).unwrap();
        let touch = nearest(Shape::Wire(wire), centre, 0.1);
        // parry's cylinder stands along y.
        let other = parry3d::shape::Cylinder::new(0.5 * start.distance(end), 0.3);
        let turn = Rotation::from_rotation_arc(DVec3::Y, (end - start).normalize());
        let pose = Pose::from_parts(0.5 * (start + end), turn);
        let distance = other.distance_to_point(&pose, centre, false);
        prop_assert!((touch.gap + 0.1 - distance).abs() < 1e-12);
        prop_assert!((touch.normal.length() - 1.0).abs() < 1e-12);
        // The end of the normal is on the surface.
        let foot = centre + touch.normal * (touch.gap + 0.1);
        prop_assert!(other.distance_to_point(&pose, foot, false).abs() < 1e-12);
    }

    #[test]
    fn frames_against_points_of_their_surface(
        start in vector(1.0), end in vector(1.0), centre in vector(2.0),
        angle in 0.0..6.3, share in 0.0..1.0,
    ) {
        prop_assume!(start.distance(end) > 1e-3);
        let frame = Frame::new(start, end, 0.8, [8, 3]).unwrap();
        let touch = nearest(Shape::Frame(frame), centre, 0.1);
        // No point of the surface is nearer, and the end of the normal is one of them.
        let axis = (end - start).normalize();
        let u = axis.any_orthonormal_vector();
        let out = u * f64::cos(angle) + axis.cross(u) * f64::sin(angle);
        let other = start.lerp(end, share) + out * 0.8;
        prop_assert!(touch.gap + 0.1 <= centre.distance(other) + 1e-12);
        let foot = centre + touch.normal * (touch.gap + 0.1) - start;
        let along = foot.dot(axis);
        prop_assert!(along > -1e-12 && along < start.distance(end) + 1e-12);
        prop_assert!(((foot - axis * along).length() - 0.8).abs() < 1e-12);
    }

    #[test]
    fn prisms_stand_for_wires_as_well_as_their_polygon(
        angle in 0.0..6.3, along in -0.019..0.019, gap in -2e-5..1e-3, power in 3u32..7,
    ) {
        let (r, sides) = (1e-3, 1 << power);
        let ends = [DVec3::X * -0.02, DVec3::X * 0.02];
        let (sin, cos) = f64::sin_cos(angle);
        let centre = DVec3::new(along, sin * (r + 4e-3 + gap), cos * (r + 4e-3 + gap));
        // Sagitta of the polygon against the circle through its corners.
        let half_angle = std::f64::consts::PI / f64::from(sides);
        for (fit, least, most) in [
            (Fit::Inscribed, 0.0, r * (1.0 - half_angle.cos())),
            (Fit::Circumscribed, r - r / half_angle.cos(), 0.0),
            (Fit::EqualVolume, r - r / half_angle.cos(), r * (1.0 - half_angle.cos())),
        ] {
            let up = DVec3::Z;
            let prism = Prism { ends, up, radius: r, sides, fit, segments: 3, closed: true };
            let walls = one(Shape::Mesh(prism.mesh().unwrap()));
            let found = touches(&walls, 0, centre, 4e-3, 1.5e-3);
            prop_assert_eq!(found.len(), 1, "{:?}", found);
            let error = found[0].gap - gap;
            prop_assert!(error > least - 1e-15 && error < most + 1e-15, "{fit:?} {error}");
            let outward = DVec3::new(0.0, sin, cos);
            prop_assert!((found[0].normal + outward).length() < 1.01 * half_angle);
        }
    }
}

#[test]
fn a_wire_from_all_sides() {
    let wire = Wire::new(DVec3::ZERO, DVec3::Z * 4.0, 1.0, 4).unwrap();
    let at = |x, y, z| nearest(Shape::Wire(wire), DVec3::new(x, y, z), 0.5);
    assert_eq!(at(3.0, 0.0, 2.5), Touch { element: 2, gap: 1.5, normal: -DVec3::X });
    // Past an end, before the flat face.
    assert_eq!(at(0.2, 0.3, 5.0), Touch { element: 3, gap: 0.5, normal: -DVec3::Z });
    assert_eq!(at(0.2, 0.3, -1.0), Touch { element: 0, gap: 0.5, normal: DVec3::Z });
    // Past the rim by 3 and 4.
    let rim = at(4.0, 0.0, 8.0);
    assert_eq!((rim.element, rim.gap), (3, 4.5));
    assert!((rim.normal - DVec3::new(-0.6, 0.0, -0.8)).length() < 1e-15);
    // In the wire: pushed out sideways, or out of the end where that is nearer.
    assert_eq!(at(0.0, 0.75, 2.0), Touch { element: 2, gap: -0.75, normal: -DVec3::Y });
    assert_eq!(at(0.0, 0.5, 3.75), Touch { element: 3, gap: -0.75, normal: -DVec3::Z });
    let on_axis = at(0.0, 0.0, 2.0);
    assert!(on_axis.gap == -1.5 && on_axis.normal.is_normalized());
}

#[test]
fn a_frame_from_inside() {
    let frame = Frame::new(DVec3::ZERO, DVec3::Z * 4.0, 10.0, [4, 2]).unwrap();
    let at = |x, y, z| nearest(Shape::Frame(frame), DVec3::new(x, y, z), 0.5);
    let touch = at(9.0, 0.0, 1.0);
    assert_eq!((touch.gap, touch.normal), (0.5, DVec3::X));
    assert_eq!(at(0.0, -9.75, 3.0).gap, -0.25);
    // From outside, and past the upper rim by 3 and 4.
    assert_eq!(at(0.0, 11.0, 1.0).normal, -DVec3::Y);
    let rim = at(7.0, 0.0, 8.0);
    assert_eq!(rim.gap, 4.5);
    assert!((rim.normal - DVec3::new(0.6, 0.0, -0.8)).length() < 1e-15);
    // Four quarters in two rows, each element met, the lower row first.
    let mut met = [0; 8];
    for k in 0..40 {
        let (sin, cos) = (f64::from(k) * 0.157 + 0.01).sin_cos();
        for (row, z) in [(0, 1.0), (1, 3.0)] {
            let element = at(9.0 * cos, 9.0 * sin, z).element;
            assert_eq!(element / 4, row);
            met[element as usize] += 1;
        }
    }
    assert_eq!(met, [10; 8]);
}

#[test]
fn elements_carry_the_whole_area() {
    use std::f64::consts::TAU;
    let total = |shape: &Shape| -> f64 {
        (0..shape.element_count()).map(|k| shape.element_area(k).unwrap()).sum()
    };
    let ends = [DVec3::ZERO, DVec3::new(3.0, 4.0, 0.0)];
    let wire = Shape::Wire(Wire::new(ends[0], ends[1], 0.5, 7).unwrap());
    assert!((total(&wire) - TAU * 0.5 * 5.0).abs() < 1e-12);
    assert_eq!(wire.element_area(7), None);
    let frame = Shape::Frame(Frame::new(ends[0], ends[1], 2.0, [6, 5]).unwrap());
    assert!((total(&frame) - TAU * 2.0 * 5.0).abs() < 1e-12);
    let prism = Prism {
        ends,
        up: DVec3::Z,
        radius: 1.0,
        sides: 4,
        fit: Fit::Inscribed,
        segments: 3,
        closed: true,
    };
    let mesh = Shape::Mesh(prism.mesh().unwrap());
    // Four faces of width sqrt 2, two square ends.
    assert!((total(&mesh) - (4.0 * 2.0_f64.sqrt() * 5.0 + 4.0)).abs() < 1e-12);
}

#[test]
fn drawings_cover_their_elements() {
    let wire = Shape::Wire(Wire::new(DVec3::ZERO, DVec3::Z, 0.1, 5).unwrap());
    let frame = Shape::Frame(Frame::new(DVec3::ZERO, DVec3::Z, 0.1, [6, 5]).unwrap());
    for shape in [wire, frame] {
        let drawing = shape.tessellation(96);
        assert_eq!(drawing.elements.len(), drawing.triangles.len());
        let mut area = vec![0.0; shape.element_count() as usize];
        for (corners, element) in drawing.triangles.iter().zip(&drawing.elements) {
            let [a, b, c] = corners.map(|v| drawing.points[v as usize]);
            let axial = a.z == b.z && b.z == c.z;
            if !axial {
                area[*element as usize] += 0.5 * (b - a).cross(c - a).length();
            }
            // The touch at the middle of the triangle is with the same element.
            let middle = (a + b + c) / 3.0;
            if !axial {
                assert_eq!(nearest(shape.clone(), middle * 1.0, 0.01).element, *element);
            }
        }
        for (k, drawn) in area.iter().enumerate() {
            let exact = shape.element_area(k as u32).unwrap();
            assert!((drawn / exact - 1.0).abs() < 1e-3, "{drawn} {exact}");
        }
    }
}
