use std::f64::consts::PI;

use pendular_pair::{Bridge, Mate};

use super::exact::Setup;
use super::gauss::Rule;
use super::path::Solver;
use super::{ExactBridge, RuptureKind, SolveError, rupture, solve};

/// A bridge on a unit sphere by V*, angles in degrees, surface tension 1.
fn bridge(mate_radius: f64, v_star: f64, degrees: [f64; 2]) -> Bridge {
    let mate =
        if mate_radius.is_finite() { Mate::Sphere { radius: mate_radius } } else { Mate::PLANE };
    let angles = degrees.map(f64::to_radians);
    let scale = Bridge::new(1.0, mate, 1.0, angles, 1.0).unwrap().harmonic_radius();
    Bridge::new(1.0, mate, v_star * scale.powi(3), angles, 1.0).unwrap()
}

fn some_bridges() -> Vec<Bridge> {
    vec![
        bridge(1.0, 1e-3, [0.0, 0.0]),
        bridge(1.0, 0.5, [60.0, 60.0]),
        bridge(1.0, 1e-6, [20.0, 50.0]),
        bridge(3.0, 0.1, [10.0, 10.0]),
        bridge(0.02, 1e-2, [40.0, 5.0]),
        bridge(f64::INFINITY, 0.05, [15.0, 45.0]),
        bridge(f64::INFINITY, 1e-5, [0.0, 0.0]),
    ]
}

#[test]
fn force_is_the_slope_of_the_energy() {
    for bridge in some_bridges() {
        let exact = ExactBridge::new(&bridge).unwrap();
        let distance = exact.rupture().distance;
        for part in [0.05, 0.3, 0.6, 0.9] {
            let (gap, step) = (part * distance, 2e-4 * distance);
            let energy = |k: f64| exact.solve(gap + k * step).unwrap().energy;
            let slope =
                (8.0 * (energy(1.0) - energy(-1.0)) - (energy(2.0) - energy(-2.0))) / (12.0 * step);
            let force = exact.force(gap).unwrap();
            assert!((slope / force - 1.0).abs() < 1e-6, "{bridge:?} at {part}: {slope} {force}");
        }
    }
}

#[test]
fn a_runge_kutta_meridian_meets_the_second_body() {
    for bridge in some_bridges() {
        let exact = ExactBridge::new(&bridge).unwrap();
        for part in [0.0, 0.5, 0.999] {
            let solution = exact.solve(part * exact.rupture().distance).unwrap();
            let form = solution.form;
            let (beta, length) = (form.state[0].exp(), form.state[2].exp());
            let q = -solution.pressure_difference * form.scale / form.surface_tension;
            let [near, far] = form.problem.angles;
            let y0 = form.problem.radius * beta.sin();
            // x, y, α, volume over s
            let rate = |v: [f64; 4]| {
                [v[2].cos(), v[2].sin(), v[2].cos() / v[1] + q, PI * v[1] * v[1] * v[2].cos()]
            };
            let mut v = [0.0, y0, beta + near - 0.5 * PI, 0.0];
            let h = length / 4000.0;
            for _ in 0..4000 {
                let ahead = |k: [f64; 4], f: f64| [0, 1, 2, 3].map(|i| v[i] + f * h * k[i]);
                let a = rate(v);
                let b = rate(ahead(a, 0.5));
                let c = rate(ahead(b, 0.5));
                let d = rate(ahead(c, 1.0));
                v = [0, 1, 2, 3].map(|i| v[i] + h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]));
            }
            let cap = |radius: f64, y: f64| {
                let height = y * y / (radius + (radius * radius - y * y).max(0.0).sqrt());
                (height, PI * height * (3.0 * y * y + height * height) / 6.0)
            };
            let first = cap(form.problem.radius, y0);
            let (second, tilt) = if form.problem.curvature > 0.0 {
                (cap(1.0 / form.problem.curvature, v[1]), (form.problem.curvature * v[1]).asin())
            } else {
                ((0.0, 0.0), 0.0)
            };
            let gap = v[0] - first.0 - second.0;
            let volume = v[3] - first.1 - second.1;
            let size = form.problem.volume.sqrt();
            assert!((gap - solution.gap / form.scale).abs() < 1e-9 * size, "{bridge:?} {part}");
            assert!((volume / form.problem.volume - 1.0).abs() < 1e-9, "{bridge:?} {part}");
            assert!((v[2] - (0.5 * PI - tilt - far)).abs() < 1e-9, "{bridge:?} {part}");
        }
    }
}

