//! A wet pair through the whole core: collisions, energy, momentum, settling.

use std::f64::consts::PI;

use pendular::{NoDrag, SplitMethod, Wet};
use pendular_capillary::AnyCapillary;
use pendular_contact::{Dashpot, Linear};
use pendular_dem_core::{
    Class, Contact, DVec3, Encounter, Load, NoWalls, Pair, PairContact, PairTerm, Particle,
    Particles, Simulation, StabilityLoad, TermError, Visits,
};
use pendular_lubrication::{
    AdamsPerchard1985, Gap, NormalCurve, NormalDrag, NormalModel, Overlap, Regularisation,
    TangentialModel,
};
use pendular_pair::{Bridge, OutOfRange};

use crate::rig::{self, NoPull, Weight};

/// MercuryDPM's lubrication: 6 π η R*²/S above R*/100, nothing below.
#[derive(Debug, Clone, Copy)]
struct ZeroBelow {
    strength: f64,
    least: f64,
}

impl NormalDrag for ZeroBelow {
    type Curve = Self;

    fn curve(&self, bridge: &Bridge, viscosity: f64) -> Result<Self, OutOfRange> {
        let r = bridge.reduced_radius();
        Ok(Self { strength: 6.0 * PI * viscosity * r * r, least: 0.01 * r })
    }
}

impl NormalCurve for ZeroBelow {
    fn coefficient(&self, gap: f64) -> f64 {
        if gap > self.least { self.strength / gap } else { 0.0 }
    }

    fn impulse(&self, gap: f64) -> f64 {
        self.strength * (gap / self.least).max(1.0).ln()
    }
}

/// A liquid whose bridges form where bodies touch, not where films do.
#[derive(Debug)]
struct FormsOnTouch<T>(T);

impl<T: PairTerm> PairTerm for FormsOnTouch<T> {
    type Column = T::Column;

    fn reach(&self) -> f64 {
        self.0.reach()
    }

    fn idle(&self, encounter: &Encounter, column: &mut T::Column) -> bool {
        (encounter.gap >= 0.0 && !self.0.live(column)) || self.0.idle(encounter, column)
    }

    fn load(&self, pair: &Pair, column: &mut T::Column) -> Load {
        self.0.load(pair, column)
    }

    fn live(&self, column: &T::Column) -> bool {
        self.0.live(column)
    }

    fn settle(&mut self, visits: &mut impl Visits<T::Column>) -> Result<(), TermError> {
        self.0.settle(visits)
    }

    fn stability(&self, classes: &[Class]) -> Vec<StabilityLoad> {
        self.0.stability(classes)
    }
}

