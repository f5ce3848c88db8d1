//! Single bridges pulled apart through the whole core: the force that the spheres feel, read from
//! the change of their momentum, is the law's.

use std::f64::consts::PI;

use pendular::{MeshWalls, SplitMethod};
use pendular_capillary::{AnyCapillary, AnyCurve, CapillaryLaw, ForceCurve, LawKind};
use pendular_dem_core::{Class, DVec3, NoWalls, Particles, Simulation};
use pendular_lubrication::{AnyNormalDrag, AnyTangentialDrag, Gap, NormalModel, TangentialModel};
use pendular_pair::{Bridge, Mate, Range};
use pendular_transfer::{AnyRupture, Dynamic, RuptureLaw, formation};
use pendular_walls::{Part, Plane, Shape, Walls};

use crate::rig;

/// A row of data/g14_table1.csv.
struct Case {
    name: String,
    radii: [f64; 2],
    tension: f64,
    angle: f64,
    volume: f64,
}

impl Case {
    fn bridge(&self) -> Bridge {
        self.with_volume(self.volume)
    }

    fn with_volume(&self, volume: f64) -> Bridge {
        let mate = Mate::Sphere { radius: self.radii[1] };
        Bridge::new(self.radii[0], mate, volume, [self.angle; 2], self.tension).unwrap()
    }
}

fn gladkyy() -> Vec<Case> {
    let case = |row: &std::collections::HashMap<String, String>| {
        let number = |key: &str| row[key].parse::<f64>().unwrap();
        Case {
            name: row["case"].clone(),
            radii: [number("radius_i"), number("radius_j")],
            tension: number("surface_tension"),
            angle: number("contact_angle_deg").to_radians(),
            volume: number("volume"),
        }
    };
    rig::table("g14_table1.csv").iter().map(case).collect()
}

/// Pulls the spheres of a case from contact beyond rupture and hands the law's curve, every gap and
/// every force, both from the particles alone, to `see`. Returns the films left behind.
fn pull(
    case: &Case,
    law: AnyCapillary,
    steps: u32,
    mut see: impl FnMut(&AnyCurve, f64, f64),
) -> Vec<f64> {
    let classes = case.radii.map(|r| Class::new(r, 2500.0, 0).unwrap());
    let [m, n] = classes.map(|class| class.mass());
    let bridge = case.bridge();
    let rupture = AnyRupture::Lian.distance(&bridge, Range::Extrapolate).unwrap();
    // Kinetic energy enough to break the bridge, momentum zero.
    let r = bridge.harmonic_radius();
    let energy = 6.0 * 2.0 * PI * r * case.tension * (2.0 * case.volume / (PI * r)).sqrt();
    let speed = (2.0 * energy * (m + n) / (m * n)).sqrt();
    let h = rupture / (speed * f64::from(steps));
    let particles = rig::two(classes, 0.0, [-speed * n / (m + n), speed * m / (m + n)]);
    let films = rig::films_for(case.volume, case.radii);
    let wet = rig::wet(
        rig::liquid(case.tension, 1e-3, case.angle),
        rig::static_laws(law),
        rig::bodies(&particles, None),
        films,
        SplitMethod::Half,
    );
    let mut simulation = Simulation::new(particles, wet, NoWalls, rig::weightless(h)).unwrap();
    // The bridge forms at the end of the first step and acts from the second on.
    simulation.advance(1).unwrap();
    assert_eq!(simulation.term().alive(), 1);
    let volume = simulation.term().ledger().in_bridges();
    assert!((volume / case.volume - 1.0).abs() < 1e-14, "{}: {volume:e}", case.name);
    // Of the volume as it is, to the last bit: at its fold the exact force shows even that.
    let curve = law.curve(&case.with_volume(volume), Range::Extrapolate).unwrap();
    let mut gap = 0.0;
    while gap < 1.1 * rupture {
        let before = [rig::at(&simulation, 0), rig::at(&simulation, 1)];
        gap = (before[1].position - before[0].position).length() - case.radii[0] - case.radii[1];
        simulation.advance(1).unwrap();
        let after = [rig::at(&simulation, 0), rig::at(&simulation, 1)];
        let force = m / h * (after[0].velocity.x - before[0].velocity.x);
        let reaction = -n / h * (after[1].velocity.x - before[1].velocity.x);
        assert!((force - reaction).abs() <= 1e-9 * force.abs(), "{}: {gap:e}", case.name);
        assert_eq!(simulation.term().alive(), u64::from(gap <= rupture), "{} {gap:e}", case.name);
        see(&curve, gap, force);
    }
    assert_eq!(simulation.term().ledger().in_bridges(), 0.0);
    simulation.term().ledger().films().to_vec()
}

