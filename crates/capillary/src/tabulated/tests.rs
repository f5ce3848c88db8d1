use std::f64::consts::FRAC_PI_3;

use pendular_pair::{Bridge, Mate, Range};

use super::{Tabulated, rupture_distance, transfer_ratio};
use crate::young_laplace::ExactBridge;
use crate::{CapillaryLaw, ForceCurve};

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn mate(&mut self) -> Mate {
        let size = self.next();
        match self.next() {
            k if k < 0.2 => Mate::PLANE,
            k if k < 0.4 => Mate::Sphere { radius: 1.0 },
            k if k < 0.6 => Mate::Sphere { radius: 1.0 - 0.05 * size.powi(3) },
            _ => Mate::Sphere { radius: 100.0_f64.powf(2.0 * size - 1.0) },
        }
    }
}

fn bridge(mate: Mate, v_star: f64, angles: [f64; 2]) -> Bridge {
    let scale = Bridge::new(1.0, mate, 1.0, angles, 1.0).unwrap().harmonic_radius();
    Bridge::new(1.0, mate, v_star * scale.powi(3), angles, 1.0).unwrap()
}

/// Errors of the force, of S_rup and of the share on one bridge; forces up to 0.98 S_rup.
fn errors(bridge: &Bridge) -> ([f64; 9], f64, f64) {
    let exact = ExactBridge::new(bridge).unwrap();
    let curve = Tabulated.curve(bridge, Range::Strict).unwrap();
    let end = exact.rupture();
    let force = [0, 1, 2, 3, 4, 5, 6, 7, 8].map(|k| {
        let gap = 0.98 * f64::from(k) / 8.0 * end.distance;
        (curve.force(gap) / exact.force(gap).unwrap() - 1.0).abs()
    });
    let rupture = (rupture_distance(bridge).unwrap() / end.distance - 1.0).abs();
    (force, rupture, (transfer_ratio(bridge).unwrap() - end.share).abs())
}

/// The error that `part` of all errors do not exceed, and the largest.
fn quantile(errors: &mut [f64], part: f64) -> (f64, f64) {
    errors.sort_by(f64::total_cmp);
    (errors[(part * errors.len() as f64) as usize], errors[errors.len() - 1])
}

#[test]
fn equal_angles_against_the_exact_bridge() {
    let mut random = Random(4_711);
    let mut all = Vec::new();
    for _ in 0..400 {
        let (theta, v_star) = (FRAC_PI_3 * random.next(), 1e-6 * 0.5e6_f64.powf(random.next()));
        let bridge = bridge(random.mate(), v_star, [theta; 2]);
        let (force, rupture, share) = errors(&bridge);
        assert!(rupture < 1e-3, "{bridge:?}: {rupture}");
        assert!(share < 5e-3, "{bridge:?}: {share}");
        all.extend(force);
    }
    let (median, worst) = quantile(&mut all, 0.5);
    assert!(median < 5e-5 && worst < 1e-3, "{median} {worst}");
}

#[test]
fn unequal_angles_against_the_exact_bridge() {
    let mut random = Random(815);
    let mut all = Vec::new();
    for k in 0..12 {
        let mut angles = [FRAC_PI_3 * random.next(), FRAC_PI_3 * random.next()];
        let mut mate = random.mate();
        match k {
            // glass on steel and POM on steel, whose necks jump, and nearly equal angles
            0 => (angles, mate) = ([15.0, 45.0].map(f64::to_radians), Mate::PLANE),
            1 => (angles, mate) = ([40.0, 45.0].map(f64::to_radians), Mate::PLANE),
            2 => (angles, mate) = ([50.0, 50.1].map(f64::to_radians), Mate::Sphere { radius: 1.0 }),
            _ => {}
        }
        for _ in 0..25 {
            let v_star = 1e-6 * 0.5e6_f64.powf(random.next());
            let bridge = bridge(mate, v_star, angles);
            let (force, rupture, share) = errors(&bridge);
            assert!(rupture < 1e-3, "{bridge:?}: {rupture}");
            assert!(share < 5e-3, "{bridge:?}: {share}");
            all.extend(force);
        }
    }
    let (most, worst) = quantile(&mut all, 0.95);
    assert!(most < 2e-4 && worst < 2e-3, "{most} {worst}");
}

