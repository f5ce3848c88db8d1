//! Where methods and laws fail: the rows of `docs/failure-modes.md` that no crate tests on its own.

use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use pendular::SplitMethod;
use pendular_capillary::{AnyCapillary, CapillaryLaw, ForceCurve, young_laplace};
use pendular_dem_core::{Class, NoWalls, Particles, Simulation};
use pendular_lubrication::{NormalModel, Regularisation, TangentialModel};
use pendular_pair::{Bridge, Mate, Range};

use crate::rig::{self, AnyWet, Rub};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// All Rust sources below a folder of the workspace.
fn sources(folder: &Path, all: &mut String) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            if path.file_name().is_some_and(|name| name != "target") {
                sources(&path, all);
            }
        } else if path.extension().is_some_and(|end| end == "rs") {
            all.push_str(&std::fs::read_to_string(&path).unwrap());
        }
    }
}

/// Names of all functions that are tests, of plain ones and of those in `proptest!`.
fn tests() -> BTreeSet<String> {
    let mut all = String::new();
    for folder in ["crates", "examples", "tests"] {
        sources(&root().join(folder), &mut all);
    }
    let mut names = BTreeSet::new();
    for after in all.split("#[test]").skip(1) {
        let name = after.split("fn ").nth(1).and_then(|rest| rest.split('(').next());
        names.extend(name.map(|name| name.trim().to_string()));
    }
    names
}

#[test]
fn every_row_of_the_catalogue_has_a_test_that_exists() {
    let text = std::fs::read_to_string(root().join("docs/failure-modes.md")).unwrap();
    let known = tests();
    let rows = text.lines().filter(|line| line.starts_with('|') && !line.starts_with("|--"));
    let mut seen = 0;
    for row in rows.filter(|row| !row.contains("| tests |")) {
        let cells: Vec<_> = row.trim_matches('|').split(" | ").collect();
        assert_eq!(cells.len(), 4, "{row}");
        let names: Vec<_> = cells[3].split('`').skip(1).step_by(2).collect();
        assert!(!names.is_empty(), "no test: {row}");
        for name in names {
            assert!(known.contains(name), "no test `{name}`: {row}");
        }
        seen += 1;
    }
    assert!(seen >= 25, "{seen} rows");
}

fn equal(v_star: f64, angle: f64) -> Bridge {
    Bridge::new(1.0, Mate::Sphere { radius: 1.0 }, v_star, [angle; 2], 1.0).unwrap()
}

/// Force over the exact one at half of the exact rupture distance.
fn off(law: AnyCapillary, bridge: &Bridge) -> f64 {
    let gap = 0.5 * young_laplace::rupture(bridge).unwrap().distance;
    let exact = young_laplace::solve(bridge, gap).unwrap().force;
    law.force(bridge, gap, Range::Extrapolate).unwrap() / exact - 1.0
}

#[test]
fn rabinovich_is_far_off_at_large_volumes_and_says_so() {
    assert!(off(AnyCapillary::Rabinovich, &equal(1e-3, 0.0)).abs() < 0.2);
    let large = equal(0.5, 0.6);
    assert!(off(AnyCapillary::Rabinovich, &large).abs() > 0.25);
    assert!(AnyCapillary::Rabinovich.force(&large, 0.1, Range::Strict).is_err());
}

#[test]
fn the_exponent_of_soulie_leaves_a_constant_to_tiny_bridges() {
    // a S/r = −1.1 v^−0.53 S/r: the bridge reaches v^(1/3), so that the exponent at rupture goes with
    // v^−0.2. At v = 1e-8 the exponential is gone halfway and the constant c, which falls with no
    // gap, is several times the exact force.
    let exact = |bridge: &Bridge, gap: f64| young_laplace::solve(bridge, gap).unwrap().force;
    let share = |v: f64| {
        let bridge = equal(v, 0.0);
        let gap = 0.5 * v.cbrt();
        let law = AnyCapillary::Soulie;
        law.force(&bridge, gap, Range::Extrapolate).unwrap() / exact(&bridge, gap)
    };
    assert!((share(1e-2) - 1.0).abs() < 0.15, "{}", share(1e-2));
    assert!(share(1e-8) > 3.0, "{}", share(1e-8));
    assert!(AnyCapillary::Soulie.force(&equal(1e-8, 0.0), 0.0, Range::Strict).is_err());
}

