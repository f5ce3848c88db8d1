//! The elastic-plastic law against the equations of Krull, Strohner & Antonyuk (2025).
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use pendular_contact::{ElasticPlastic, NormalContact, PlasticMemory};
use proptest::prelude::*;

const MODULUS: f64 = 2.5e9 / 0.96;
const RADIUS: f64 = 1e-4;
const PRESSURE: f64 = 27e6;

fn lactose() -> ElasticPlastic {
    ElasticPlastic::new(MODULUS, RADIUS, PRESSURE).unwrap()
}

/// κ of eq. (11).
fn kappa(s: f64) -> f64 {
    1.0 - (lactose().yield_overlap() / s).cbrt() / 3.0
}

/// Composite Simpson of `f` over `range`.
fn integral(f: impl Fn(f64) -> f64, range: (f64, f64)) -> f64 {
    let panels = 20_000;
    let h = (range.1 - range.0) / f64::from(panels);
    let weight = |k: i32| if k == 0 || k == panels { 1.0 } else { 2.0 + 2.0 * f64::from(k % 2) };
    (0..=panels).map(|k| weight(k) * f(range.0 + h * f64::from(k))).sum::<f64>() * h / 3.0
}

#[test]
fn yield_where_the_pressure_in_the_centre_is_the_yield_pressure() {
    let law = lactose();
    let s_y = law.yield_overlap();
    // (4): p_max = 2 E* a/(π R*), a² = R* s
    let pressure = 2.0 * MODULUS * (RADIUS * s_y).sqrt() / (PI * RADIUS);
    assert!((pressure / PRESSURE - 1.0).abs() < 1e-12);
    // (9), (10)
    let force = PI.powi(3) / 6.0 * PRESSURE.powi(3) * RADIUS.powi(2) / MODULUS.powi(2);
    let overlap = PI.powi(2) / 4.0 * PRESSURE.powi(2) * RADIUS / MODULUS.powi(2);
    assert!((law.yield_force() / force - 1.0).abs() < 1e-12);
    assert!((law.loading_force(s_y) / force - 1.0).abs() < 1e-12);
    assert!((s_y / overlap - 1.0).abs() < 1e-12);
}

#[test]
fn loading_follows_the_equations_and_is_smooth_at_yield() {
    let law = lactose();
    let s_y = law.yield_overlap();
    for s in [1.001 * s_y, 3.0 * s_y, 1e-6, 1e-5] {
        let k = kappa(s);
        let printed =
            ((2.0 - 2.0 * k) + (3.0 * k - 2.0)) * (3.0 * k - 1.0) * PI * RADIUS * s * PRESSURE;
        assert!((law.loading_force(s) / printed - 1.0).abs() < 1e-12);
    }
    let (below, above) =
        (law.loading_force(s_y * (1.0 - 1e-9)), law.loading_force(s_y * (1.0 + 1e-9)));
    assert!((above / below - 1.0 - 3e-9).abs() < 1e-9); // F ~ s^1.5 on both sides
    // (13) is the limit, from below
    let share = |s: f64| law.loading_force(s) / law.plastic_force(s);
    assert!((share(s_y) - 1.0 / 3.0).abs() < 1e-12);
    assert!(share(1e9 * s_y) < 1.0 && share(1e9 * s_y) > 0.998);
    assert!((law.plastic_force(1e-6) - 2.0 * PI * RADIUS * 1e-6 * PRESSURE).abs() < 1e-15);
}

#[test]
fn energies_are_the_integrals() {
    let law = lactose();
    let s_y = law.yield_overlap();
    for s in [0.7 * s_y, 2.0 * s_y, 40.0 * s_y] {
        let below = integral(|s| law.loading_force(s), (0.0, s.min(s_y)));
        let work = below + integral(|s| law.loading_force(s), (s.min(s_y), s));
        assert!((law.loading_work(s) / work - 1.0).abs() < 1e-7);
        // the elastic part (2 − 2κ) of (12)
        let part =
            |s: f64| (2.0 - 2.0 * kappa(s)) * (3.0 * kappa(s) - 1.0) * PI * RADIUS * s * PRESSURE;
        let elastic = below + if s > s_y { integral(part, (s_y, s)) } else { 0.0 };
        assert!((law.elastic_energy(s) / elastic - 1.0).abs() < 1e-7);
    }
}

