//! What is refused.

use pendular_walls::build::{Fit, Prism, open_box, plate, rectangle};
use pendular_walls::glam::DVec3;
use pendular_walls::{Frame, Harmonic, Mesh, Motion, Part, Plane, Shape, WallError, Walls, Wire};

const O: DVec3 = DVec3::ZERO;

/// What was out of range.
fn quantity<T: std::fmt::Debug>(result: Result<T, WallError>) -> &'static str {
    match result {
        Err(WallError::OutOfRange { quantity, .. }) => quantity,
        other => panic!("{other:?}"),
    }
}

#[test]
fn meshes() {
    let points = vec![O, DVec3::X, DVec3::Y, DVec3::X * 2.0];
    let mesh = |indices: Vec<[u32; 3]>| Mesh::new(points.clone(), indices);
    assert!(matches!(mesh(vec![]), Err(WallError::Empty { .. })));
    let missing = mesh(vec![[0, 1, 2], [0, 1, 4]]);
    assert!(matches!(missing, Err(WallError::NoVertex { triangle: 1, vertex: 4, count: 4 })));
    let flat = mesh(vec![[0, 1, 2], [1, 2, 3], [0, 1, 3]]);
    assert!(matches!(flat, Err(WallError::Degenerate { triangle: 2, .. })));
    assert!(matches!(mesh(vec![[0, 1, 1]]), Err(WallError::Degenerate { triangle: 0, .. })));
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        let found = Mesh::from_triangles(&[[O, DVec3::X, DVec3::Y], [O, DVec3::X, DVec3::Y * bad]]);
        assert!(matches!(found, Err(WallError::NotFinite { triangle: 1, .. })), "{bad}");
    }
    assert!(Mesh::from_triangles(&[]).is_err());
}

#[test]
fn shapes() {
    assert_eq!(quantity(Plane::new(O, O, 1.0)), "length of the normal");
    assert_eq!(quantity(Plane::new(DVec3::NAN, DVec3::X, 1.0)), "point");
    assert_eq!(quantity(Plane::new(O, DVec3::X, 0.0)), "area");
    assert_eq!(quantity(Wire::new(O, O, 1.0, 1)), "length");
    assert_eq!(quantity(Wire::new(O, DVec3::X, -1.0, 1)), "radius");
    assert_eq!(quantity(Wire::new(O, DVec3::X, 1.0, 0)), "number of segments");
    assert_eq!(quantity(Wire::new(O, DVec3::INFINITY, 1.0, 1)), "end");
    assert_eq!(quantity(Frame::new(O, DVec3::X, f64::NAN, [1, 1])), "radius");
    assert_eq!(quantity(Frame::new(O, DVec3::X, 1.0, [1, 0])), "number of patches along");
    assert_eq!(quantity(Frame::new(O, DVec3::X, 1.0, [1 << 20, 1 << 20])), "number of patches");
}

#[test]
fn simple_meshes() {
    assert_eq!(quantity(rectangle(O, DVec3::X, DVec3::Y, [0, 1])), "number of pieces");
    let huge = rectangle(O, DVec3::X, DVec3::Y, [100_000, 100_000]);
    assert_eq!(quantity(huge), "number of all pieces");
    let parallel = rectangle(O, DVec3::X, DVec3::X * 2.0, [1, 1]);
    assert!(matches!(parallel, Err(WallError::Degenerate { .. })));
    assert_eq!(quantity(plate(O, 1.0, 0.0, 0.1, [1, 1])), "width");
    assert!(plate(O, 1.0, 1.0, f64::NAN, [1, 1]).is_err());
    assert_eq!(quantity(open_box(DVec3::ONE, O, true, 1.0)), "edge");
    assert_eq!(quantity(open_box(O, DVec3::ONE, true, 1e-9)), "element length");
    let prism = Prism {
        ends: [O, DVec3::X],
        up: DVec3::Z,
        radius: 1.0,
        sides: 6,
        fit: Fit::Inscribed,
        segments: 1,
        closed: true,
    };
    assert_eq!(quantity(Prism { sides: 2, ..prism }.mesh()), "number of sides");
    assert_eq!(quantity(Prism { ends: [O, O], ..prism }.mesh()), "length");
    let along = Prism { up: DVec3::X, ..prism }.mesh();
    assert_eq!(quantity(along), "part of `up` across the axis");
    assert_eq!(quantity(Prism { up: O, ..prism }.mesh()), "part of `up` across the axis");
}

#[test]
fn parts() {
    let plane = || Shape::Plane(Plane::new(O, DVec3::Z, 1.0).unwrap());
    let walls = |part: Part| Walls::new(vec![part]);
    let twice = Walls::new(vec![Part::new("lid", plane()), Part::new("lid", plane())]);
    let error = twice.unwrap_err();
    assert!(matches!(&error, WallError::DuplicateName { name } if name == "lid"));
    assert!(error.to_string().contains("lid"));
    let part = || Part::new("floor", plane());
    assert_eq!(quantity(walls(part().with_half_side(0.0))), "half side");
    assert_eq!(quantity(walls(part().until(f64::NAN))), "time of removal");
    let term = Harmonic { amplitude: DVec3::NAN, frequency: 1.0, phase: 0.0 };
    let shaken = walls(part().with_motion(Motion::harmonic(term)));
    assert!(shaken.as_ref().unwrap_err().to_string().contains("floor"));
    assert_eq!(quantity(shaken), "amplitude");
    assert_eq!(quantity(walls(part().with_motion(Motion::STILL.with_ramp(-1.0)))), "ramp duration");
    assert_eq!(Walls::new(vec![]).unwrap().element_total(), 0);
}

#[test]
fn queries_of_nonsense_find_nothing() {
    let wire = Wire::new(O, DVec3::X, 0.1, 1).unwrap();
    let mesh = open_box(O, DVec3::ONE, true, 0.5).unwrap();
    let plane = Plane::new(O, DVec3::Z, 1.0).unwrap();
    let parts = [Shape::Wire(wire), Shape::Mesh(mesh), Shape::Plane(plane)];
    let parts = parts.into_iter().enumerate().map(|(k, s)| Part::new(k.to_string(), s)).collect();
    let mut walls = Walls::new(parts).unwrap();
    let (mut near, mut out) = (vec![7], Vec::new());
    walls.near(DVec3::NAN, 1.0, &mut near);
    assert!(near.is_empty());
    for part in 0..3 {
        walls.touches(part, &[], DVec3::NAN, 1.0, 1.0, &mut out);
        assert!(out.is_empty());
    }
    walls.move_to(f64::NAN, 0.0);
    walls.near(DVec3::ZERO, 1.0, &mut near);
    assert!(near.is_empty());
}