/// Laws of two spheres take the harmonic radius 2 r_i r_j/(r_i + r_j), which is 2 r at a plane. Codes
/// that put r there, or the reduced radius between spheres, have half the force.
#[test]
fn the_wrong_effective_radius_halves_the_force() {
    let (r, tension, angle) = (1e-3, 0.07, 0.3_f64);
    let volume = 1e-5 * r * r * r;
    let plane = Bridge::new(r, Mate::PLANE, volume, [angle; 2], tension).unwrap();
    let unequal = Mate::Sphere { radius: 3.0 * r };
    let unequal = Bridge::new(r, unequal, volume, [angle; 2], tension).unwrap();
    for (bridge, radius) in [(plane, 2.0 * r), (unequal, 1.5 * r)] {
        let limit = 2.0 * PI * tension * radius * angle.cos();
        // The exact bridge knows no effective radius. Its deficit goes with the fourth root of V*.
        let exact = young_laplace::solve(&bridge, 0.0).unwrap().force;
        assert!((exact / limit - 1.0).abs() < 0.03, "{exact:e} {limit:e}");
        assert!((bridge.harmonic_radius() / radius - 1.0).abs() < 1e-12);
        assert!((bridge.reduced_radius() / radius - 0.5).abs() < 1e-12);
        let laws = AnyCapillary::ALL.into_iter();
        let mut seen = 0;
        for law in laws.filter(|law| law.validity().check(&bridge).is_ok()) {
            let force = law.force(&bridge, 0.0, Range::Strict).unwrap();
            assert!(force > 0.8 * limit && force < 1.2 * limit, "{law}: {force:e} {limit:e}");
            seen += 1;
        }
        assert!(seen >= 2, "{seen} laws");
    }
}

/// dF/dS by differences on a fine grid from contact to rupture: finite, and without a jump of the
/// force. At contact laws with √S fall with infinite slope, so the grid is even in √S.
#[test]
fn the_stiffness_of_every_law_is_finite_and_its_force_without_a_step() {
    for law in AnyCapillary::ALL {
        for bridge in law.examples() {
            let curve = law.curve(&bridge, Range::Strict).unwrap();
            let end = 0.95 * young_laplace::rupture(&bridge).unwrap().distance;
            let contact = curve.force(0.0).abs();
            let at = |k: u32, n: u32| end * (f64::from(k) / f64::from(n)).powi(2);
            let steepest = |n: u32| {
                let step = |k| (curve.force(at(k + 1, n)) - curve.force(at(k, n))).abs();
                (0..n).map(step).fold(0.0, f64::max) / contact
            };
            // A jump stays on a finer grid; a slope is divided.
            let (coarse, fine) = (steepest(1000), steepest(8000));
            assert!(fine < 0.2 * coarse + 1e-6, "{law}: {coarse:e} {fine:e} of {bridge:?}");
            for k in 1..1000 {
                let (low, high) = (at(k, 1000), at(k + 1, 1000));
                let slope = (curve.force(high) - curve.force(low)) / (high - low);
                assert!(slope.is_finite(), "{law} at {low:e}");
            }
        }
    }
}

type Run =
    Simulation<(pendular_dem_core::Contact<pendular_contact::Linear>, Option<AnyWet>), NoWalls>;

/// Two equal spheres with a bridge, held by nothing.
fn pair(gap: f64, volume: f64, law: AnyCapillary, friction: f64) -> Run {
    let class = Class::new(1e-3, 2500.0, 0).unwrap();
    let particles: Particles = rig::two([class; 2], gap, [0.0; 2]);
    let rub = Rub { stiffness: 1e4, restitution: 0.5, friction, rolling: 0.0 };
    let near = Regularisation::default();
    let laws = rig::viscous_laws(
        law,
        NormalModel::Pitois2000.with(near),
        TangentialModel::Popov2010.with(near),
    );
    let films = rig::films_for(volume, [1e-3; 2]);
    let bodies = rig::bodies(&particles, None);
    let wet = rig::wet(rig::liquid(0.07, 1e-6, 0.3), laws, bodies, films, SplitMethod::Half);
    let contact = rig::contact(particles.classes(), rub);
    Simulation::new(particles, (contact, Some(wet)), NoWalls, rig::weightless(1e-6)).unwrap()
}

