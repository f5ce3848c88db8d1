use pendular_pair::{Bridge, Mate, Range};

use super::{
    Advice, AdviseError, BridgeRange, ERRORS, advise, cells, decode, encode, errors, laws,
};
use crate::young_laplace::ExactBridge;
use crate::{AnyCapillary, CapillaryLaw, ForceCurve};

fn error_of(law: AnyCapillary, range: &BridgeRange) -> f64 {
    errors(range).unwrap().into_iter().find(|a| a.law == law).unwrap().error
}

#[test]
fn codes_round_up_and_keep_the_ends() {
    for error in [1e-9, 3e-7, 0.012, 1.0, 9.0] {
        let read = decode(encode(error));
        assert!(read >= error * (1.0 - 1e-12) && read <= 1.11 * error, "{error} {read}");
    }
    assert_eq!(encode(0.0), 0);
    assert_eq!(encode(f64::NAN), u8::MAX);
    assert_eq!(encode(1e9), u8::MAX);
    assert_eq!(decode(u8::MAX), f64::INFINITY);
}

#[test]
fn the_data_fit_the_cells_and_name_every_law() {
    let count: usize = cells::SHAPE.iter().product();
    assert_eq!(ERRORS.len(), count * laws().len());
    let names: Vec<AnyCapillary> = laws().iter().map(|a| a.law).collect();
    assert_eq!(names, AnyCapillary::ALL);
    assert!(laws().iter().all(|a| a.nanoseconds > 0.0 && a.curve_nanoseconds > 0.0));
}

#[test]
fn a_tighter_tolerance_never_gets_a_cheaper_law() {
    let range = BridgeRange { v_star: (1e-4, 1e-1), gap: (0.0, 0.5), ..BridgeRange::default() };
    let mut last = f64::INFINITY;
    for tolerance in [1e-8, 1e-6, 1e-3, 1e-2, 0.1, 1.0, 100.0] {
        let Advice { law, error, nanoseconds, .. } = advise(&range, tolerance).unwrap();
        assert!(error <= tolerance && nanoseconds <= last, "{law} {error} {nanoseconds}");
        last = nanoseconds;
    }
    assert_eq!(advise(&range, 1e-8).unwrap().law, AnyCapillary::YoungLaplace);
    assert_eq!(advise(&range, 2e-3).unwrap().law, AnyCapillary::Tabulated);
}

#[test]
fn known_errors_are_found_again() {
    // Willett's full form: about 4 % over its stated range away from rupture, and of no use below
    // V* = 1e-4 (+31 % at 1e-5).
    let range = BridgeRange {
        v_star: (1e-4, 0.1),
        contact_angle: (0.0, 40_f64.to_radians()),
        gap: (0.0, 0.5),
        ..BridgeRange::default()
    };
    let error = error_of(AnyCapillary::WillettFull, &range);
    assert!((0.01..0.06).contains(&error), "{error}");
    // The sum law of spheres on planes is refused between spheres.
    assert_eq!(error_of(AnyCapillary::RabinovichPlane, &range), f64::INFINITY);
    // A wider range is never better.
    let wide = BridgeRange { radius_ratio: (1.0, f64::INFINITY), ..range };
    for (narrow, wide) in errors(&range).unwrap().iter().zip(errors(&wide).unwrap()) {
        assert!(wide.error >= narrow.error);
    }
}

#[test]
fn bridges_in_the_middle_of_nowhere_keep_the_promise() {
    // Places that are not among those measured; the bound may be passed a little between them.
    for (v_star, degrees, ratio) in [(3e-4, [17.0, 17.0], 1.4), (0.04, [5.0, 35.0], 3.0)] {
        let angles = degrees.map(f64::to_radians);
        let mate = Mate::Sphere { radius: ratio };
        let scale = Bridge::new(1.0, mate, 1.0, angles, 1.0).unwrap().harmonic_radius();
        let bridge = Bridge::new(1.0, mate, v_star * scale.powi(3), angles, 1.0).unwrap();
        let exact = ExactBridge::new(&bridge).unwrap();
        let range = BridgeRange {
            v_star: (v_star, v_star),
            contact_angle: (angles[0], angles[1]),
            angle_difference: angles[1] - angles[0],
            radius_ratio: (ratio, ratio),
            gap: (0.4, 0.4),
        };
        let gap = 0.4 * exact.rupture().distance;
        let force = exact.force(gap).unwrap();
        for advice in errors(&range).unwrap() {
            let Ok(curve) = advice.law.curve(&bridge, Range::Strict) else { continue };
            let error = (curve.force(gap) / force - 1.0).abs();
            assert!(error <= 1.2 * advice.error + 1e-9, "{}: {error} {}", advice.law, advice.error);
        }
    }
}

#[test]
fn what_was_not_measured_is_refused() {
    let all = BridgeRange::default();
    let refused = |range: &BridgeRange, tolerance| {
        matches!(advise(range, tolerance), Err(AdviseError::OutOfRange(_)))
    };
    assert!(refused(&all, f64::NAN) && refused(&all, 0.0));
    assert!(refused(&BridgeRange { v_star: (0.1, 0.01), ..all }, 0.1));
    assert!(refused(&BridgeRange { v_star: (0.1, 0.7), ..all }, 0.1));
    assert!(refused(&BridgeRange { contact_angle: (0.0, 1.2), ..all }, 0.1));
    assert!(refused(&BridgeRange { gap: (0.0, f64::NAN), ..all }, 0.1));
    let Err(AdviseError::NoLaw { best, .. }) = advise(&all, 1e-12) else { panic!("no such law") };
    assert_eq!(best.law, AnyCapillary::YoungLaplace);
}