#[test]
fn catenoid_between_equal_spheres() {
    // Δp = 0: y = c cosh(x/c), F = 2πσc.
    let (beta, theta) = (20.0_f64.to_radians(), 30.0_f64.to_radians());
    let y = beta.sin();
    let c = y * (beta + theta - 0.5 * PI).cos();
    let x = c * (y / c).acosh();
    let height = 1.0 - beta.cos();
    let barrel = 2.0 * PI * c * c * (0.5 * x + 0.25 * c * (2.0 * x / c).sinh());
    let volume = barrel - 2.0 * PI * height * height * (3.0 - height) / 3.0;
    let bridge = Bridge::new(1.0, Mate::Sphere { radius: 1.0 }, volume, [theta; 2], 2.0).unwrap();
    let solution = solve(&bridge, 2.0 * (x - height)).unwrap();
    assert!((solution.force / (4.0 * PI * c) - 1.0).abs() < 1e-11);
    assert!(solution.pressure_difference.abs() < 1e-9);
    assert!((solution.neck_radius / c - 1.0).abs() < 1e-11);
    assert!((solution.half_filling_angles[0] / beta - 1.0).abs() < 1e-11);
    // area of the catenoid 2π c (x + (c/2) sinh(2x/c))
    let area = 2.0 * PI * c * (x + 0.5 * c * (2.0 * x / c).sinh());
    assert!((solution.free_area / area - 1.0).abs() < 1e-11);
    assert!((solution.wetted_areas[1] / (2.0 * PI * height) - 1.0).abs() < 1e-11);
}

#[test]
fn cylinder_between_sphere_and_sphere() {
    // β + θ = 90°: y constant, Δp = σ/y, F = 2πσy − πσy = πσy.
    let theta = 75.0_f64.to_radians();
    let (beta, length) = (0.5 * PI - theta, 0.5);
    let (y, height) = (beta.sin(), 1.0 - beta.cos());
    let volume = PI * y * y * length - 2.0 * PI * height * height * (3.0 - height) / 3.0;
    let bridge = Bridge::new(1.0, Mate::Sphere { radius: 1.0 }, volume, [theta; 2], 1.0).unwrap();
    let solution = solve(&bridge, length - 2.0 * height).unwrap();
    assert!((solution.force / (PI * y) - 1.0).abs() < 1e-11);
    assert!((solution.pressure_difference * y - 1.0).abs() < 1e-10);
}

#[test]
fn contact_limit_is_approached_like_the_fourth_root_of_volume() {
    for (mate, theta) in [(1.0, 0.0), (2.5, 20.0), (f64::INFINITY, 40.0)] {
        let deficit = |v_star: f64| {
            let b = bridge(mate, v_star, [theta; 2]);
            1.0 - solve(&b, 0.0).unwrap().force / (PI * b.harmonic_radius() * b.cosine_sum())
        };
        let (small, large) = (deficit(1e-9), deficit(1.6e-8));
        assert!(small > 0.0 && small < 4e-3, "{small}");
        // Mixed powers: the quarter power leads, the half power follows.
        assert!((1.9..2.2).contains(&(large / small)), "{}", large / small);
    }
}