/// MercuryDPM's self test of two wet spheres that collide head-on: contact, capillary force,
/// lubrication, formation and rupture in one run. Its velocity Verlet takes forces with the
/// velocity of the half step: the same recurrence as the leapfrog here, whose full-step velocity
/// is the mean of two half steps.
#[test]
fn the_wet_collision_of_mercury_dpm() {
    let given = rig::toml("mercurydpm_wet_collision.toml");
    let number = |key: &str| given[key].as_float().unwrap();
    let class = Class::new(number("radius"), number("density"), 0).unwrap();
    let centres = given["centres"].as_array().unwrap();
    let mut particles = Particles::new(vec![class]).unwrap();
    for (centre, sign) in centres.iter().zip([1.0, -1.0]) {
        let x = centre.as_float().unwrap() * DVec3::X;
        particles.push(0, x, sign * number("speed") * DVec3::X, DVec3::ZERO).unwrap();
    }
    let spring = Linear::new(number("stiffness"), number("damping")).unwrap();
    let normal = spring.with_dashpot(Dashpot::MayPull);
    let law = PairContact { normal, friction: 0.0, rolling_friction: 0.0, tangential_damping: 0.0 };
    let contact = Contact::new(&[class], 0, move |_, _| law, |_, _| law);
    let volume = number("bridge_volume");
    let wet = rig::wet(
        rig::liquid(
            number("surface_tension"),
            number("viscosity"),
            number("contact_angle_deg").to_radians(),
        ),
        rig::viscous_laws(
            AnyCapillary::WillettReduced,
            ZeroBelow { strength: 0.0, least: 1.0 },
            NoDrag,
        ),
        rig::bodies(&particles, None),
        rig::films_for(volume, [number("radius"); 2]),
        SplitMethod::Half,
    );
    let settings = rig::weightless(number("time_step"));
    let terms = (contact, FormsOnTouch(wet));
    let mut simulation = Simulation::new(particles, terms, NoWalls, settings).unwrap();
    let mut frames = 0;
    for frame in given["speed_after"].as_array().unwrap() {
        let step = frame["step"].as_integer().unwrap() as u64;
        simulation.advance(step - simulation.step()).unwrap();
        let before = [0, 1].map(|id| rig::at(&simulation, id).velocity.x);
        simulation.advance(1).unwrap();
        let after = [0, 1].map(|id| rig::at(&simulation, id).velocity.x);
        let expected = frame["speed"].as_float().unwrap();
        for k in 0..2 {
            let speed = 0.5 * (before[k] + after[k]).abs();
            assert!((speed - expected).abs() < 2e-10, "step {step}: {speed} for {expected}");
        }
        frames += 1;
    }
    assert_eq!(frames, 6);
    let counts = simulation.term().1.0.counts();
    assert_eq!((counts.formed, counts.ruptured), (1, 1));
}

/// Two unequal wet spheres that pass each other obliquely with spins, and the term between them.
fn passing<T: PairTerm>(term: impl FnOnce(&Particles) -> T, h: f64) -> Simulation<T, NoWalls> {
    let classes = [(2e-3, 2500.0), (0.8e-3, 4000.0)].map(|(r, rho)| Class::new(r, rho, 0).unwrap());
    let mut particles = Particles::new(classes.to_vec()).unwrap();
    let line = DVec3::new(2.0, -1.0, 2.0) / 3.0;
    let apart = 2.8e-3 + 1e-6;
    let push = |particles: &mut Particles, class, at, velocity, spin| {
        particles.push(class, at, velocity, spin).unwrap();
    };
    push(
        &mut particles,
        0,
        DVec3::new(0.01, 0.02, -0.01),
        DVec3::new(0.03, 0.02, 0.01),
        DVec3::new(3.0, -20.0, 11.0),
    );
    push(
        &mut particles,
        1,
        DVec3::new(0.01, 0.02, -0.01) + apart * line,
        DVec3::new(-0.02, 0.05, -0.01),
        DVec3::new(-40.0, 5.0, 25.0),
    );
    let term = term(&particles);
    Simulation::new(particles, term, NoWalls, rig::weightless(h)).unwrap()
}

/// The films of the pair above: a bridge of 0.2 mm³, which breaks at 0.6 mm.
fn soaked() -> Vec<f64> {
    rig::films_for(2e-10, [2e-3, 0.8e-3])
}

fn mass(p: &Particle, particles: &Particles) -> (f64, f64) {
    let class = particles.classes()[usize::from(p.class)];
    (class.mass(), class.inertia())
}

fn momentum(particles: &Particles) -> DVec3 {
    particles.iter().map(|p| mass(&p, particles).0 * p.velocity).sum()
}

/// About the origin. The drift of a step does not change it: it runs along the velocity.
fn angular_momentum(particles: &Particles) -> DVec3 {
    let one = |p: Particle| {
        let (m, inertia) = mass(&p, particles);
        m * p.position.cross(p.velocity) + inertia * p.spin
    };
    particles.iter().map(one).sum()
}

