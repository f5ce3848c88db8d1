//! The battery that every capillary law has to pass, by one loop over [`AnyCapillary::ALL`].

use std::cell::Cell;

use pendular_capillary::{AnyCapillary, Bridge, CapillaryLaw, ForceCurve, Mate, Range};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// What a law says of itself beyond the trait.
struct Promise {
    /// Up to how many rupture gaps the force never increases, in the range; 0: not promised.
    falls_to: f64,
    /// Mean contact angle up to which the force is an attraction, degrees.
    attracts_to: f64,
    /// Error of 2 π R σ cos θ at contact for V* = 1e-9; `None`: no such limit.
    contact: Option<f64>,
    /// Relative rounding of symmetries.
    rounding: f64,
    /// Random inputs to try: a law that solves equations gets fewer.
    cases: u32,
}

fn promise(law: AnyCapillary) -> Promise {
    let closed = Promise {
        falls_to: 1e3,
        attracts_to: 180.0,
        contact: Some(1e-12),
        rounding: 1e-11,
        cases: 10_000,
    };
    match law.name() {
        "rabinovich" => Promise { contact: Some(5e-3), ..closed },
        "willett-full" => Promise { falls_to: 1.0, contact: None, ..closed },
        "weigert" => Promise { falls_to: 1.0, contact: Some(5e-3), ..closed },
        "soulie" => Promise { contact: None, ..closed },
        "bagheri" => Promise { falls_to: 1.0, contact: Some(1e-2), ..closed },
        // The exact force may rise with the gap at large angles, and repel at larger ones.
        "young-laplace" => Promise {
            falls_to: 0.0,
            attracts_to: 50.0,
            contact: Some(5e-3),
            rounding: 1e-8,
            cases: 200,
        },
        "tabulated" => {
            Promise { falls_to: 0.0, attracts_to: 50.0, contact: None, rounding: 1e-6, cases: 1000 }
        }
        _ => closed,
    }
}

/// Willett's rupture gap of equal spheres (2000), as a scale for the gap.
fn rupture_gap(bridge: &Bridge) -> f64 {
    let root = bridge.v_star().cbrt();
    let scale = bridge.harmonic_radius() * (1.0 + 0.5 * bridge.mean_contact_angle());
    scale * (root + 0.1 * root * root)
}

fn with_volume(radius: f64, mate: Mate, v_star: f64, degrees: [f64; 2], tension: f64) -> Bridge {
    let angles = degrees.map(f64::to_radians);
    let unit = Bridge::new(radius, mate, 1.0, angles, tension).unwrap();
    let volume = v_star * unit.harmonic_radius().powi(3);
    Bridge::new(radius, mate, volume, angles, tension).unwrap()
}

/// The box of inputs that wet grains live in, and its surroundings.
fn input_box() -> Vec<Bridge> {
    let mut bridges = Vec::new();
    let mates = [1e-3, 1.9e-3, 5e-2].map(|radius| Mate::Sphere { radius });
    for mate in mates.into_iter().chain([Mate::PLANE, Mate::Wall { half_side: 1e-3 }]) {
        for v_star in [1e-9, 1e-6, 1.2e-4, 1e-3, 1.1e-2, 0.09, 0.29, 0.5] {
            for degrees in [[0.0, 0.0], [10.0, 20.0], [40.0, 40.0], [15.0, 45.0], [80.0, 60.0]] {
                bridges.push(with_volume(1e-3, mate, v_star, degrees, 0.07275));
            }
        }
    }
    bridges
}

/// Bridges of the box that a law accepts, with its curve.
fn admitted(law: AnyCapillary, range: Range) -> Vec<(Bridge, impl ForceCurve)> {
    let curve = |b: Bridge| law.curve(&b, range).ok().map(|curve| (b, curve));
    input_box().into_iter().filter_map(curve).collect()
}

fn assert_close(law: AnyCapillary, left: f64, right: f64, tolerance: f64) {
    let scale = left.abs().max(right.abs()).max(f64::MIN_POSITIVE);
    assert!((left - right).abs() <= tolerance * scale, "{law}: {left:e} and {right:e}");
}

#[test]
fn finite_on_the_whole_input_box() {
    for law in AnyCapillary::ALL {
        let bridges = admitted(law, Range::Extrapolate);
        assert!(bridges.len() >= 60, "{law} takes {} bridges", bridges.len());
        for (bridge, curve) in bridges {
            let unit = rupture_gap(&bridge);
            let near =
                [-1.0, -1e-9, 0.0, 1e-12, 1e-6, 1e-3, 0.1, 0.5, 0.9, 0.98, 1.0, 1.1, 2.0, 9.0];
            let far = [f64::MIN, f64::MAX, 5e-324, 1e-300, 1e150, 1e160];
            for gap in near.map(|x| x * unit).into_iter().chain(far) {
                let force = curve.force(gap);
                assert!(force.is_finite(), "{law}: {force} at {gap:e} of {bridge:?}");
            }
            assert_close(law, curve.force(-unit), curve.force(0.0), 0.0);
        }
    }
}