#[test]
fn the_force_over_the_gap_is_the_laws_in_all_thirteen_cases_of_gladkyy() {
    let cases = gladkyy();
    assert_eq!(cases.len(), 13);
    for law in AnyCapillary::ALL {
        if law.info().kind == LawKind::SpherePlane {
            continue;
        }
        let mut compared = 0;
        for case in &cases {
            let bridge = case.bridge();
            let rupture = AnyRupture::Lian.distance(&bridge, Range::Extrapolate).unwrap();
            pull(case, law, 150, |curve, gap, force| {
                let expected = if gap > rupture { 0.0 } else { curve.force(gap) };
                compared += u32::from(gap <= rupture);
                let off = (force - expected).abs();
                let name = &case.name;
                assert!(
                    off <= 1e-9 * expected.abs().max(1e-2 * curve.force(0.0)),
                    "{law} {name} at {gap:e}: {force:e} for {expected:e}"
                );
                if gap > rupture {
                    assert_eq!(force, 0.0, "{law} {name}: a broken bridge pulls");
                }
            });
        }
        assert!(compared > 13 * 130, "{law}: only {compared} gaps");
    }
}

#[test]
fn a_broken_bridge_leaves_half_to_each_and_nothing_is_lost() {
    for case in gladkyy() {
        let films = rig::films_for(case.volume, case.radii);
        // Each gave half of the bridge and gets half of it back.
        let left = pull(&case, AnyCapillary::Lambert, 40, |_, _, _| ());
        for (before, after) in films.iter().zip(left) {
            assert!((after / before - 1.0).abs() < 1e-14, "{}", case.name);
        }
    }
}

/// In overlap the bridge pulls with 2 π R σ cos θ, beside what the contact does.
#[test]
fn the_contact_limit_of_lambert_is_felt_by_the_pair() {
    for case in gladkyy() {
        let classes = case.radii.map(|r| Class::new(r, 2500.0, 0).unwrap());
        let overlap = 1e-4 * case.radii[1];
        let particles = rig::two(classes, -overlap, [0.0; 2]);
        let [m, n] = classes.map(|class| class.mass());
        let r = case.bridge().harmonic_radius();
        let pull = 2.0 * PI * r * case.tension * case.angle.cos();
        // As stiff as to push half as hard as the bridge pulls.
        let stiffness = 0.5 * pull / overlap;
        let dry = rig::Rub { stiffness, restitution: 1.0, friction: 0.0, rolling: 0.0 };
        let contact = rig::contact(&classes, dry);
        let wet = rig::wet(
            rig::liquid(case.tension, 1e-3, case.angle),
            rig::static_laws(AnyCapillary::Lambert),
            rig::bodies(&particles, None),
            rig::films_for(case.volume, case.radii),
            SplitMethod::Half,
        );
        let h = 1e-3 * (m * n / (m + n) / stiffness).sqrt();
        let settings = rig::weightless(h);
        let mut simulation = Simulation::new(particles, (contact, wet), NoWalls, settings).unwrap();
        // First step: the contact alone, over half a step.
        simulation.advance(1).unwrap();
        let first = rig::at(&simulation, 0);
        let dry_force = 2.0 * m / h * first.velocity.x;
        assert!((dry_force / (-0.5 * pull) - 1.0).abs() < 1e-9, "{}", case.name);
        let distance = rig::at(&simulation, 1).position.x - first.position.x;
        simulation.advance(1).unwrap();
        let force = m / h * (rig::at(&simulation, 0).velocity.x - first.velocity.x);
        let spring = stiffness * (case.radii[0] + case.radii[1] - distance);
        assert!((force / (pull - spring) - 1.0).abs() < 1e-9, "{}: {force:e}", case.name);
    }
}

/// Elskamp & Kruggel-Emden (2018), Fig. 5a: F = 2 π σ r (cos θᵢ + cos θ_w)/(1 + S/d).
#[test]
fn sphere_and_plane_of_elskamp_through_a_wall() {
    for row in rig::table("e18_sphere_plane.csv") {
        let number = |key: &str| row[key].parse::<f64>().unwrap();
        let (r, tension, volume) = (number("radius"), number("surface_tension"), number("volume"));
        let angle = number("contact_angle_deg").to_radians();
        let class = Class::new(r, 2500.0, 0).unwrap();
        let bridge = Bridge::new(r, Mate::PLANE, volume, [angle; 2], tension).unwrap();
        let rupture = AnyRupture::Mikami.distance(&bridge, Range::Extrapolate).unwrap();
        let contact = 4.0 * PI * r * tension * angle.cos();
        let speed = (16.0 * contact * (volume / (PI * r)).sqrt() / class.mass()).sqrt();
        let plane = Plane::new(DVec3::new(1e-3, 0.0, 2e-3), DVec3::Z, 1e-4).unwrap();
        let walls = Walls::new(vec![Part::new("plane", Shape::Plane(plane))]).unwrap();
        let mut particles = Particles::new(vec![class]).unwrap();
        let start = DVec3::Z * (2e-3 + r);
        particles.push(0, start, speed * DVec3::Z, DVec3::ZERO).unwrap();
        let film = volume / formation::sphere_fraction(r, Mate::PLANE).unwrap();
        let laws = pendular::PairLaws {
            rupture: AnyRupture::Mikami,
            ..rig::static_laws(AnyCapillary::RabinovichPlane)
        };
        let liquid = rig::liquid(tension, 1e-3, angle);
        let bodies = rig::bodies(&particles, Some(&walls));
        let wet = rig::wet(liquid, laws, bodies, vec![film], SplitMethod::Half);
        let h = rupture / (200.0 * speed);
        let mut simulation =
            Simulation::new(particles, wet, MeshWalls(walls), rig::weightless(h)).unwrap();
        simulation.advance(1).unwrap();
        let (mut gap, mut seen) = (0.0, 0);
        while gap <= rupture {
            let before = rig::at(&simulation, 0);
            gap = before.position.z - 2e-3 - r;
            simulation.advance(1).unwrap();
            let after = rig::at(&simulation, 0);
            let force = -class.mass() / h * (after.velocity.z - before.velocity.z);
            if gap > rupture {
                assert_eq!(force, 0.0);
                break;
            }
            let d = -gap + (gap * gap + volume / (PI * r)).sqrt();
            let expected = contact / (1.0 + gap / d);
            // The gap is a difference of coordinates of 2 mm: 1e-13 of it is left.
            assert!((force / expected - 1.0).abs() < 1e-8, "{gap:e}: {force:e} {expected:e}");
            seen += 1;
        }
        assert!(seen > 150, "{seen}");
        // What the wall got is on its element.
        let ledger = simulation.term().ledger();
        assert!((ledger.walls()[0] / (0.5 * volume) - 1.0).abs() < 1e-12);
        assert!(ledger.imbalance().abs() < 1e-14);
    }
}