#[test]
fn no_drag_law_ever_gives_a_pair_energy() {
    for near in [
        Regularisation { gap: Gap::Roughness { length: 2e-6 }, overlap: Overlap::Fade },
        Regularisation { gap: Gap::CutOff { length: 2e-6 }, overlap: Overlap::Full },
        Regularisation { gap: Gap::RelativeRoughness { fraction: 1e-3 }, overlap: Overlap::Off },
    ] {
        for normal in NormalModel::ALL {
            for tangential in TangentialModel::ALL {
                let laws = rig::viscous_laws(NoPull, normal.with(near), tangential.with(near));
                let mut simulation = passing(
                    |p| {
                        let bodies = rig::bodies(p, None);
                        let liquid = rig::liquid(0.07, 0.05, 0.2);
                        rig::wet(liquid, laws, bodies, soaked(), SplitMethod::Half)
                    },
                    1e-6,
                );
                simulation.advance(1).unwrap();
                let first = simulation.particles().kinetic_energy();
                let mut energy = first;
                for step in 0..4_000 {
                    simulation.advance(1).unwrap();
                    let now = simulation.particles().kinetic_energy();
                    assert!(
                        now <= energy * (1.0 + 1e-15),
                        "{} {} step {step}: {energy:e} -> {now:e}",
                        normal.name(),
                        tangential.name()
                    );
                    energy = now;
                }
                assert!(energy < 0.97 * first, "the drag has hardly acted: {energy} {first}");
            }
        }
    }
}

#[test]
fn momentum_and_angular_momentum_of_a_wet_pair_are_kept_to_rounding() {
    for tangential in TangentialModel::ALL {
        let near = Gap::Roughness { length: 2e-6 }.into();
        let drag = NormalModel::Pitois2000.with(near);
        let laws = rig::viscous_laws(AnyCapillary::WillettFull, drag, tangential.with(near));
        let rub = rig::Rub { stiffness: 1e4, restitution: 0.6, friction: 0.4, rolling: 3e-5 };
        let mut simulation = passing(
            |p| {
                let liquid = rig::liquid(0.07, 0.01, 0.2);
                let bodies = rig::bodies(p, None);
                let wet = rig::wet(liquid, laws, bodies, soaked(), SplitMethod::Half);
                (rig::contact(p.classes(), rub), wet)
            },
            1e-6,
        );
        let (before, turning) =
            (momentum(simulation.particles()), angular_momentum(simulation.particles()));
        // Size of the terms that have to cancel.
        let particles = simulation.particles();
        let sum = |of: fn(Particle) -> f64| -> f64 {
            particles.iter().map(|p| mass(&p, particles).0 * of(p)).sum()
        };
        let (scale, moment) =
            (sum(|p| p.velocity.length()), sum(|p| p.position.length() * p.velocity.length()));
        let mut touched = false;
        for _ in 0..100 {
            simulation.advance(100).unwrap();
            simulation.for_each_pair(|encounter, _| touched |= encounter.gap < 0.0);
            let lost = (momentum(simulation.particles()) - before).length();
            let turned = (angular_momentum(simulation.particles()) - turning).length();
            assert!(lost < 1e-12 * scale, "{}: {lost:e}", tangential.name());
            assert!(turned < 1e-12 * moment, "{}: {turned:e} {moment:e}", tangential.name());
        }
        assert!(touched, "the pair never touched");
        assert_eq!(simulation.term().1.counts().formed, 1);
    }
}

