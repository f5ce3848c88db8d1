//! Single collisions, integrated, against the restitution asked for and other exact results.
#![allow(clippy::unwrap_used)]

use pendular_contact::{Dashpot, ElasticPlastic, HertzMindlin, Linear, NormalContact, impact};

const BOTH: [Dashpot; 2] = [Dashpot::PushesOnly, Dashpot::MayPull];

#[test]
fn linear_rebounds_with_the_restitution_asked_for() {
    let mass = 3e-5;
    for dashpot in BOTH {
        for e in [1.0, 0.95, 0.8, 0.4351, 0.2, 0.05] {
            let law = Linear::from_restitution_with(1e4, e, mass, dashpot).unwrap();
            let time = law.contact_time(mass).unwrap();
            for speed in [1e-3, 2.0] {
                let rebound = impact(&law, mass, speed, time / 20_000.0).unwrap();
                assert!((rebound.restitution - e).abs() < 2e-5, "{dashpot:?} {e} {rebound:?}");
                assert!((rebound.duration / time - 1.0).abs() < 1e-3, "{dashpot:?} {e} {time}");
                assert!((law.restitution(mass).unwrap() - e).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn the_usual_dashpot_rebounds_more_when_it_may_not_pull() {
    // Schwager & Pöschel (2007): the cut contact ends early
    let mass = 1e-4;
    let damping = pendular_contact::dashpot(1e5, 0.4351, mass).unwrap();
    let cut = Linear::new(1e5, damping).unwrap();
    let step = cut.contact_time(mass).unwrap() / 20_000.0;
    let rebound = impact(&cut, mass, 0.3, step).unwrap().restitution;
    assert!((rebound - cut.restitution(mass).unwrap()).abs() < 2e-5);
    assert!(rebound > 0.49);
    let pulling = cut.with_dashpot(Dashpot::MayPull);
    let rebound = impact(&pulling, mass, 0.3, step).unwrap().restitution;
    assert!((rebound - 0.4351).abs() < 2e-5);
}

#[test]
fn hertz_rebounds_with_the_restitution_asked_for_at_every_speed() {
    let (modulus, radius, mass) = (3e9, 1e-3, 2e-5);
    let elastic = HertzMindlin::elastic(modulus, radius).unwrap();
    for dashpot in BOTH {
        for e in [0.95, 0.8, 0.5, 0.2] {
            let law = elastic.with_restitution(e, mass, dashpot).unwrap();
            for speed in [1e-3_f64, 0.1, 10.0] {
                let time = 2.87 * (mass * mass / (radius * modulus * modulus * speed)).powf(0.2);
                let rebound = impact(&law, mass, speed, time / 40_000.0).unwrap();
                let error = (rebound.restitution - e).abs();
                assert!(error < 1e-4, "{dashpot:?} {e} {speed} {rebound:?}");
            }
        }
    }
}

#[test]
fn hertz_without_dashpot_takes_the_published_time_and_depth() {
    // t = 2.8683 (m*²/(R* E*² v))^(1/5), δ = (15 m* v²/(16 E* √R*))^(2/5) (Johnson 1985, 11.1)
    let (modulus, radius, mass, speed) = (2e10_f64, 2e-3_f64, 1e-4_f64, 0.7_f64);
    let time = 2.8683 * (mass * mass / (radius * modulus * modulus * speed)).powf(0.2);
    let depth = (15.0 * mass * speed * speed / (16.0 * modulus * radius.sqrt())).powf(0.4);
    let law = HertzMindlin::elastic(modulus, radius).unwrap();
    let rebound = impact(&law, mass, speed, time / 20_000.0).unwrap();
    assert!((rebound.duration / time - 1.0).abs() < 1e-4);
    assert!((rebound.max_overlap / depth - 1.0).abs() < 1e-6);
    assert!((rebound.restitution - 1.0).abs() < 1e-6);
}

/// A lactose sphere of 0.2 mm on a rigid wall, and its mass.
fn lactose() -> (ElasticPlastic, f64) {
    let mass = 4.0 / 3.0 * std::f64::consts::PI * 1e-12 * 1540.0;
    (ElasticPlastic::new(2.5e9 / 0.96, 1e-4, 27e6).unwrap(), mass)
}

#[test]
fn an_impact_that_yields_gives_back_its_elastic_energy() {
    let (law, mass) = lactose();
    let yields = law.yield_speed(mass);
    for factor in [0.5, 0.99, 1.5, 10.0, 1e3] {
        let speed = factor * yields;
        let step = 1e-4 * (mass / law.stiffness(1e-6)).sqrt();
        let rebound = impact(&law, mass, speed, step).unwrap().restitution;
        let energy = law.restitution(mass, speed).unwrap();
        assert!((rebound - energy).abs() < 2e-4, "{factor} {rebound} {energy}");
    }
}

#[test]
fn rebound_falls_with_speed_and_with_the_power_of_its_elastic_energy() {
    let (law, mass) = lactose();
    let e = |factor: f64| law.restitution(mass, factor * law.yield_speed(mass)).unwrap();
    assert_eq!(e(1.0), 1.0);
    let speeds: Vec<f64> = (0..60).map(|k| 10f64.powf(0.2 * f64::from(k))).collect();
    for pair in speeds.windows(2) {
        assert!(e(pair[1]) < e(pair[0]), "{pair:?}");
    }
    // E_el ~ s^(5/3), W ~ s²: e ~ v^(−1/6)
    let exponent = (e(1e11) / e(1e10)).log10();
    assert!((exponent + 1.0 / 6.0).abs() < 1e-3, "{exponent}");
}

#[test]
fn yield_speed_is_thorntons() {
    // v_y = 3.194 (p_y⁵ R*³/(E*⁴ m*))^(1/2) (Thornton 1997)
    let (law, mass) = lactose();
    let group = 27e6_f64.powi(5) * 1e-12 / ((2.5e9_f64 / 0.96).powi(4) * mass);
    assert!((law.yield_speed(mass) / group.sqrt() - 3.194).abs() < 1e-3);
}

#[test]
fn bad_impacts_are_named() {
    let law = Linear::new(1.0, 0.0).unwrap();
    assert_eq!(impact(&law, 0.0, 1.0, 1.0).unwrap_err().quantity, "reduced mass");
    assert_eq!(impact(&law, 1.0, f64::NAN, 1.0).unwrap_err().quantity, "speed");
    assert_eq!(impact(&law, 1.0, 1.0, -1.0).unwrap_err().quantity, "time step");
}
