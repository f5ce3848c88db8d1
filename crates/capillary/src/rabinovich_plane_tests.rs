use super::*;
use crate::Lambert2008;
use crate::checked::bridges::{plane, w11};

/// Gap m and exact Young-Laplace force N of a sphere of 2.381 mm on a plane, 162.4 nl, 20.6 mN/m,
/// θ = 0: rows of case P1 in data/young_laplace_reference.csv.
const P1: [(f64, f64); 2] = [(1.04116267426e-6, 5.646278693e-4), (1.5617440114e-4, 1.799753593e-4)];

fn p1() -> Bridge {
    plane(2.381e-3, 162.4e-12, [0.0; 2], 20.6e-3)
}

/// φ = √(2 d/rᵢ), d = −S + √(S² + V/(π rᵢ)).
fn embracing_angle(b: &Bridge, gap: f64) -> f64 {
    let d = -gap + (gap * gap + b.volume() / (PI * b.radius())).sqrt();
    (2.0 * d / b.radius()).sqrt()
}

#[test]
fn equals_the_printed_formula_and_lambert_on_a_plane() {
    let b = plane(1e-3, 2e-11, [0.2, 0.5], 0.07);
    let curve = RabinovichPlane.curve(&b, Range::Strict).unwrap();
    for gap in [1e-7, 1e-5, 1e-4] {
        let d = -gap + (gap * gap + 2e-11 / (PI * 1e-3)).sqrt();
        let sum = 0.2f64.cos() + 0.5f64.cos();
        let printed = 2.0 * PI * 0.07 * 1e-3 * sum / (1.0 + gap / d);
        assert!((curve.force(gap) / printed - 1.0).abs() < 1e-12);
    }
    assert_eq!(Ok(curve), Lambert2008.curve(&b, Range::Strict));
}

#[test]
fn a_sphere_as_mate_is_refused() {
    for range in [Range::Strict, Range::Extrapolate] {
        assert_eq!(RabinovichPlane.curve(&w11(), range).unwrap_err().quantity, "radius ratio");
        let error = RabinovichPlaneSmallGap.curve(&w11(), range).unwrap_err();
        assert_eq!(error.quantity, "radius ratio");
    }
}

#[test]
fn the_small_gap_form_is_the_tangent_at_contact() {
    let b = p1();
    let full = RabinovichPlane.curve(&b, Range::Strict).unwrap();
    let small = RabinovichPlaneSmallGap.curve(&b, Range::Strict).unwrap();
    let (contact, h) = (full.force(0.0), 1e-9);
    assert!((small.force(0.0) / contact - 1.0).abs() < 1e-14);
    let slope = (contact - full.force(h)) / (contact - small.force(h));
    assert!((slope - 1.0).abs() < 1e-4, "{slope}");
    assert_eq!(small.force(f64::MAX), 0.0 * contact);
}

#[test]
fn erratum_krull_26_has_twice_the_contact_force() {
    let (gap, exact) = P1[0];
    let b = p1();
    let root = (1.0 + b.volume() / (PI * b.radius() * gap * gap)).sqrt();
    let read = |factor: f64| factor * PI * b.radius() * 20.6e-3 / (1.0 + 1.0 / (root - 1.0));
    let ours = RabinovichPlane.force(&b, gap, Range::Strict).unwrap();
    assert!((read(4.0) / ours - 1.0).abs() < 1e-9);
    assert!((read(4.0) / exact - 1.0).abs() < 0.15 && read(8.0) / exact > 2.0);
}

#[test]
fn erratum_elskamp_15_the_second_term() {
    // As printed, sin θ sin(θ + φ), it stays when the bridge vanishes; with sin φ it goes.
    let theta = 0.6f64;
    let tiny = plane(1e-3, 1e-25, [theta; 2], 0.05);
    let phi = embracing_angle(&tiny, 0.0);
    let scale = 2.0 * PI * 1e-3 * 0.05;
    let limit = 2.0 * scale * theta.cos();
    assert!(scale * theta.sin() * (theta + phi).sin() > 0.15 * limit);
    assert!(scale * phi.sin() * (theta + phi).sin() < 1e-3 * limit);
    // Even then it counts the contact line twice: the exact force wants less, not more.
    let b = p1();
    for (gap, exact) in P1 {
        let phi = embracing_angle(&b, gap);
        let first = RabinovichPlane.force(&b, gap, Range::Strict).unwrap();
        let both = first + 2.0 * PI * 20.6e-3 * b.radius() * phi.sin() * phi.sin();
        if first > exact {
            assert!(both / exact - 1.0 > 1.5 * (first / exact - 1.0));
        }
    }
    assert!(RabinovichPlane.force(&b, P1[0].0, Range::Strict).unwrap() > P1[0].1);
}

#[test]
fn erratum_elskamp_18_the_embracing_angle_vanishes_with_the_volume() {
    let gap = 1e-5;
    let b = plane(1e-3, 1e-25, [0.0; 2], 0.05);
    let root = (1.0 + b.volume() / (PI * b.radius() * gap * gap)).sqrt();
    let printed = (2.0 * gap / b.radius() * root).sqrt();
    let right = (2.0 * gap / b.radius() * (-1.0 + root)).sqrt();
    assert!(printed > 0.1 && right < 1e-6);
    assert!((right - embracing_angle(&b, gap)).abs() < 1e-6);
}