/// A pair that turns as one rigid body feels no tangential drag, whatever the law.
#[test]
fn rigid_rotation_costs_nothing() {
    for tangential in TangentialModel::ALL {
        let classes = [2e-3, 0.8e-3].map(|r| Class::new(r, 2500.0, 0).unwrap());
        let gap = 2e-5;
        let spin = DVec3::Z * 5.0;
        let mut particles = Particles::new(classes.to_vec()).unwrap();
        particles.push(0, DVec3::ZERO, DVec3::ZERO, spin).unwrap();
        let apart = DVec3::X * (2.8e-3 + gap);
        particles.push(1, apart, spin.cross(apart), spin).unwrap();
        let near = Gap::Roughness { length: 2e-6 }.into();
        let laws = rig::viscous_laws(NoPull, NoDrag, tangential.with(near));
        let wet = rig::wet(
            rig::liquid(0.07, 1.0, 0.2),
            laws,
            rig::bodies(&particles, None),
            soaked(),
            SplitMethod::Half,
        );
        let mut simulation =
            Simulation::new(particles, wet, NoWalls, rig::weightless(1e-9)).unwrap();
        simulation.advance(1).unwrap();
        let before = [0, 1].map(|id| rig::at(&simulation, id));
        simulation.advance(1_000).unwrap();
        // In a microsecond the pair turns by 5e-6, which is all that may be felt.
        for (id, before) in before.iter().enumerate() {
            let now = rig::at(&simulation, id as u32);
            let felt = (now.velocity - before.velocity).length();
            assert!(felt < 1e-7 * 0.014, "{}: {felt:e}", tangential.name());
            let turned = (now.spin - before.spin).length();
            assert!(turned < 1e-5 * 5.0, "{}: {turned:e}", tangential.name());
        }
        assert_eq!(simulation.term().alive(), 1);
    }
}

/// Yade's checkLubrication: a sphere sinks onto an equal one that is held, S = R e^(-8 R ρ g t/(9 η)),
/// here with R = 1 cm, ρ = 1000 kg/m³, η = 100 Pa s, g = 1 m/s².
#[test]
fn a_sphere_settles_on_another_as_lubrication_says() {
    let (r, rho, viscosity, g) = (0.01, 1000.0, 100.0, 1.0);
    // Held: so heavy that the weight does not move it.
    let [fixed, free] = [1e12, rho].map(|rho| Class::new(r, rho, 0).unwrap());
    let particles = rig::two([fixed, free], r, [0.0, 0.0]);
    let near = Regularisation { gap: Gap::CutOff { length: 1e-6 }, overlap: Overlap::Off };
    let laws = rig::viscous_laws(NoPull, AdamsPerchard1985 { near }, NoDrag);
    let bodies = rig::bodies(&particles, None);
    // Films that reach over the gap and a bridge that does not break within it.
    let films = rig::films_for(4e-6, [r; 2]);
    let wet = rig::wet(rig::liquid(0.07, viscosity, 0.0), laws, bodies, films, SplitMethod::Half);
    let h = 5e-5;
    let weight = Weight(free.mass() * g);
    let mut simulation =
        Simulation::new(particles, (wet, weight), NoWalls, rig::weightless(h)).unwrap();
    let time = 9.0 * viscosity / (8.0 * r * rho * g);
    for _ in 0..20 {
        simulation.advance((0.1 * time / h) as u64).unwrap();
        let gap = rig::at(&simulation, 1).position.x - rig::at(&simulation, 0).position.x - 2.0 * r;
        let expected = r * (-simulation.time() / time).exp();
        // Yade allows 1e-5 m; inertia leaves S''/g = S/(g T²) of the weight, 8e-5 at most.
        assert!((gap - expected).abs() < 1e-6, "{gap:e} {expected:e}");
        assert!((gap / expected - 1.0).abs() < 2e-4, "{gap:e} {expected:e}");
    }
    assert_eq!(simulation.term().0.alive(), 1);
}