#[test]
fn smaller_bridges_are_folded_by_the_exact_solver() {
    let mut random = Random(31);
    for _ in 0..60 {
        let v_star = 1e-9 * 1e3_f64.powf(random.next());
        let angles = [FRAC_PI_3 * random.next(), FRAC_PI_3 * random.next()];
        let (force, rupture, share) = errors(&bridge(random.mate(), v_star, angles));
        let worst = force.into_iter().fold(0.0, f64::max);
        assert!(worst < 2e-3 && rupture < 1e-7 && share < 1e-6, "{worst} {v_star} {angles:?}");
    }
}

#[test]
fn the_force_is_finite_nowhere_negative_and_without_a_step() {
    let mut random = Random(99);
    for k in 0..120 {
        let theta = FRAC_PI_3 * random.next();
        let bridge = bridge(random.mate(), 1e-6 * 0.5e6_f64.powf(random.next()), [theta; 2]);
        let curve = Tabulated.curve(&bridge, Range::Strict).unwrap();
        let end = rupture_distance(&bridge).unwrap();
        assert_eq!(curve.force(-1.0), curve.force(0.0));
        for gap in [0.0, 0.3, 0.97, 1.0, 1.3, 10.0, 1e9, 1e300, f64::INFINITY] {
            let force = curve.force(gap * end);
            assert!(force.is_finite() && force >= 0.0, "{bridge:?} {gap}: {force}");
        }
        let step = curve.force(end * (1.0 - 1e-9)) / curve.force(end * (1.0 + 1e-9)) - 1.0;
        assert!(step.abs() < 1e-2, "{k} {step}");
    }
}

#[test]
fn both_bodies_see_the_same_bridge() {
    for angles in [[0.3, 0.3], [0.1, 0.9]] {
        for radius in [1.0, 4.0, 0.2] {
            let one = bridge(Mate::Sphere { radius }, 1e-2, angles);
            let other = one.swapped().unwrap();
            let gap = 0.02;
            let force = |b: &Bridge| Tabulated.force(b, gap, Range::Strict).unwrap();
            assert!((force(&one) / force(&other) - 1.0).abs() < 1e-12);
            let shares = transfer_ratio(&one).unwrap() + transfer_ratio(&other).unwrap();
            assert!((shares - 1.0).abs() < 1e-12);
            let (a, b) = (rupture_distance(&one).unwrap(), rupture_distance(&other).unwrap());
            assert!((a / b - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn forces_scale_with_surface_tension_and_size() {
    let mate = Mate::Sphere { radius: 2e-3 };
    let one = Bridge::new(1e-3, mate, 1e-11, [0.4; 2], 0.07).unwrap();
    let mate = Mate::Sphere { radius: 2.0 };
    let large = Bridge::new(1.0, mate, 1e-2, [0.4; 2], 0.21).unwrap();
    let small = Tabulated.force(&one, 1e-4, Range::Strict).unwrap();
    let grown = Tabulated.force(&large, 0.1, Range::Strict).unwrap();
    assert!((grown / (3000.0 * small) - 1.0).abs() < 1e-12);
}

#[test]
fn outside_the_range_strict_refuses_and_extrapolate_solves() {
    let sphere = Mate::Sphere { radius: 1.0 };
    let steep = bridge(sphere, 1e-2, [1.3, 1.2]);
    assert!(Tabulated.curve(&steep, Range::Strict).is_err());
    let curve = Tabulated.curve(&steep, Range::Extrapolate).unwrap();
    let exact = ExactBridge::new(&steep).unwrap();
    let gap = 0.5 * exact.rupture().distance;
    assert!((curve.force(gap) / exact.force(gap).unwrap() - 1.0).abs() < 1e-3);
    let drop = bridge(sphere, 1e6, [0.0; 2]);
    assert!(Tabulated.curve(&drop, Range::Extrapolate).is_err());
    assert!(rupture_distance(&drop).is_err() && transfer_ratio(&drop).is_err());
}

#[test]
fn all_threads_read_the_same() {
    let bridges: Vec<Bridge> =
        (1..6).map(|k| bridge(Mate::PLANE, 0.01 * f64::from(k), [0.25, 0.75])).collect();
    let read = || -> Vec<f64> {
        bridges.iter().map(|b| Tabulated.force(b, 0.01, Range::Strict).unwrap()).collect()
    };
    let all: Vec<Vec<f64>> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(read)).collect();
        threads.into_iter().map(|t| t.join().unwrap()).collect()
    });
    assert!(all.iter().all(|forces| *forces == all[0]));
    assert_eq!(all[0], read());
}