#[test]
fn attracts_and_falls_with_the_gap_inside_the_range() {
    for law in AnyCapillary::ALL {
        let bridges = admitted(law, Range::Strict);
        assert!(bridges.len() >= 4, "{law} takes {} bridges", bridges.len());
        let Promise { falls_to, attracts_to, .. } = promise(law);
        for (bridge, curve) in bridges {
            if bridge.mean_contact_angle().to_degrees() > attracts_to {
                continue;
            }
            let unit = rupture_gap(&bridge);
            let mut last = f64::INFINITY;
            for k in 0..=60 {
                // Dense at contact, where the curves fall fastest; up to the rupture gap.
                let force = curve.force(unit * (f64::from(k) / 60.0).powi(4));
                assert!(force >= 0.0, "{law}: {force:e} at step {k} of {bridge:?}");
                let rounding = 1e-14 * force;
                assert!(falls_to < 1.0 || force <= last + rounding, "{law}: step {k}, {bridge:?}");
                last = force;
            }
            let mut x = 1.0;
            while x < falls_to {
                x *= 1.3;
                let force = curve.force(unit * x);
                assert!(force <= last && force >= 0.0, "{law}: {x} rupture gaps of {bridge:?}");
                last = force;
            }
        }
    }
}

#[test]
fn symmetric_in_the_bodies_and_linear_in_the_surface_tension() {
    for law in AnyCapillary::ALL {
        let Promise { rounding, .. } = promise(law);
        for (b, curve) in admitted(law, Range::Extrapolate) {
            let gaps = [0.0, 0.01, 0.4].map(|x| x * rupture_gap(&b));
            let (angles, tension) = (b.contact_angles(), 3.0 * b.surface_tension());
            let strong = Bridge::new(b.radius(), b.mate(), b.volume(), angles, tension).unwrap();
            let strong = law.curve(&strong, Range::Extrapolate).unwrap();
            let other = b.swapped().map(|b| law.curve(&b, Range::Extrapolate).unwrap());
            for gap in gaps {
                assert_close(law, 3.0 * curve.force(gap), strong.force(gap), rounding);
                if let Some(other) = other {
                    assert_close(law, curve.force(gap), other.force(gap), rounding);
                }
            }
        }
    }
}

#[test]
fn the_force_scales_with_length() {
    let factor = 37.5;
    for law in AnyCapillary::ALL {
        let Promise { rounding, .. } = promise(law);
        for (b, curve) in admitted(law, Range::Extrapolate) {
            let mate = match b.mate() {
                Mate::Sphere { radius } => Mate::Sphere { radius: factor * radius },
                Mate::Wall { half_side } => Mate::Wall { half_side: factor * half_side },
            };
            let (radius, volume) = (factor * b.radius(), factor.powi(3) * b.volume());
            let large =
                Bridge::new(radius, mate, volume, b.contact_angles(), b.surface_tension()).unwrap();
            let large = law.curve(&large, Range::Extrapolate).unwrap();
            for gap in [0.0, 0.01, 0.4].map(|x| x * rupture_gap(&b)) {
                let scaled = large.force(factor * gap) / factor;
                assert_close(law, curve.force(gap), scaled, rounding);
            }
        }
    }
}

#[test]
fn contact_limit_of_a_small_bridge() {
    for law in AnyCapillary::ALL {
        let Some(tolerance) = promise(law).contact else { continue };
        let mut tried = 0;
        for mate in [Mate::Sphere { radius: 1e-3 }, Mate::Sphere { radius: 3e-3 }, Mate::PLANE] {
            for degrees in [0.0, 20.0, 40.0] {
                let b = with_volume(1e-3, mate, 1e-9, [degrees; 2], 0.07275);
                let Ok(curve) = law.curve(&b, Range::Extrapolate) else { continue };
                let limit = std::f64::consts::PI
                    * b.harmonic_radius()
                    * b.surface_tension()
                    * b.cosine_sum();
                assert_close(law, curve.force(0.0), limit, tolerance);
                tried += 1;
            }
        }
        assert!(tried >= 3, "{law}");
    }
}

#[test]
fn a_large_sphere_is_a_plane_or_a_plane_is_refused() {
    for law in AnyCapillary::ALL {
        for degrees in [[0.0, 0.0], [30.0, 10.0]] {
            let plane = with_volume(1e-3, Mate::PLANE, 1.5e-3, degrees, 0.07275);
            let huge = Mate::Sphere { radius: 1e9 };
            let sphere =
                Bridge::new(1e-3, huge, plane.volume(), plane.contact_angles(), 0.07275).unwrap();
            let on_plane = law.curve(&plane, Range::Extrapolate);
            match (on_plane, law.curve(&sphere, Range::Extrapolate)) {
                (Ok(on_plane), Ok(on_sphere)) => {
                    for gap in [0.0, 1e-6, 3e-5, 1e-4] {
                        assert_close(law, on_plane.force(gap), on_sphere.force(gap), 1e-6);
                    }
                }
                (Err(error), Ok(_)) => {
                    assert_eq!((law.name(), error.quantity), ("soulie", "radius ratio"));
                }
                (Ok(on_plane), Err(error)) => {
                    assert_eq!(error.quantity, "radius ratio", "{law}");
                    // The law of planes meets the law of spheres that has a plane limit.
                    if law.name() == "rabinovich-plane" {
                        let lambert = AnyCapillary::Lambert.curve(&sphere, Range::Extrapolate);
                        assert_close(law, on_plane.force(3e-5), lambert.unwrap().force(3e-5), 1e-6);
                    }
                }
                (Err(a), Err(b)) => panic!("{law}: {a}, {b}"),
            }
        }
    }
}