/// Rebound through a film. The drag takes K ln on the way in and out and K each for a contact that
/// is deep against the roughness: Davis' restitution with the logarithm + 1 on both ways,
///
/// e_wet = e − [e (ln(1 + S_f/s_r) + 1) + ln(1 + S_rup/s_r) + 1]/St,
///
/// where the film is met at S_f and the bridge breaks at S_rup.
#[test]
fn rebound_is_daviss_with_the_logarithm_plus_one() {
    let (r, roughness, speed, e_dry) = (2e-3, 2e-6, 0.5, 0.8);
    let class = Class::new(r, 2500.0, 0).unwrap();
    let volume = 1e-11;
    for (stokes, sticks) in
        [(1110.0, false), (111.0, false), (37.0, false), (18.5, false), (3.0, true)]
    {
        let particles = rig::two([class; 2], 1e-5, [0.5 * speed, -0.5 * speed]);
        let reduced = 0.5 * class.mass();
        let viscosity = reduced * speed / (stokes * 6.0 * PI * 0.25 * r * r);
        let near = Gap::Roughness { length: roughness }.into();
        let laws = rig::viscous_laws(NoPull, AdamsPerchard1985 { near }, NoDrag);
        let rub = rig::Rub { stiffness: 1e4, restitution: e_dry, friction: 0.0, rolling: 0.0 };
        let may_pull = Linear::from_restitution_with(1e4, e_dry, reduced, Dashpot::MayPull);
        let law = PairContact {
            normal: may_pull.unwrap(),
            friction: rub.friction,
            rolling_friction: rub.rolling,
            tangential_damping: 0.0,
        };
        let contact = Contact::new(&[class; 2], 0, move |_, _| law, |_, _| law);
        let wet: Wet<_, _, _> = rig::wet(
            rig::liquid(0.07, viscosity, 0.0),
            laws,
            rig::bodies(&particles, None),
            rig::films_for(volume, [r; 2]),
            SplitMethod::Half,
        );
        let film = 2.0 * wet.film_thickness(0);
        let h = 2e-8;
        let mut simulation =
            Simulation::new(particles, (contact, wet), NoWalls, rig::weightless(h)).unwrap();
        simulation.advance(60_000).unwrap();
        let out = rig::at(&simulation, 1).velocity.x - rig::at(&simulation, 0).velocity.x;
        let log = |gap: f64| (1.0 + gap / roughness).ln() + 1.0;
        let expected = e_dry - (e_dry * log(film) + log(volume.cbrt())) / stokes;
        assert_eq!(sticks, expected < 0.0);
        let e = out / speed;
        if sticks {
            assert!(e.abs() < 1e-3 && simulation.term().1.alive() == 1, "St {stokes}: {e}");
        } else {
            assert!((e - expected).abs() < 1e-3, "St {stokes}: {e} for {expected}");
            assert_eq!(simulation.term().1.alive(), 0);
        }
    }
}

/// Two spheres that meet without loss but for the liquid: what the motion has lost when they are
/// apart again is the work of the bridge between formation and rupture, and that is booked.
#[test]
fn the_account_of_capillary_energy_closes() {
    let classes = [Class::new(1e-3, 2500.0, 0).unwrap(), Class::new(1.5e-3, 2500.0, 0).unwrap()];
    let particles = rig::two(classes, 2e-4, [0.1, -0.1]);
    let rub = rig::Rub { stiffness: 1e4, restitution: 1.0, friction: 0.0, rolling: 0.0 };
    let contact = rig::contact(&classes, rub);
    let films = rig::films_for(1e-11, classes.map(|class| class.radius()));
    let laws = rig::static_laws(AnyCapillary::Lambert);
    let bodies = rig::bodies(&particles, None);
    let wet = rig::wet(rig::liquid(0.07, 1e-3, 0.2), laws, bodies, films, SplitMethod::Half);
    let settings = rig::weightless(1e-7);
    let mut simulation = Simulation::new(particles, (contact, wet), NoWalls, settings).unwrap();
    let before = simulation.particles().kinetic_energy();
    let mut live = 0.0;
    while simulation.term().1.counts().ruptured == 0 {
        assert!(simulation.time() < 0.02, "they part");
        simulation.advance(50).unwrap();
        let term = &simulation.term().1;
        let mut energy = 0.0;
        simulation.survey(|pair, (_, hold)| {
            let bridge = hold.bridge().unwrap();
            energy += term.energy_of(bridge, pair.encounter.gap).unwrap();
        });
        live = f64::min(live, energy);
    }
    let lost = before - simulation.particles().kinetic_energy();
    let booked = simulation.term().1.capillary_loss();
    assert!(lost > 0.05 * before, "the bridge takes a share: {lost:e} of {before:e}");
    assert!((lost / booked - 1.0).abs() < 5e-3, "{lost:e} {booked:e}");
    assert!(live < -0.9 * booked, "a live bridge has the energy that it takes: {live:e}");
}
