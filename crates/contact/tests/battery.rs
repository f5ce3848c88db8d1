//! Promises of every contact law, for parameters drawn at random.
#![allow(clippy::unwrap_used)]

use pendular_contact::{
    AnyContact, ContactModel, ElasticPlastic, HertzMindlin, Linear, NormalContact, PlasticMemory,
};
use proptest::prelude::*;

fn any_law() -> impl Strategy<Value = AnyContact> {
    let power = |range: std::ops::Range<f64>| range.prop_map(|x| 10f64.powf(x));
    let hertz = (power(6.0..12.0), power(-5.0..-1.0), 0.01..1.0, power(-9.0..0.0));
    prop_oneof![
        (power(1.0..8.0), 0.01..1.0, power(-9.0..0.0))
            .prop_map(|(k, e, m)| Linear::from_restitution(k, e, m).unwrap().into()),
        hertz.prop_map(|(modulus, radius, e, mass)| {
            HertzMindlin::from_restitution(modulus, radius, e, mass).unwrap().into()
        }),
        (power(6.0..12.0), power(-5.0..-1.0), power(-4.0..-1.0)).prop_map(
            |(modulus, radius, y)| {
                ElasticPlastic::new(modulus, radius, y * modulus).unwrap().into()
            }
        ),
    ]
}

proptest! {
    #[test]
    fn pushes_only_and_rises_with_overlap(
        law in any_law(), overlap in -9.0..-3.0, speed in -10.0..10.0_f64,
    ) {
        let s = 10f64.powf(overlap);
        let force = |s: f64, speed: f64| law.force(s, speed, &mut PlasticMemory::default());
        prop_assert!(force(s, speed) >= 0.0 && force(s, speed).is_finite());
        prop_assert!(force(1.01 * s, 0.0) > force(s, 0.0));
        prop_assert!(force(s, 1.0) >= force(s, 0.0));
        prop_assert!(force(s, -1.0) <= force(s, 0.0));
        prop_assert_eq!(force(0.0, 0.0), 0.0);
        // dashpot: dF/d(speed); spring: at least dF/dδ of loading
        let pushed = force(s, 1.0) - force(s, 0.0);
        prop_assert!((pushed - law.damping(s)).abs() <= 1e-9 * (pushed + force(s, 0.0)));
        let slope = (force(s * 1.0001, 0.0) - force(s, 0.0)) / (1e-4 * s);
        prop_assert!(law.stiffness(s) >= slope * (1.0 - 1e-4));
        prop_assert!(law.tangential_stiffness(s) > 0.0);
    }

    #[test]
    fn any_finite_numbers_get_a_law_or_a_typed_error(
        a in any::<f64>(), b in any::<f64>(), c in any::<f64>(), d in any::<f64>(),
    ) {
        let laws = [
            Linear::from_restitution(a, c, b).map(AnyContact::from),
            HertzMindlin::from_restitution(a, b, c, d).map(AnyContact::from),
            ElasticPlastic::new(a, b, d).map(AnyContact::from),
        ];
        for law in laws.into_iter().flatten() {
            let force = law.force(1e-6, 0.1, &mut PlasticMemory::default());
            prop_assert!(!force.is_nan() && force >= 0.0, "{law:?}");
        }
    }
}

#[test]
fn every_name_has_a_law() {
    let laws: [AnyContact; 3] = [
        Linear::new(1.0, 0.0).unwrap().into(),
        HertzMindlin::elastic(1.0, 1.0).unwrap().into(),
        ElasticPlastic::new(1.0, 1.0, 0.1).unwrap().into(),
    ];
    assert_eq!(laws.map(|law| law.model()), *ContactModel::ALL);
}