#[test]
fn known_deficit_and_jump_at_rupture() {
    let deficit = 1.0 - solve(&bridge(1.0, 1e-6, [0.0; 2]), 0.0).unwrap().force / (2.0 * PI);
    assert!((deficit - 0.011).abs() < 5e-4, "{deficit}");
    // Force at the fold over force at contact, θ = 0.
    for (v_star, jump) in [(1e-5, 0.007), (1e-4, 0.015), (1e-3, 0.03), (1e-2, 0.07), (1e-1, 0.15)] {
        let exact = ExactBridge::new(&bridge(1.0, v_star, [0.0; 2])).unwrap();
        let ratio = exact.last_stable().force / exact.force(0.0).unwrap();
        assert!((ratio / jump - 1.0).abs() < 0.1, "{v_star}: {ratio}");
    }
}

#[test]
fn the_pitchfork_precedes_the_fold_above_known_angles() {
    // 31.1° between parallel plates (the limit V* → 0) and less for larger bridges.
    for (v_star, limit) in [(1e-9, 31.1), (1e-3, 30.7), (0.1, 28.1), (0.5, 24.4)] {
        let kind = |degrees: f64| rupture(&bridge(1.0, v_star, [degrees; 2])).unwrap().kind;
        assert_eq!(kind(limit - 0.1), RuptureKind::Fold, "{v_star}");
        assert_eq!(kind(limit + 0.1), RuptureKind::Pitchfork, "{v_star}");
    }
}

#[test]
fn the_closed_condition_of_the_pitchfork_is_the_whole_determinant() {
    for (v_star, degrees) in [(1e-6, 40.0), (1e-3, 60.0), (0.3, 35.0)] {
        let bridge = bridge(1.0, v_star, [degrees; 2]);
        let exact = ExactBridge::new(&bridge).unwrap();
        assert_eq!(exact.rupture().kind, RuptureKind::Pitchfork);
        let whole = Solver { problem: Setup::new(&bridge, Rule::Fine).whole, mirror: false };
        let distance = exact.rupture().distance;
        assert!(whole.stable(&exact.solve(distance * (1.0 - 1e-7)).unwrap().form.state));
        let (last, before) = (exact.last_stable(), exact.solve(distance * (1.0 - 1e-4)).unwrap());
        let beyond = [0, 1, 2].map(|k| 1.001 * last.form.state[k] - 0.001 * before.form.state[k]);
        assert!(!whole.stable(&beyond), "{v_star} {degrees}");
    }
}

#[test]
fn slightly_unequal_spheres_split_unevenly() {
    let r = rupture(&bridge(0.99, 1e-3, [40.0; 2])).unwrap();
    assert!((r.share - 0.544).abs() < 5e-4, "{}", r.share);
    assert_eq!(r.kind, RuptureKind::Fold);
    let equal = rupture(&bridge(1.0, 1e-3, [40.0; 2])).unwrap();
    assert!(r.distance < equal.distance && r.distance > 0.99 * equal.distance);
    assert_eq!(equal.share, 0.5);
}

#[test]
fn the_neck_jumps_between_the_bodies_under_unequal_angles() {
    // Glass sphere on steel (15°, 45°) and POM on steel (40°, 45°): V/r³ and share on the sphere.
    let share = |volume: f64, degrees: [f64; 2]| {
        let angles = degrees.map(f64::to_radians);
        rupture(&Bridge::new(1.0, Mate::PLANE, volume, angles, 1.0).unwrap()).unwrap().share
    };
    for (volume, known) in [(0.01, 0.80), (0.1, 0.68), (0.3, 0.28)] {
        assert!((share(volume, [15.0, 45.0]) - known).abs() < 6e-3, "{volume}");
    }
    for (volume, known) in [(1e-3, 0.61), (3e-3, 0.34)] {
        assert!((share(volume, [40.0, 45.0]) - known).abs() < 6e-3, "{volume}");
    }
}