/// Lambert's form integrates in closed form:
/// `∫₀^S F dS = 2 π σ R cos θ (S − √(S² + a²) + a)`, a² = 2 V/(π R).
#[test]
fn the_energy_of_a_bridge_is_the_integral_of_its_force() {
    let (r, volume, tension, angle) = (1e-3_f64, 2e-12, 0.07, 0.3_f64);
    let mut run = pair(1e-7, volume, AnyCapillary::Lambert, 0.0);
    run.advance(1).unwrap();
    let wet = run.term().1.as_ref().unwrap();
    let live = wet.live(0).unwrap();
    let a = (2.0 * live.bridge.volume() / (PI * r)).sqrt();
    let scale = 2.0 * PI * tension * r * angle.cos();
    let integral = |s: f64| scale * (s - s.hypot(a) + a);
    let rupture = (1.0 + 0.5 * angle) * live.bridge.volume().cbrt();
    for share in [0.0, 1e-4, 0.01, 0.1, 0.5, 0.9] {
        let gap = share * rupture;
        let energy = wet.energy_of(0, gap).unwrap();
        let exact = integral(gap) - integral(rupture);
        assert!((energy / exact - 1.0).abs() < 1e-6, "{share}: {energy:e} {exact:e}");
    }
    // In overlap the force is that of contact.
    let deep = wet.energy_of(0, -1e-6).unwrap() - wet.energy_of(0, 0.0).unwrap();
    assert!((deep / (-1e-6 * scale) - 1.0).abs() < 1e-9);
}

/// A pair that its bridge holds together, nothing else pressing: the contact repels with what the
/// bridge pulls, and Coulomb's limit is μ times that. A code that takes the sum of both, zero, has no
/// friction in a wet heap.
#[test]
fn a_bridge_gives_a_contact_its_friction() {
    let (volume, friction) = (2e-12, 0.3);
    let mut run = pair(1e-7, volume, AnyCapillary::Lambert, friction);
    // To rest: the dashpot takes the fall into contact within a few collision times.
    run.advance(20_000).unwrap();
    let mut seen = 0;
    run.survey(|pair, (spring, hold)| {
        let (contact, wet) = run.term();
        let bridge = wet.as_ref().unwrap().forces(hold.bridge().unwrap(), pair).unwrap();
        let sliding = pendular_dem_core::Pair {
            slip: pendular_dem_core::DVec3::Y * 10.0,
            separation_speed: 0.0,
            ..*pair
        };
        let forces = contact.forces(&sliding, spring);
        assert!((forces.normal / bridge.capillary - 1.0).abs() < 1e-3, "{forces:?} {bridge:?}");
        let limit = friction * bridge.capillary;
        assert!((forces.tangential.length() / limit - 1.0).abs() < 1e-3, "{forces:?}");
        seen += 1;
    });
    assert_eq!(seen, 1);
}

/// A sphere sinks on lubrication, d ln(S + s_r)/dt = −W/K. A sweep that damps the velocity exactly,
/// v e^(−g) with g = h K/(m (S + s_r)), after the kick of the weight, freezes it; a backward Euler
/// impulse does not.
#[test]
fn one_exponential_sweep_freezes_settling() {
    let (mass, weight, drag, roughness, h) = (1e-5, 1e-4, 0.05, 2e-6, 4e-6);
    let sink = |exponential: bool, steps: u32| {
        let (mut clearance, mut speed) = (10.0 * roughness, 0.0);
        for _ in 0..steps {
            let g = h * drag / (mass * clearance);
            let kicked: f64 = speed + h * weight / mass;
            speed = if exponential { kicked * f64::exp(-g) } else { kicked / (1.0 + g) };
            clearance -= h * speed;
        }
        (clearance / (10.0 * roughness)).ln() / (f64::from(steps) * h)
    };
    let exact = -weight / drag;
    // g = 1e3 from the start: nothing moves.
    assert!((sink(false, 200_000) / exact - 1.0).abs() < 0.01, "{}", sink(false, 200_000));
    assert!(sink(true, 200_000) / exact < 1e-6, "{}", sink(true, 200_000));
}
