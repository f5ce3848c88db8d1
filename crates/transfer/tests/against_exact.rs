//! The error of each rupture law against the exact Young-Laplace bridge, over its stated range.
//!
//! The bands are those of the laws' documentation. A test fails when a law leaves its band, and
//! also when the band is wider than what the law needs.

#![allow(clippy::unwrap_used, reason = "tests may panic, their helpers too")]

use pendular_capillary::young_laplace;
use pendular_transfer::rupture::{Lian1993, Mikami1998, Willett2000, WillettUnequal2000};
use pendular_transfer::split::{Pair, parabola};
use pendular_transfer::{Bridge, Mate, Range, RuptureLaw};

const PLANE: f64 = f64::INFINITY;

fn bridge(ratio: f64, deg: [f64; 2], v_star: f64) -> Bridge {
    let mate = if ratio < PLANE { Mate::Sphere { radius: 1.0 / ratio } } else { Mate::PLANE };
    let with = |v| Bridge::new(1.0, mate, v, deg.map(f64::to_radians), 1.0).unwrap();
    with(v_star * with(1.0).harmonic_radius().powi(3))
}

/// Smallest and largest relative error over a grid, in per cent to one decimal.
fn band(
    law: impl RuptureLaw,
    ratios: &[f64],
    angles: &[[f64; 2]],
    decades: (f64, f64),
) -> [f64; 2] {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for &ratio in ratios {
        for &deg in angles {
            for k in 0..=12 {
                let lg = decades.0 + (decades.1 - decades.0) * f64::from(k) / 12.0;
                // The ends are inside the range: keep rounding from stepping over them.
                let b = bridge(ratio, deg, 10f64.powf(lg) * (1.0 + 1e-9 * f64::from(6 - k)));
                let exact = young_laplace::rupture(&b).unwrap().distance;
                let error = law.distance(&b, Range::Strict).unwrap() / exact - 1.0;
                (low, high) = (low.min(error), high.max(error));
            }
        }
    }
    [low, high].map(|e| (1000.0 * e).round() / 10.0)
}

const EQUAL: [[f64; 2]; 6] =
    [[0.0; 2], [10.0; 2], [20.0; 2], [30.0; 2], [40.0; 2], [49.9999999; 2]];

#[test]
fn lian() {
    assert_eq!(band(Lian1993, &[1.0], &EQUAL, (-7.0, -1.0)), [-4.9, 4.0]);
}

#[test]
fn willett() {
    assert_eq!(band(Willett2000, &[1.0], &EQUAL, (-7.0, 0.3f64.log10())), [-2.7, 4.1]);
}

#[test]
fn willett_unequal() {
    let ratios = [1.0, 1.2, 2.0, 4.0, 10.0, 50.0, PLANE];
    let law = WillettUnequal2000;
    assert_eq!(band(law, &ratios, &EQUAL, (-7.0, 0.3f64.log10())), [-10.4, 4.1]);
    assert_eq!(band(law, &ratios, &EQUAL, (-4.0, -1.0)), [-6.7, 4.0]);
    let near = [[0.0, 5.0], [15.0, 20.0], [30.0, 35.0], [40.0, 45.0], [45.0, 40.0]];
    let found = band(law, &[1.0, 2.0, 10.0, PLANE], &near, (-7.0, 0.3f64.log10()));
    assert_eq!(found, [-13.1, 12.2]);
}

#[test]
fn mikami() {
    assert_eq!(band(Mikami1998, &[1.0], &EQUAL, (-4.0, -1.0)), [-7.4, 4.9]);
    assert_eq!(band(Mikami1998, &[PLANE], &EQUAL, (-6.0, 0.03f64.log10())), [-2.1, 12.3]);
}

/// What the laws' pages say about bridges outside their ranges.
#[test]
fn outside_the_ranges() {
    let error = |law: &dyn Fn(&Bridge) -> f64, ratio, deg, v| {
        let b = bridge(ratio, deg, v);
        (100.0 * (law(&b) / young_laplace::rupture(&b).unwrap().distance - 1.0)).round()
    };
    let lian = |b: &Bridge| Lian1993.distance(b, Range::Extrapolate).unwrap();
    let willett = |b: &Bridge| Willett2000.distance(b, Range::Extrapolate).unwrap();
    let at_50 = |law: &dyn Fn(&Bridge) -> f64, ratio| error(law, ratio, [50.0; 2], 0.1);
    assert_eq!([2.0, 10.0, PLANE].map(|r| at_50(&lian, r)), [17.0, 34.0, 39.0]);
    assert_eq!([2.0, 10.0, PLANE].map(|r| at_50(&willett, r)), [23.0, 40.0, 45.0]);
    assert_eq!(error(&lian, 1.0, [15.0, 45.0], 1e-5), 33.0);
    assert_eq!(error(&willett, 1.0, [15.0, 45.0], 0.1), 35.0);
}

/// How far the parabola's split is from the exact one, as its page says.
#[test]
fn parabola_against_the_exact_split() {
    let off = |ratio, deg| {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for v_star in [1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3] {
            let b = bridge(ratio, [deg; 2], v_star);
            let Ok(split) = parabola::split(&Pair::of(&b), b.volume()) else { continue };
            let error = split.transfer_ratio() - young_laplace::rupture(&b).unwrap().share;
            (low, high) = (low.min(error), high.max(error));
        }
        [low, high].map(|e| (100.0 * e).round() / 100.0)
    };
    assert_eq!(off(2.0, 10.0), [-0.13, 0.09]);
    assert_eq!(off(2.0, 0.0), [-0.11, 0.13]);
    assert_eq!(off(2.0, 40.0), [-0.2, -0.12]);
    assert_eq!(off(PLANE, 10.0), [0.07, 0.35]);
    assert_eq!(off(PLANE, 40.0), [0.21, 0.44]);
}