#[test]
fn examples_lie_in_the_range_and_cover_it() {
    for law in AnyCapillary::ALL {
        for bridge in law.examples() {
            let force = law.force(&bridge, 0.3 * rupture_gap(&bridge), Range::Strict).unwrap();
            assert!(force > 0.0, "{law}: {bridge:?}");
        }
    }
}

/// Radius, mate radius, volume, surface tension; the angles; the gap.
type Raw = ([f64; 4], [f64; 2], f64, bool);

/// Whether the law answers; panics where it answers wrongly.
fn answers(law: AnyCapillary, (sizes, angles, gap, wall): Raw) -> bool {
    let [radius, other, volume, tension] = sizes;
    let mate = if wall { Mate::Wall { half_side: other } } else { Mate::Sphere { radius: other } };
    let Ok(bridge) = Bridge::new(radius, mate, volume, angles, tension) else { return false };
    let strict = law.force(&bridge, gap, Range::Strict);
    let free = law.force(&bridge, gap, Range::Extrapolate);
    match (strict, free) {
        (Ok(a), Ok(b)) => assert_eq!(a, b, "{law}: {bridge:?}"),
        (Ok(_), Err(error)) => panic!("{law} refuses {bridge:?} only when free: {error}"),
        (Err(error), _) => assert!(!error.to_string().is_empty()),
    }
    if let Ok(force) = free {
        // Beyond the finite reals a gap may read as contact or as far away, but never as NaN.
        assert!(force.is_finite(), "{law}: {force} at {gap:e} of {bridge:?}");
    }
    free.is_ok()
}

/// Any double, infinite and NaN included.
fn anything() -> impl Strategy<Value = Raw> {
    let value = proptest::num::f64::ANY;
    ([value; 4], [value; 2], value, any::<bool>())
}

/// Any positive size, of any exponent, and any angle below 180°: bridges that exist.
fn any_bridge() -> impl Strategy<Value = Raw> {
    let size = || (-307.0..307.0f64).prop_map(|power| 10f64.powf(power));
    let angle = || prop_oneof![Just(0.0), 0.0..std::f64::consts::PI];
    let gap =
        proptest::num::f64::POSITIVE | proptest::num::f64::NEGATIVE | proptest::num::f64::ZERO;
    let sizes = [size().boxed(), size().boxed(), size().boxed(), size().boxed()];
    (sizes, [angle(), angle()], gap, any::<bool>())
}

/// Any positive size within some decades of a grain: mostly bridges that a law answers.
fn grain_bridge() -> impl Strategy<Value = Raw> {
    let size = |low: f64, high: f64| (low..high).prop_map(|power| 10f64.powf(power)).boxed();
    let sizes = [size(-7.0, -1.0), size(-7.0, -1.0), size(-24.0, -3.0), size(-3.0, 0.0)];
    let angle = || 0.0..std::f64::consts::PI;
    (sizes, [angle(), angle()], -1e-3..1e-2f64, any::<bool>())
}

fn random_inputs(law: AnyCapillary) {
    let cases = promise(law).cases;
    // The same inputs in every run.
    let config = ProptestConfig {
        cases,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(2005),
        ..ProptestConfig::default()
    };
    let mut runner = proptest::test_runner::TestRunner::new(config);
    let strategy = prop_oneof![anything(), any_bridge(), grain_bridge()];
    let answered = Cell::new(0);
    let outcome = runner.run(&strategy, |raw| {
        answered.set(answered.get() + u32::from(answers(law, raw)));
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{law}: {error}"));
    assert!(answered.get() > cases / 20, "{law}: {} of {cases}", answered.get());
}

#[test]
fn random_inputs_anywhere_get_typed_answers() {
    AnyCapillary::ALL.into_iter().for_each(random_inputs);
}

/// A bridge whose force π σ R exceeds every double: refused, never infinite.
fn overflow(law: AnyCapillary) {
    let other = Mate::Sphere { radius: 2e175 };
    for (mate, volume) in [(other, 1.7e-268), (Mate::PLANE, 1e30), (Mate::PLANE, 1e36)] {
        let bridge = Bridge::new(1.7e12, mate, volume, [0.0; 2], 9e300).unwrap();
        if let Ok(force) = law.force(&bridge, 0.0, Range::Extrapolate) {
            assert!(force.is_finite(), "{law}: {force} of {bridge:?}");
        }
    }
}

#[test]
fn forces_beyond_the_reals_are_refused() {
    AnyCapillary::ALL.into_iter().for_each(overflow);
}