#[test]
fn the_stable_bridge_has_less_energy_than_the_unstable_one() {
    for bridge in [bridge(1.0, 1e-3, [0.0; 2]), bridge(3.0, 0.1, [20.0, 40.0])] {
        let exact = ExactBridge::new(&bridge).unwrap();
        let setup = Setup::new(&bridge, Rule::Fine);
        let path = setup.solver.path().unwrap();
        let end = path.nodes.last().unwrap();
        let gap = 0.995 * end.gap;
        let stable = path.state(&setup.solver, gap).unwrap();
        let guess = [0, 1, 2].map(|k| 2.0 * end.state[k] - stable[k]);
        let unstable = setup.solver.at_gap(gap, guess).unwrap();
        assert!(!setup.solver.stable(&unstable));
        let metres = gap * setup.gap_unit();
        let energies = [stable, unstable].map(|s| setup.form(s).solution(metres).energy);
        assert!(energies[0] < energies[1], "{energies:?}");
        let same = exact.solve(metres).unwrap().energy;
        assert!((energies[0] / same - 1.0).abs() < 1e-12);
    }
}

#[test]
fn seen_from_the_other_body_it_is_the_same_bridge() {
    for bridge in [bridge(1.0, 1e-3, [10.0, 50.0]), bridge(7.0, 0.1, [30.0, 20.0])] {
        let (a, b) = (
            ExactBridge::new(&bridge).unwrap(),
            ExactBridge::new(&bridge.swapped().unwrap()).unwrap(),
        );
        let gap = 0.4 * a.rupture().distance;
        let (s, t) = (a.solve(gap).unwrap(), b.solve(gap).unwrap());
        assert_eq!(s.force, t.force);
        assert_eq!(s.half_filling_angles[0], t.half_filling_angles[1]);
        assert!((s.share + t.share - 1.0).abs() < 1e-14);
        assert!((s.neck_position + t.neck_position - gap).abs() < 1e-14);
        assert!((a.rupture().share + b.rupture().share - 1.0).abs() < 1e-14);
        let (first, last) = (s.meridian(11), t.meridian(11));
        for (p, q) in first.iter().zip(last.iter().rev()) {
            assert!((p[0] + q[0] - gap).abs() < 1e-13 && (p[1] - q[1]).abs() < 1e-13);
        }
        assert!((first[0][1] - s.contact_radii[0]).abs() < 1e-14);
    }
}

#[test]
fn errors_are_typed_and_nothing_hangs() {
    let b = bridge(1.0, 1e-3, [0.0; 2]);
    assert!(matches!(solve(&b, f64::NAN), Err(SolveError::Gap { .. })));
    assert!(matches!(solve(&b, 0.2), Err(SolveError::Ruptured { .. })));
    assert_eq!(solve(&b, -1.0).unwrap().force, solve(&b, 0.0).unwrap().force);
    for mate in [1.0, 1.0 + 1e-11, 1e-4, 1e6, f64::INFINITY] {
        for v_star in [1e-30, 1e-13, 2.0, 50.0, 1e6] {
            for degrees in [[0.0, 0.0], [0.0, 120.0], [90.0, 90.0], [100.0, 100.0], [179.0, 179.0]]
            {
                if let Ok(exact) = ExactBridge::new(&bridge(mate, v_star, degrees)) {
                    assert!(exact.rupture().distance > 0.0);
                    assert!(exact.last_stable().force.is_finite());
                }
            }
        }
    }
}

#[test]
fn bodies_equal_to_nearly_all_digits() {
    // The pitchfork's unfolding: S_rup falls like the 2/3 power of the asymmetry.
    for degrees in [25.0, 31.2, 45.0, 60.0] {
        for v_star in [1e-9, 1e-3, 0.5] {
            let equal = rupture(&bridge(1.0, v_star, [degrees; 2])).unwrap().distance;
            for power in [-15, -13, -12, -11, -9, -6] {
                let asymmetry = 10.0_f64.powi(power);
                let near = rupture(&bridge(1.0 + asymmetry, v_star, [degrees; 2])).unwrap();
                let drop = 1.0 - near.distance / equal;
                assert!(drop.abs() < 2.0 * asymmetry.powf(2.0 / 3.0) + 1e-11, "{degrees} {drop}");
            }
        }
    }
}