#[test]
fn permanent_deformation_is_eq_18() {
    let law = lactose();
    let (s_y, f_y) = (law.yield_overlap(), law.yield_force());
    for s in [1.5 * s_y, 1e-6, 4e-6] {
        let root = (s_y / s).cbrt();
        let bracket = s * s * root * (5.0 * root - 8.0) + 3.0 * s_y * s_y;
        let force = law.loading_force(s);
        let printed = s - f_y * s_y / force + 0.25 * PI * PRESSURE * RADIUS * bracket / force;
        assert!((law.plastic_overlap(s) / printed - 1.0).abs() < 1e-9);
    }
    assert_eq!(law.plastic_overlap(s_y), 0.0);
    assert!(law.plastic_overlap(1e3 * s_y) > 0.7e3 * s_y);
}

#[test]
fn unloading_starts_where_loading_ended_and_gives_back_the_elastic_energy() {
    let law = lactose();
    let mut memory = PlasticMemory::default();
    let top = law.force(1e-6, 0.0, &mut memory);
    assert!((law.force(1e-6 * (1.0 - 1e-10), 0.0, &mut memory) / top - 1.0).abs() < 1e-8);
    let s_pl = memory.plastic_overlap;
    let unload = |s: f64| law.force(s, 0.0, &mut memory.clone());
    let back = integral(unload, (s_pl, 1e-6 * (1.0 - 1e-15)));
    assert!((back / law.elastic_energy(1e-6) - 1.0).abs() < 1e-5);
    assert_eq!(unload(s_pl), 0.0);
    // reloading runs up the same curve and goes on as a first loading
    let middle = unload(0.5 * (s_pl + 1e-6));
    let mut again = memory;
    law.force(0.0, 0.0, &mut again);
    assert_eq!(law.force(0.5 * (s_pl + 1e-6), 0.0, &mut again), middle);
    assert_eq!(again, memory);
    assert_eq!(law.force(2e-6, 0.0, &mut again), law.loading_force(2e-6));
}

#[test]
fn stiffness_is_the_steeper_of_loading_and_unloading() {
    let law = lactose();
    for s in [0.5, 0.999, 1.001, 3.0, 100.0].map(|x| x * law.yield_overlap()) {
        let h = 1e-6 * s;
        let loading = (law.loading_force(s + h) - law.loading_force(s)) / h;
        let mut memory = PlasticMemory::default();
        let top = law.force(s, 0.0, &mut memory);
        let unloading = (top - law.force(s - h, 0.0, &mut memory)) / h;
        assert!(law.stiffness(s) > loading * (1.0 - 1e-5));
        assert!((law.stiffness(s) / unloading - 1.0).abs() < 1e-4);
    }
}

#[test]
fn tangential_stiffness_takes_the_contact_radius() {
    // 8 G* a = ratio · 2 E* a; area (3 κ − 1) π R* s of (12), 2 π R* s when fully plastic (13)
    let law = lactose().with_tangential_ratio(0.9).unwrap();
    let radius = |s: f64| law.tangential_stiffness(s) / (0.9 * 2.0 * MODULUS);
    let elastic = 0.5 * law.yield_overlap();
    assert!((radius(elastic).powi(2) / (RADIUS * elastic) - 1.0).abs() < 1e-12);
    let area = (3.0 * kappa(1e-6) - 1.0) * RADIUS * 1e-6;
    assert!((radius(1e-6).powi(2) / area - 1.0).abs() < 1e-12);
    assert!((radius(10.0).powi(2) / (2.0 * RADIUS * 10.0) - 1.0).abs() < 1e-2);
}

proptest! {
    /// Any path of the overlap: a closed one costs exactly the plastic work of its deepest point.
    #[test]
    fn no_history_creates_energy(path in prop::collection::vec(0.0..60.0_f64, 1..12)) {
        let law = lactose();
        let s_y = law.yield_overlap();
        let mut memory = PlasticMemory::default();
        let (mut at, mut force, mut work) = (0.0, 0.0, 0.0);
        let deepest = path.iter().copied().fold(0.0, f64::max) * s_y;
        let scale = law.loading_work(deepest);
        for target in path.iter().map(|x| x * s_y).chain([0.0]) {
            let (start, steps) = (at, 4000);
            for k in 1..=steps {
                let next = start + (target - start) * f64::from(k) / f64::from(steps);
                let now = law.force(next, 0.0, &mut memory);
                prop_assert!(now >= 0.0 && now.is_finite());
                work += 0.5 * (force + now) * (next - at);
                (at, force) = (next, now);
                // what the path has cost is at least what the contact holds
                prop_assert!(work >= law.stored_energy(at, &memory) - 1e-5 * scale);
            }
        }
        let spent = law.loading_work(deepest) - law.elastic_energy(deepest);
        prop_assert!((work - spent).abs() <= 1e-5 * scale, "{work} {spent} {scale}");
    }
}