/// Elskamp & Kruggel-Emden (2018), Fig. 5b after Pitois et al.: capillary and viscous force of a
/// pair that separates, eq. (26) written out, and the rupture put off by 1 + √Ca.
#[test]
fn the_viscous_bridge_of_pitois_at_three_speeds() {
    let given = rig::toml("e18_viscous.toml");
    let number = |key: &str| given[key].as_float().unwrap();
    let (r, tension, viscosity) =
        (number("radius"), number("surface_tension"), number("viscosity"));
    let (volume, angle) = (number("volume"), number("contact_angle_deg").to_radians());
    let bridge = Bridge::new(r, Mate::Sphere { radius: r }, volume, [angle; 2], tension).unwrap();
    let pulled = AnyCapillary::Lambert.curve(&bridge, Range::Strict).unwrap();
    let length = 1e-3 * r;
    let near = Gap::Roughness { length }.into();
    for speed in [1e-4, 1e-3, 1e-2] {
        // So heavy that liquid takes about 1 % of the speed: the pull is one at constant speed.
        let work = 2.0 * PI * r * tension * (2.0 * volume / (PI * r)).sqrt();
        let impulse = 6.0 * PI * viscosity * 0.25 * r * r * 5.0;
        let reduced = 100.0 * (work / (0.5 * speed * speed)).max(impulse / speed);
        let density = 2.0 * reduced / (4.0 / 3.0 * PI * r.powi(3));
        let class = Class::new(r, density, 0).unwrap();
        let mut laws = rig::viscous_laws(
            AnyCapillary::Lambert,
            NormalModel::Pitois2000.with(near),
            TangentialModel::Popov2010.with(near),
        );
        laws.dynamic = Dynamic::Pitois2001 { viscosity };
        let _: (AnyNormalDrag, AnyTangentialDrag) = (laws.normal, laws.tangential);
        let particles = rig::two([class; 2], 0.0, [-0.5 * speed, 0.5 * speed]);
        let wet = rig::wet(
            rig::liquid(tension, viscosity, angle),
            laws,
            rig::bodies(&particles, None),
            rig::films_for(volume, [r; 2]),
            SplitMethod::Parabola,
        );
        let rupture = AnyRupture::Lian.distance(&bridge, Range::Strict).unwrap();
        let h = rupture / (300.0 * speed);
        let mut simulation = Simulation::new(particles, wet, NoWalls, rig::weightless(h)).unwrap();
        simulation.advance(1).unwrap();
        let mut broke = None;
        for _ in 0..500 {
            let before = [rig::at(&simulation, 0), rig::at(&simulation, 1)];
            let gap = (before[1].position - before[0].position).length() - 2.0 * r;
            let rate = before[1].velocity.x - before[0].velocity.x;
            simulation.advance(1).unwrap();
            let force =
                class.mass() / h * (rig::at(&simulation, 0).velocity.x - before[0].velocity.x);
            if force == 0.0 {
                broke.get_or_insert((gap, rate));
                continue;
            }
            assert!(broke.is_none());
            let s = gap + length;
            let x = 1.0 - 1.0 / (1.0 + 2.0 * volume / (PI * r * s * s)).sqrt();
            let viscous = 1.5 * PI * viscosity * r * r * x * x / s * rate;
            let expected = pulled.force(gap) + viscous;
            assert!((force / expected - 1.0).abs() < 1e-8, "{speed} {gap:e}: {force} {expected}");
        }
        let (gap, rate) = broke.unwrap();
        let late = rupture * (1.0 + (rate * viscosity / tension).sqrt());
        assert!(gap > late && gap - late < 1.01 * speed * h, "{speed}: {gap:e} {late:e}");
    }
}
