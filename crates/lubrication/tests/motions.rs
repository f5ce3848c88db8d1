//! Motions whose course is known in closed form, integrated numerically with the curves.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use pendular_lubrication::{
    Bridge, Gap, Mate, NormalCurve, NormalDrag, NormalModel, Overlap, Regularisation,
};

fn curve(gap: Gap, mate: Mate, model: NormalModel) -> impl NormalCurve {
    let bridge = Bridge::new(2e-3, mate, 1e-10, [0.0; 2], 0.07).unwrap();
    model.with(Regularisation { gap, overlap: Overlap::Fade }).curve(&bridge, 10.0).unwrap()
}

/// The gap after `time` under a constant push, without inertia: c_n dS/dt = −push. Runge-Kutta.
fn settle(curve: &impl NormalCurve, start: f64, push: f64, time: f64) -> f64 {
    let steps = 20_000;
    let h = time / f64::from(steps);
    let rate = |gap: f64| -push / curve.coefficient(gap);
    (0..steps).fold(start, |s, _| {
        let k1 = rate(s);
        let k2 = rate(s + 0.5 * h * k1);
        let k3 = rate(s + 0.5 * h * k2);
        let k4 = rate(s + h * k3);
        s + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    })
}

#[test]
fn a_sphere_settles_on_its_equal_as_in_yades_lubrication_check() {
    // gap = R exp(−8 R ρ g t/(9 η)), from a gap of one radius; Yade, checkLubrication
    let (radius, density, gravity, viscosity, time) = (2e-3, 2500.0, 9.81, 10.0, 3.0);
    let weight = 4.0 / 3.0 * PI * radius * radius * radius * density * gravity;
    let equal = Mate::Sphere { radius };
    let drag = curve(Gap::CutOff { length: 1e-12 }, equal, NormalModel::AdamsPerchard1985);
    let exact = radius * (-8.0 * radius * density * gravity * time / (9.0 * viscosity)).exp();
    assert!((settle(&drag, radius, weight, time) / exact - 1.0).abs() < 1e-9);
    // with roughness the same holds for S + s_r
    let s_r = 2e-6;
    let drag = curve(Gap::Roughness { length: s_r }, equal, NormalModel::AdamsPerchard1985);
    let left = settle(&drag, radius - s_r, weight, 1.0) + s_r;
    let exact = radius * (-8.0 * radius * density * gravity / (9.0 * viscosity)).exp();
    assert!((left / exact - 1.0).abs() < 1e-9);
}

#[test]
fn a_sphere_settles_on_a_plane_four_times_more_slowly() {
    // rate 2 R ρ g/(9 η)
    let (radius, density, gravity, viscosity, time) = (2e-3, 2500.0, 9.81, 10.0, 8.0);
    let weight = 4.0 / 3.0 * PI * radius * radius * radius * density * gravity;
    let gap = Gap::CutOff { length: 1e-12 };
    let drag = curve(gap, Mate::PLANE, NormalModel::AdamsPerchard1985);
    let exact = 1e-4 * (-2.0 * radius * density * gravity * time / (9.0 * viscosity)).exp();
    assert!((settle(&drag, 1e-4, weight, time) / exact - 1.0).abs() < 1e-9);
}

#[test]
fn a_free_sphere_stops_where_its_momentum_is_spent() {
    // m v = G(S_0) − G(S_stop): integrate m dv/dt = −c_n v until v is gone
    let mass = 8e-5;
    for model in NormalModel::ALL {
        for gap in [Gap::Roughness { length: 2e-6 }, Gap::CutOff { length: 2e-6 }] {
            let drag = curve(gap, Mate::PLANE, *model);
            // the fraction 0.6 of the momentum that reaches contact
            let start = 1e-4;
            let impulse = drag.impulse(start);
            let speed = 0.6 * impulse / mass;
            let accelerate = |s: f64, v: f64| -drag.coefficient(s) * v / mass;
            let (mut s, mut v, h) = (start, -speed, 1e-8);
            while v < -1e-9 * speed {
                // Runge-Kutta
                let (v1, a1) = (v, accelerate(s, v));
                let (v2, a2) = (v + 0.5 * h * a1, accelerate(s + 0.5 * h * v1, v + 0.5 * h * a1));
                let (v3, a3) = (v + 0.5 * h * a2, accelerate(s + 0.5 * h * v2, v + 0.5 * h * a2));
                let (v4, a4) = (v + h * a3, accelerate(s + h * v3, v + h * a3));
                s += h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
                v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
            }
            let spent = (impulse - drag.impulse(s)) / (mass * speed);
            assert!((spent - 1.0).abs() < 1e-6, "{model} {gap:?} {spent}");
        }
    }
}
