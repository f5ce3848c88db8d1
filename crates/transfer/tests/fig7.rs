//! What Elskamp & Kruggel-Emden (2018) say in words about their Fig. 7 (the curves are not
//! published as numbers), held against the equations (35) to (43) that it was made with.
//!
//! Two of their sentences contradict the equations; there the tests hold the equations, which an
//! independent solver and the symmetry of the bodies confirm.

#![allow(clippy::unwrap_used, reason = "tests may panic, their helpers too")]

use pendular_transfer::Mate;
use pendular_transfer::split::{Pair, parabola};

fn ratio(radius: f64, mate: Mate, deg: [f64; 2], v_star: f64) -> f64 {
    let pair = Pair::new(radius, mate, deg.map(f64::to_radians)).unwrap();
    parabola::split(&pair, pair.volume(v_star)).unwrap().transfer_ratio()
}

/// Fig. 7a, b: spheres of 3 to 10 mm, equal contact angles.
fn spheres(diameters: [f64; 2], deg: f64, v_star: f64) -> f64 {
    ratio(0.5e-3 * diameters[0], Mate::Sphere { radius: 0.5e-3 * diameters[1] }, [deg; 2], v_star)
}

/// Fig. 7c, d: a sphere of r = 1.5 mm and a large wall.
fn wall(sphere_deg: f64, wall_deg: f64, v_star: f64) -> f64 {
    ratio(1.5e-3, Mate::PLANE, [sphere_deg, wall_deg], v_star)
}

const VOLUMES: [f64; 6] = [0.01, 0.05, 0.1, 0.2, 0.35, 0.5];
/// In rising order of the size ratio.
const SIZES: [[f64; 2]; 5] = [[7.0, 5.0], [10.0, 7.0], [5.0, 3.0], [10.0, 5.0], [7.0, 3.0]];

#[test]
fn the_larger_sphere_gets_more_and_more_with_size_ratio_and_volume() {
    for deg in [10.0, 40.0] {
        for v in VOLUMES {
            let by_size: Vec<f64> = SIZES.iter().map(|d| spheres(*d, deg, v)).collect();
            assert!(by_size[0] > 0.5);
            assert!(by_size.windows(2).all(|w| w[0] < w[1]), "{deg} {v}: {by_size:?}");
        }
        for d in SIZES {
            let by_volume: Vec<f64> = VOLUMES.iter().map(|v| spheres(d, deg, *v)).collect();
            assert!(by_volume.windows(2).all(|w| w[0] < w[1]), "{deg} {d:?}: {by_volume:?}");
        }
    }
}

#[test]
fn at_a_small_angle_it_inclines_slowly_and_nearly_linearly_at_a_large_one_steeply() {
    for d in SIZES {
        let rise = |deg, from, to| spheres(d, deg, to) - spheres(d, deg, from);
        assert!(rise(40.0, 0.05, 0.5) > 2.5 * rise(10.0, 0.05, 0.5), "{d:?}");
        assert!(rise(10.0, 0.05, 0.5) < 0.04, "{d:?}");
        // Half way along the axis it is half way up, within a tenth.
        let half = rise(10.0, 0.1, 0.3) / rise(10.0, 0.1, 0.5);
        assert!((half - 0.5).abs() < 0.1, "{d:?}: {half}");
    }
}

/// The paper: the ratio at 10° is lower than at 40° for V* ≤ 0.4. The equations: higher, and the
/// two curves do cross near there. The sentence, which begins with "nevertheless" after calling the
/// 40° curve the steeper one, makes sense with the angles exchanged.
#[test]
fn the_curves_of_both_angles_cross_near_v_star_of_0_4() {
    for d in SIZES {
        let excess = |v| spheres(d, 40.0, v) - spheres(d, 10.0, v);
        for v in [0.01, 0.05, 0.1, 0.2, 0.3] {
            assert!(excess(v) < 0.0, "{d:?} {v}");
        }
        assert!(excess(0.3) < 0.0 && excess(0.55) > 0.0, "{d:?}");
    }
}

#[test]
fn against_a_wall_the_better_wetted_body_keeps_more() {
    for v in [0.1, 0.2, 0.35, 0.5] {
        for sphere_deg in [10.0, 40.0] {
            let by_wall: Vec<f64> =
                (0..=10).map(|k| wall(sphere_deg, 5.0 * f64::from(k), v)).collect();
            assert!(by_wall.windows(2).all(|w| w[0] < w[1]), "{sphere_deg} {v}: {by_wall:?}");
        }
        for wall_deg in [0.0, 10.0, 30.0, 50.0] {
            assert!(wall(10.0, wall_deg, v) > wall(40.0, wall_deg, v), "{wall_deg} {v}");
        }
    }
}

/// The paper: the ratio rises with V* where θ_i < θ_w and falls where θ_i > θ_w. The equations:
/// the other way round, towards an even split. With more liquid the half-filling angles add to
/// both contact angles and their difference counts for less.
#[test]
fn against_a_wall_more_liquid_evens_the_shares() {
    for (sphere_deg, wall_deg) in [(10.0, 20.0), (10.0, 50.0), (40.0, 45.0), (40.0, 50.0)] {
        let by_volume: Vec<f64> =
            [0.01, 0.05, 0.1, 0.2, 0.3].iter().map(|v| wall(sphere_deg, wall_deg, *v)).collect();
        assert!(by_volume.windows(2).all(|w| w[0] > w[1]), "{by_volume:?}");
    }
    for (sphere_deg, wall_deg) in [(10.0, 0.0), (10.0, 5.0), (40.0, 10.0), (40.0, 30.0)] {
        let by_volume: Vec<f64> =
            [0.01, 0.05, 0.1, 0.2, 0.3].iter().map(|v| wall(sphere_deg, wall_deg, *v)).collect();
        assert!(by_volume.windows(2).all(|w| w[0] < w[1]), "{by_volume:?}");
    }
}

/// Little liquid and a wall wetted much better than the sphere: no parabola meets both angles.
#[test]
fn a_well_wetted_wall_has_no_solution_for_small_volumes() {
    for wall_deg in [0.0, 5.0, 10.0] {
        let angles = [40.0, wall_deg].map(f64::to_radians);
        let pair = Pair::new(1.5e-3, Mate::PLANE, angles).unwrap();
        let said = parabola::split(&pair, pair.volume(1e-4)).unwrap_err().to_string();
        assert!(said.contains("no bridge profile"), "{said}");
    }
}
