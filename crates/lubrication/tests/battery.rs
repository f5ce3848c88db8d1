//! Promises of every drag law, for bridges and motions drawn at random.
#![allow(clippy::unwrap_used)]

use pendular_lubrication::{
    AnyNormalDrag, AnyTangentialDrag, Bridge, Gap, Mate, NormalCurve, NormalDrag, NormalModel,
    Overlap, Regularisation, Resistance, TangentialCurve, TangentialDrag, TangentialModel,
};
use proptest::prelude::*;

type Vector = [f64; 3];

/// Deep in overlap the fade leaves the range where f64 keeps its digits.
const TINY: f64 = 1e-290;

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn sum(a: Vector, b: Vector, factor: f64) -> Vector {
    [a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]]
}

fn scaled(a: Vector, factor: f64) -> Vector {
    a.map(|component| component * factor)
}

fn near() -> impl Strategy<Value = Regularisation> {
    let gap = prop_oneof![
        (-9.0..-5.0).prop_map(|x| Gap::Roughness { length: 10f64.powf(x) }),
        (-5.0..-1.0).prop_map(|x| Gap::RelativeRoughness { fraction: 10f64.powf(x) }),
        (-9.0..-5.0).prop_map(|x| Gap::CutOff { length: 10f64.powf(x) }),
    ];
    let overlap = prop_oneof![Just(Overlap::Fade), Just(Overlap::Full), Just(Overlap::Off)];
    (gap, overlap).prop_map(|(gap, overlap)| Regularisation { gap, overlap })
}

fn bridge() -> impl Strategy<Value = Bridge> {
    let mate = prop_oneof![(-5.0..-1.0).prop_map(Some), Just(None)];
    (-5.0..-1.0, mate, -7.0..0.5).prop_map(|(radius, mate, v_star)| {
        let radius = 10f64.powf(radius);
        let mate = mate.map_or(Mate::PLANE, |x| Mate::Sphere { radius: 10f64.powf(x) });
        let volume = 10f64.powf(v_star) * radius.powi(3);
        Bridge::new(radius, mate, volume, [0.3, 0.9], 0.07).unwrap()
    })
}

/// A gap of either sign, from 1e-10 m to 1 m.
fn gap() -> impl Strategy<Value = f64> {
    (-10.0..0.0, any::<bool>()).prop_map(|(x, out)| if out { 1.0 } else { -1.0 } * 10f64.powf(x))
}

fn vector() -> impl Strategy<Value = Vector> {
    prop::array::uniform3(-1.0..1.0)
}

/// Velocities and spins of both bodies, m/s and rad/s.
#[derive(Debug, Clone, Copy)]
struct Motion {
    velocities: [Vector; 2],
    spins: [Vector; 2],
}

/// Force on body i and torques on both, as a DEM code applies a resistance.
fn load(
    r: Resistance,
    b: &Bridge,
    n: Vector,
    levers: [f64; 2],
    m: Motion,
) -> (Vector, [Vector; 2]) {
    let relative = sum(m.velocities[0], m.velocities[1], -1.0);
    let across = sum(relative, n, -dot(relative, n));
    let arms = sum(scaled(m.spins[0], levers[0]), m.spins[1], levers[1]);
    let slip = sum(across, cross(arms, n), 1.0);
    let radius = b.reduced_radius();
    let rolling = scaled(cross(sum(m.spins[0], m.spins[1], -1.0), n), radius);
    let force = scaled(sum(scaled(slip, r.slip), rolling, r.coupling), -1.0);
    let turning = scaled(sum(scaled(slip, r.coupling), rolling, r.rolling), -radius);
    let of_force = cross(n, force);
    let of_turning = cross(n, turning);
    let on = |lever, sign| sum(scaled(of_force, lever), of_turning, sign);
    (force, [on(levers[0], 1.0), on(levers[1], -1.0)])
}

/// Lever arms that add up to the distance of the centres; the wall of a bridge has none.
fn levers(b: &Bridge, gap: f64) -> [f64; 2] {
    match b.mate() {
        Mate::Wall { .. } => [b.radius(), 0.0],
        Mate::Sphere { radius } => {
            let share = b.radius() / (b.radius() + radius);
            [b.radius() + gap * share, radius + gap * (1.0 - share)]
        }
    }
}