#[test]
fn the_coarse_rule_agrees_to_1e_7() {
    for bridge in some_bridges() {
        let (fine, coarse) =
            (ExactBridge::new(&bridge).unwrap(), ExactBridge::coarse(&bridge).unwrap());
        let (a, b) = (fine.rupture().distance, coarse.rupture().distance);
        assert!((a / b - 1.0).abs() < 1e-7, "{bridge:?}");
        for part in [0.0, 0.5, 0.9] {
            let ratio = fine.force(part * a).unwrap() / coarse.force(part * a).unwrap();
            assert!((ratio - 1.0).abs() < 1e-7, "{bridge:?} {part}");
        }
    }
}

#[test]
fn near_rupture_every_gap_is_solved() {
    for bridge in some_bridges() {
        let exact = ExactBridge::new(&bridge).unwrap();
        let distance = exact.rupture().distance;
        let last = exact.last_stable().force;
        for k in 1..18 {
            let depth = 10.0_f64.powi(-k);
            let force = exact.force(distance * (1.0 - depth)).unwrap();
            assert!(
                (force / last - 1.0).abs() < 4.0 * depth.sqrt(),
                "{bridge:?} {k}: {force} {last}"
            );
        }
    }
}

/// Rows of our reference table (SI units, angle in degrees), solved by two independent programs
/// that agree to 4e-10: r_i, r_j, V, σ, θ, S, F.
const REFERENCE: &[[f64; 7]] = &[
    [0.002381, 0.002381, 1.36e-11, 0.0206, 0.0, 2.41089586104e-05, 0.0001895988245],
    [0.002381, 0.002381, 3.13e-11, 0.0206, 0.0, 3.19319450306e-05, 0.0001996464437],
    [0.002381, 0.002381, 7.42e-11, 0.0206, 0.0, 4.27627650119e-05, 0.0002077490418],
    [0.002381, 0.001588, 9.6e-12, 0.0206, 0.0, 2.10954522146e-05, 0.000156229405],
    [0.002381, 0.001588, 1.32e-11, 0.0206, 0.0, 2.3438291809e-05, 0.0001593257515],
    [0.002381, 0.001588, 2.47e-11, 0.0206, 0.0, 2.88266025796e-05, 0.0001646791973],
    [0.002381, 0.001588, 5.93e-11, 0.0206, 0.0, 3.84648613858e-05, 0.0001703620261],
    [0.002381, 0.001191, 2.53e-11, 0.0206, 0.0, 2.85430729851e-05, 0.0001411389175],
    [0.002381, 0.001191, 6.18e-11, 0.0206, 0.0, 3.80606405167e-05, 0.0001446797216],
    [0.002381, 0.001191, 1.278e-10, 0.0206, 0.0, 4.79753271784e-05, 0.0001458632752],
    [1.9e-05, 3.5e-05, 2e-19, 0.027, 10.0, 6.22266964562e-08, 1.440530146e-06],
    [1.9e-05, 3.25e-05, 1.2e-18, 0.024, 10.0, 1.13071093691e-07, 1.661586571e-06],
    [1.9e-05, 2.75e-05, 3.6e-18, 0.028, 10.0, 1.63957342493e-07, 2.102017828e-06],
    [0.002381, f64::INFINITY, 1.624e-10, 0.0206, 0.0, 5.20581337132e-05, 0.0003982574122],
    [0.002381, f64::INFINITY, 2.802e-10, 0.0206, 0.0, 6.18401012278e-05, 0.0004110255751],
];

#[test]
fn reference_rows() {
    for &[radius, mate, volume, tension, degrees, gap, force] in REFERENCE {
        let mate = if mate.is_finite() { Mate::Sphere { radius: mate } } else { Mate::PLANE };
        let bridge = Bridge::new(radius, mate, volume, [degrees.to_radians(); 2], tension).unwrap();
        let solved = solve(&bridge, gap).unwrap().force;
        assert!((solved / force - 1.0).abs() < 1e-9, "{bridge:?}: {solved} {force}");
    }
}
