use super::*;
use crate::checked::bridges::{spheres, w11};

/// How a source prints the law; the corrected reading is `RIGHT`.
#[derive(Clone, Copy)]
struct Reading {
    /// Share of the gap in R₁: 0.5, or 1 as Elskamp (24) and Gladkyy (A6) print.
    share: f64,
    /// Sign of 1/R₂: −1, or +1 as Gladkyy (A5) prints.
    sign: f64,
    /// Whether the line term has sin θ for sin β, as Elskamp (22) prints.
    sin_theta: bool,
    /// Power of 2R in sin⁴β: 3, or 2 as Elskamp (23) prints.
    power: i32,
}

const RIGHT: Reading = Reading { share: 0.5, sign: -1.0, sin_theta: false, power: 3 };

/// The law as printed, by trigonometry and without rearrangement.
fn read(b: &Bridge, gap: f64, how: Reading) -> f64 {
    let (r, theta, sigma) = (b.harmonic_radius(), b.mean_contact_angle(), b.surface_tension());
    let base = 0.12 * (2.0 * r).powi(how.power);
    let sin4 = b.volume() / (base * (1.0 + 6.0 * gap / (2.0 * r)) * (1.0 + 1.1 * theta.sin()));
    let beta = sin4.powf(0.25).asin();
    let r1 = (r * (1.0 - beta.cos()) + how.share * gap) / (beta + theta).cos();
    let r2 = r * beta.sin() + r1 * ((beta + theta).sin() - 1.0);
    let p = sigma * (1.0 / r1 + how.sign / r2);
    let first = if how.sin_theta { theta.sin() } else { beta.sin() };
    0.25 * PI * (2.0 * r).powi(2) * beta.sin().powi(2) * p
        + 2.0 * PI * sigma * r * first * (beta + theta).sin()
}

#[test]
fn equals_the_corrected_formula() {
    for b in [w11(), spheres(1e-3, 2e-3, 3e-12, [0.2, 0.6], 0.07)] {
        let curve = Weigert1999.curve(&b, Range::Strict).unwrap();
        for gap in [0.0, 1e-7, 1e-5, 1e-4] {
            assert!((curve.force(gap) / read(&b, gap, RIGHT) - 1.0).abs() < 1e-11);
        }
    }
}

#[test]
fn contact_limit_of_a_small_bridge() {
    let b = spheres(1e-3, 1e-3, 1e-23, [0.5; 2], 0.07);
    let force = Weigert1999.force(&b, 0.0, Range::Extrapolate).unwrap();
    let limit = 2.0 * PI * 1e-3 * 0.07 * 0.5f64.cos();
    assert!((force / limit - 1.0).abs() < 5e-3, "{}", force / limit);
}

#[test]
fn erratum_elskamp_22_the_line_term_vanishes_with_the_bridge() {
    // V → 0 at contact: the exact bridge gives 2 π R σ cos θ.
    let b = spheres(1e-3, 1e-3, 1e-25, [0.6; 2], 0.05);
    let limit = 2.0 * PI * 1e-3 * 0.05 * 0.6f64.cos();
    assert!((read(&b, 0.0, RIGHT) / limit - 1.0).abs() < 5e-3);
    assert!(read(&b, 0.0, Reading { sin_theta: true, ..RIGHT }) / limit > 1.3);
}

#[test]
fn erratum_elskamp_23_lengths_scale_only_with_the_cube() {
    // Twice all lengths: a static force doubles.
    let small = spheres(1e-3, 1e-3, 1e-12, [0.3; 2], 0.05);
    let large = spheres(2e-3, 2e-3, 8e-12, [0.3; 2], 0.05);
    let ratio = |how| read(&large, 2e-5, how) / read(&small, 1e-5, how);
    assert!((ratio(RIGHT) - 2.0).abs() < 1e-9);
    assert!((ratio(Reading { power: 2, ..RIGHT }) - 2.0).abs() > 1e-2);
}

#[test]
fn erratum_elskamp_24_and_gladkyy_a6_half_the_gap() {
    // Exact Young-Laplace forces of W11; 2.36267794382e-4 m is 0.98 of the rupture gap.
    let full = Reading { share: 1.0, ..RIGHT };
    let near = (1.20544793052e-5, 2.369751645e-4);
    let error = |how| read(&w11(), near.0, how) / near.1 - 1.0;
    assert!(error(RIGHT).abs() < 0.02 && error(full) < -0.08, "{} {}", error(RIGHT), error(full));
    // The whole gap turns the attraction into repulsion before rupture.
    assert!(read(&w11(), 2.36267794382e-4, RIGHT) > 0.0);
    assert!(read(&w11(), 2.36267794382e-4, full) < 0.0);
}

#[test]
fn erratum_gladkyy_a5_the_curvatures_have_opposite_signs() {
    let (gap, exact) = (4.82179172208e-7, 2.863996349e-4);
    let error = |how| read(&w11(), gap, how) / exact - 1.0;
    assert!(error(RIGHT).abs() < 0.03);
    assert!(error(Reading { sign: 1.0, ..RIGHT }) > 0.15);
}

#[test]
fn where_the_formula_has_no_value() {
    let quantity = |v: f64, theta: f64| {
        let b = spheres(1.0, 1.0, v, [theta; 2], 1.0);
        Weigert1999.curve(&b, Range::Extrapolate).map_err(|e| e.quantity)
    };
    assert_eq!(quantity(1.0, 0.0), Err("sin^4 of the half filling angle"));
    assert_eq!(quantity(0.5, 1.0), Err("half filling angle plus contact angle"));
    assert!(quantity(0.5, 0.3).is_ok());
}

#[test]
fn finite_through_the_pole() {
    let curve = Weigert1999.curve(&w11(), Range::Strict).unwrap();
    let contact = curve.force(0.0);
    for k in 0..20_000 {
        let force = curve.force(f64::from(k) * 1e-7);
        assert!(force.is_finite() && force.abs() <= contact * (1.0 + 1e-12));
    }
    assert_eq!(curve.force(f64::MAX), 0.0);
}