proptest! {
    #[test]
    fn normal_drag_is_a_coefficient(b in bridge(), near in near(), gap in gap(), eta in -4.0..3.0) {
        let eta = 10f64.powf(eta);
        for model in NormalModel::ALL {
            let curve = model.with(near).curve(&b, eta).unwrap();
            let c = curve.coefficient(gap);
            prop_assert!(c.is_finite() && c >= 0.0);
            // linear in the viscosity, falling with the gap, finite at contact
            let double = model.with(near).curve(&b, 2.0 * eta).unwrap();
            prop_assert!((double.coefficient(gap) - 2.0 * c).abs() <= 1e-14 * c + TINY);
            prop_assert!(curve.coefficient(gap.abs() * 1.1) <= curve.coefficient(gap.abs()));
            prop_assert!(c <= curve.coefficient(0.0) && curve.coefficient(0.0).is_finite());
            // no seam at contact when it fades
            if near.overlap != Overlap::Off {
                let (below, above) = (curve.coefficient(-1e-20), curve.coefficient(1e-20));
                prop_assert!((below / above - 1.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn impulse_is_the_integral_of_the_coefficient(b in bridge(), near in near(), to in gap()) {
        for model in NormalModel::ALL {
            let curve = model.with(near).curve(&b, 1.0).unwrap();
            let numerical = integral(&curve, near.contact_clearance(&b).unwrap(), to);
            let k = curve.coefficient(0.0) * near.contact_clearance(&b).unwrap();
            let error = (curve.impulse(to) - numerical).abs();
            // closed form: rounding of K ln, K = 6 π η R*² ≥ k
            let rounding = 1e-14 * 6.0 * std::f64::consts::PI * b.reduced_radius().powi(2);
            let allowed = rounding + 1e-8 * (k + numerical.abs());
            prop_assert!(error <= allowed, "{error} {k} {numerical}");
            let ([impulse, drag], c) = (curve.charge(to), curve.coefficient(to));
            prop_assert_eq!(impulse, curve.impulse(to));
            // far in overlap to rounding of that at contact
            let allowed = 1e-12 * c + 1e-15 * curve.coefficient(0.0) + TINY;
            prop_assert!((drag - c).abs() <= allowed, "{drag} {c}");
        }
    }

    #[test]
    fn tangential_drag_only_takes_energy(
        b in bridge(), near in near(), gap in gap(), n in vector(),
        motion in (vector(), vector(), vector(), vector()), spin in -8.0..8.0,
    ) {
        prop_assume!(dot(n, n) > 1e-4);
        let n = scaled(n, 1.0 / dot(n, n).sqrt());
        let levers = levers(&b, gap);
        let spin = 10f64.powf(spin);
        let spins = [scaled(motion.2, spin), scaled(motion.3, spin)];
        let m = Motion { velocities: [motion.0, motion.1], spins };
        for model in TangentialModel::ALL {
            let r = model.with(near).curve(&b, 0.7).unwrap().resistance(gap);
            prop_assert!(r.slip >= 0.0 && r.rolling >= 0.0);
            prop_assert!(r.slip * r.rolling >= r.coupling * r.coupling * (1.0 - 1e-12) - TINY);
            prop_assert!((r.slip + r.rolling).is_finite());
            let (force, torques) = load(r, &b, n, levers, m);
            let relative = sum(m.velocities[0], m.velocities[1], -1.0);
            let work = [dot(force, relative), dot(torques[0], m.spins[0]), dot(torques[1], m.spins[1])];
            let scale: f64 = work.iter().map(|w| w.abs()).sum();
            prop_assert!(work.iter().sum::<f64>() <= 1e-9 * scale + TINY, "{work:?}");
        }
    }

    #[test]
    fn rigid_rotation_of_a_pair_is_untouched(
        b in bridge(), near in near(), gap in gap(), n in vector(), spin in vector(),
    ) {
        prop_assume!(dot(n, n) > 1e-4);
        let n = scaled(n, 1.0 / dot(n, n).sqrt());
        let gap = gap.max(-0.1 * b.reduced_radius());
        let arms = levers(&b, gap);
        // centre j lies at (l_i + l_j) n from centre i
        let velocity = cross(spin, scaled(n, arms[0] + arms[1]));
        let m = Motion { velocities: [[0.0; 3], velocity], spins: [spin; 2] };
        for model in TangentialModel::ALL {
            let r = model.with(near).curve(&b, 0.7).unwrap().resistance(gap);
            let (force, torques) = load(r, &b, n, arms, m);
            let speed = dot(velocity, velocity).sqrt();
            prop_assert!(dot(force, force).sqrt() <= 1e-12 * (r.slip + r.coupling.abs()) * speed);
            for torque in torques {
                let scale = (r.slip + r.coupling.abs()) * (arms[0] + arms[1]) * speed;
                prop_assert!(dot(torque, torque).sqrt() <= 1e-12 * scale);
            }
        }
    }

    #[test]
    fn the_order_of_two_spheres_does_not_matter(b in bridge(), near in near(), gap in gap()) {
        let Some(other) = b.swapped() else { return Ok(()) };
        for model in TangentialModel::ALL {
            let curve = |b: &Bridge| model.with(near).curve(b, 0.7).unwrap().resistance(gap);
            // exchange turns u into −u and leaves q: B changes sign
            let (r, s) = (curve(&b), curve(&other));
            let close = |x: f64, y: f64| (x - y).abs() <= 1e-9 * r.slip;
            prop_assert!(close(r.slip, s.slip) && close(r.rolling, s.rolling));
            prop_assert!(close(r.coupling, -s.coupling));
        }
    }

    #[test]
    fn any_finite_numbers_get_a_finite_answer_or_a_typed_error(
        radius in any::<f64>(), mate in any::<f64>(), volume in any::<f64>(), eta in any::<f64>(),
        length in any::<f64>(), gap in any::<f64>(), kind in 0..3, plane in any::<bool>(),
    ) {
        prop_assume!(gap.is_finite());
        let (volume, radius) = (volume.abs(), radius.abs());
        let mate = if plane { Mate::PLANE } else { Mate::Sphere { radius: mate.abs() } };
        let Ok(b) = Bridge::new(radius, mate, volume, [0.0; 2], 1.0) else { return Ok(()) };
        let gap_rule = [
            Gap::Roughness { length: length.abs() },
            Gap::RelativeRoughness { fraction: length.abs() },
            Gap::CutOff { length: length.abs() },
        ][usize::try_from(kind).unwrap()];
        for model in NormalModel::ALL {
            let law: AnyNormalDrag = model.with(gap_rule.into());
            if let Ok(curve) = law.curve(&b, eta) {
                let c = curve.coefficient(gap);
                prop_assert!(c >= 0.0 && c.is_finite());
                prop_assert!(!curve.impulse(gap).is_nan());
            }
        }
        for model in TangentialModel::ALL {
            let law: AnyTangentialDrag = model.with(gap_rule.into());
            if let Ok(curve) = law.curve(&b, eta) {
                let r = curve.resistance(gap);
                prop_assert!(r.slip >= 0.0 && r.rolling >= 0.0);
                prop_assert!((r.slip + r.rolling + r.coupling).is_finite());
            }
        }
    }
}

/// ∫ c_n dS from 0 to `to` by Simpson's rule in t, S = ±s(0) (e^t − 1), split where a cut-off ends.
fn integral(curve: &impl NormalCurve, clearance: f64, to: f64) -> f64 {
    let sign = to.signum();
    let piece = |from: f64, to: f64| {
        let (a, b) = ((from / clearance).ln_1p(), (to / clearance).ln_1p());
        let panels = 4000;
        let step = (b - a) / f64::from(panels);
        let value = |k: i32| {
            let t = a + step * f64::from(k);
            // one-sided at the ends, where the coefficient may have a kink or jump
            let gap = (clearance * t.exp_m1()).clamp(from * (1.0 + 1e-15), to);
            let gap = if gap == 0.0 { sign * f64::MIN_POSITIVE } else { sign * gap };
            curve.coefficient(gap) * clearance * t.exp()
        };
        let inner: f64 = (1..panels).map(|k| if k % 2 == 1 { 4.0 } else { 2.0 } * value(k)).sum();
        (value(0) + inner + value(panels)) * step / 3.0
    };
    let end = to.abs();
    let split = end.min(clearance);
    sign * (piece(0.0, split) + if end > split { piece(split, end) } else { 0.0 })
}
