//! The sieve.

use crate::touches;
use pendular_walls::build::Fit;
use pendular_walls::glam::DVec3;
use pendular_walls::{FrameKind, Shape, Sieve, Touch, WallError, Walls, Wires};

/// a = 8 mm, w = 2 mm.
const SIEVE: Sieve = Sieve {
    aperture: 8e-3,
    wire_diameter: 2e-3,
    frame_radius: 0.1,
    frame_bottom: -0.01,
    frame_top: 0.05,
    wires: Wires::Cylinders,
    frame: FrameKind::Cylinder { patches: [12, 2] },
    element_length: 10e-3,
};

/// Touches with all parts near a sphere.
fn all(walls: &Walls, centre: DVec3, radius: f64, reach: f64) -> Vec<Touch> {
    let mut near = Vec::new();
    walls.near(centre, radius + reach, &mut near);
    near.iter().flat_map(|part| touches(walls, *part, centre, radius, reach)).collect()
}

/// The height over the axes at which a sphere rests on the wires around it.
fn rest_height(walls: &Walls, middle: DVec3, radius: f64) -> f64 {
    let (mut low, mut high) = (1e-3, 2.0 * radius);
    for _ in 0..60 {
        let height = 0.5 * (low + high);
        let free = all(walls, middle + DVec3::Z * height, radius, 0.0).is_empty();
        if free { high = height } else { low = height }
    }
    0.5 * (low + high)
}

#[test]
fn a_sphere_in_an_aperture_rests_on_four_wires() {
    // Its centre is (d + w)/2 = 6 mm from each axis, 5 mm of that sideways: sqrt(36 - 25) mm up.
    let expected = 11.0_f64.sqrt() * 1e-3;
    assert!((expected - 3.317e-3).abs() < 5e-7);
    let walls = Walls::new(SIEVE.parts().unwrap()).unwrap();
    for middle in [DVec3::ZERO, DVec3::new(0.03, -0.02, 0.0)] {
        assert!((rest_height(&walls, middle, 5e-3) - expected).abs() < 1e-15);
        let found = all(&walls, middle + DVec3::Z * expected, 5e-3, 1e-9);
        assert_eq!(found.len(), 4);
        assert!(found.iter().all(|t| t.gap.abs() < 1e-15));
        let sum: DVec3 = found.iter().map(|t| t.normal).sum();
        assert!((sum + DVec3::Z * 4.0 * expected / 6e-3).length() < 1e-12);
    }
    // A sphere of 8 mm just fits.
    assert!(all(&walls, DVec3::ZERO, 4e-3 * (1.0 - 1e-9), 0.0).is_empty());
    assert_eq!(all(&walls, DVec3::ZERO, 4e-3 * (1.0 + 1e-9), 0.0).len(), 4);
}

#[test]
fn prism_wires_converge_to_round_ones() {
    let expected = 11.0_f64.sqrt() * 1e-3;
    for fit in [Fit::Inscribed, Fit::EqualVolume, Fit::Circumscribed] {
        let error = |sides| {
            let sieve = Sieve { wires: Wires::Prisms { sides, fit }, ..SIEVE };
            let walls = Walls::new(sieve.parts().unwrap()).unwrap();
            (rest_height(&walls, DVec3::ZERO, 5e-3) - expected).abs()
        };
        // The surface is off by at most r (1/cos(π/n) - 1); the height by that over sin(slope).
        let slope = expected / 6e-3;
        for sides in [8, 16, 32, 64] {
            let half_angle = std::f64::consts::PI / f64::from(sides);
            let bound = 1e-3 * (1.0 / half_angle.cos() - 1.0) / slope;
            assert!(error(sides) < 1.05 * bound, "{fit:?} {sides}");
        }
    }
}

#[test]
fn circumscribed_prisms_leave_the_aperture_exact() {
    let wires = Wires::Prisms { sides: 8, fit: Fit::Circumscribed };
    let walls = Walls::new(Sieve { wires, ..SIEVE }.parts().unwrap()).unwrap();
    assert!(all(&walls, DVec3::ZERO, 4e-3 * (1.0 - 1e-9), 0.0).is_empty());
    assert_eq!(all(&walls, DVec3::ZERO, 4e-3 * (1.0 + 1e-9), 0.0).len(), 4);
}

#[test]
fn nothing_wider_than_the_aperture_passes() {
    // Spheres a little too large, anywhere in the plane of the axes, also along the frame.
    for frame in [SIEVE.frame, FrameKind::Prism { sides: 48, bands: 1 }] {
        for frame_radius in [0.1, 0.0501, 0.0437, 0.0957] {
            let sieve = Sieve { frame, frame_radius, ..SIEVE };
            let walls = Walls::new(sieve.parts().unwrap()).unwrap();
            for k in 0..4000u32 {
                let angle = f64::from(k) * 2.399963;
                let off = frame_radius * (f64::from(k) / 4000.0).sqrt();
                let centre = DVec3::new(off * angle.cos(), off * angle.sin(), 0.0);
                assert!(!all(&walls, centre, 4.004e-3, 0.0).is_empty(), "{centre}");
            }
        }
    }
}

#[test]
fn wires_are_parts_with_names_and_elements() {
    let parts = SIEVE.parts().unwrap();
    assert_eq!(parts.len(), 41);
    assert_eq!((parts[0].name.as_str(), parts[40].name.as_str()), ("wire-x-0", "frame"));
    for part in &parts[..40] {
        let Shape::Wire(wire) = &part.shape else { panic!("{}", part.name) };
        let [start, end] = wire.ends();
        assert_eq!((start.z, end.z, part.half_side), (0.0, 0.0, 1e-3));
        assert_eq!(wire.segments(), (start.distance(end) / 10e-3).ceil() as u32);
    }
    assert_eq!(parts[40].half_side, f64::INFINITY);
    let walls = Walls::new(parts).unwrap();
    let counted: u32 = walls.parts().iter().map(|p| p.shape.element_count()).sum();
    assert_eq!(walls.element_total(), counted);
    assert_eq!(walls.first_element(40), counted - 24);
}

#[test]
fn bad_sieves_are_refused() {
    let said = |sieve: Sieve| match sieve.parts() {
        Err(WallError::OutOfRange { quantity, .. }) => quantity,
        other => panic!("{other:?}"),
    };
    assert_eq!(said(Sieve { aperture: 0.0, ..SIEVE }), "aperture");
    assert_eq!(said(Sieve { wire_diameter: f64::NAN, ..SIEVE }), "wire diameter");
    assert_eq!(said(Sieve { frame_radius: 4e-3, ..SIEVE }), "frame radius");
    assert_eq!(said(Sieve { frame_radius: 1e4, ..SIEVE }), "frame radius");
    assert_eq!(said(Sieve { frame_top: -0.01, ..SIEVE }), "height of the frame");
    assert_eq!(said(Sieve { element_length: 0.0, ..SIEVE }), "element length");
    assert_eq!(said(Sieve { element_length: f64::NAN, ..SIEVE }), "element length");
    let wires = Wires::Prisms { sides: 2, fit: Fit::Inscribed };
    assert_eq!(said(Sieve { wires, ..SIEVE }), "number of sides");
    let frame = FrameKind::Cylinder { patches: [0, 1] };
    assert_eq!(said(Sieve { frame, ..SIEVE }), "number of patches around");
}
