//! Two claims on one film in the same step: the numbers of Yade's `checkLiquidMigration.py`.
//!
//! Three unit spheres in a row, 0 in the middle, both outer ones touch it in the same step. There
//! a particle can give what exceeds 0.01, divided by its new bridges; a bridge takes at most 0.03,
//! in proportion to what was offered. The rule is that code's, written out here; the shares that
//! go back are ours.

#![allow(clippy::unwrap_used, reason = "tests may panic, their helpers too")]

use pendular_transfer::Split;

const KEPT: f64 = 0.01;
const MOST: f64 = 0.03;
/// New bridges of this step: of 0 with 1, and of 0 with 2.
const BRIDGES: [[usize; 2]; 2] = [[0, 1], [0, 2]];

/// What each body gave to each bridge, all computed from the films before the step.
fn form(films: &mut [f64; 3]) -> [[f64; 2]; 2] {
    let bridges_of = |body: usize| BRIDGES.iter().flatten().filter(|b| **b == body).count();
    let before = *films;
    BRIDGES.map(|bodies| {
        let offered = bodies.map(|body| (before[body] - KEPT) / bridges_of(body) as f64);
        let sum = offered[0] + offered[1];
        let split = Split::new(offered[0] / sum).unwrap();
        let given = split.shares(sum.min(MOST));
        films[bodies[0]] -= given[0];
        films[bodies[1]] -= given[1];
        given
    })
}

fn rupture(films: &mut [f64; 3], given: [[f64; 2]; 2], split: impl Fn([f64; 2]) -> Split) {
    for (bodies, given) in BRIDGES.into_iter().zip(given) {
        let back = split(given).shares(given[0] + given[1]);
        films[bodies[0]] += back[0];
        films[bodies[1]] += back[1];
    }
}

fn assert_films(films: [f64; 3], expected: [f64; 3]) {
    assert!(films.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{films:?}");
    assert!((films.iter().sum::<f64>() - 0.12).abs() < 1e-15);
}

#[test]
fn yade_check_liquid_migration() {
    let mut films = [0.03, 0.04, 0.05];
    let given = form(&mut films);
    assert!(given.iter().all(|g| (g[0] + g[1] - 0.03).abs() < 1e-15));
    let close = |a: f64, b: f64| (a - b).abs() < 1e-15;
    assert!(close(given[0][0], 0.0075) && close(given[1][0], 0.006));

    // Each its own back.
    rupture(&mut films, given, |g| Split::new(g[0] / (g[0] + g[1])).unwrap());
    assert_films(films, [0.03, 0.04, 0.05]);

    // Second pass: half and half.
    let given = form(&mut films);
    rupture(&mut films, given, |_| Split::HALF);
    assert_films(films, [0.0465, 0.0325, 0.041]);
}
