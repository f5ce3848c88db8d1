//! What is solved for at the end of the step: across the borders of chunks, and until nothing is
//! left to change.

use pendular_contact::Linear;
use pendular_dem_core::{
    Class, Contact, DVec3, Encounter, Implicit, Load, NoWalls, Pair, PairContact, PairTerm,
    Particle, Particles, Resist, Settings, Simulation, StabilityLoad, TermError, Visits,
};

const R: f64 = 1e-3;

/// A drag in every gap up to a reach, which may want attention for nothing.
struct Drag {
    coefficient: f64,
    reach: f64,
    asks: bool,
}

impl PairTerm for Drag {
    type Column = ();

    fn reach(&self) -> f64 {
        self.reach
    }

    fn idle(&self, encounter: &Encounter, (): &mut ()) -> bool {
        encounter.gap > self.reach
    }

    fn load(&self, _: &Pair, (): &mut ()) -> Load {
        Load { attention: self.asks, ..Load::default() }
    }

    fn live(&self, (): &()) -> bool {
        false
    }

    fn settle(&mut self, _: &mut impl Visits<()>) -> Result<(), TermError> {
        Ok(())
    }

    fn resist(&self, _: &Pair, (): &(), _: f64) -> Resist {
        Resist { drag: self.coefficient, clearance: f64::INFINITY, ..Resist::default() }
    }

    fn charge(&self, (): &(), gap: f64) -> [f64; 2] {
        [self.coefficient * gap, self.coefficient]
    }

    fn stability(&self, classes: &[Class]) -> Vec<StabilityLoad> {
        vec![StabilityLoad::default(); classes.len()]
    }
}

type Scene = Simulation<Implicit<(Contact<Linear>, Drag)>, NoWalls>;

fn scene(particles: Particles, drag: Drag, rolling_friction: f64) -> Scene {
    // Small skins: what the copies of pairs remember is of the last time that lists were built.
    with_skins(particles, drag, rolling_friction, [3e-6, 1e-6])
}

fn with_skins(
    particles: Particles,
    drag: Drag,
    rolling_friction: f64,
    [skin, inner]: [f64; 2],
) -> Scene {
    let normal = Linear::from_restitution(1e3, 0.5, 1e-5).unwrap();
    let rub = PairContact { normal, friction: 0.0, rolling_friction, tangential_damping: 0.0 };
    let contact = Contact::new(particles.classes(), 0, move |_, _| rub, move |_, _| rub);
    let settings = Settings { gravity: DVec3::ZERO, ..Settings::new(1e-6) };
    let (skin, inner_skin) = (Some(skin), Some(inner));
    let pass_tolerance = 1e-4;
    let settings = Settings { start_overlap: 0.5, skin, inner_skin, pass_tolerance, ..settings };
    Simulation::new(particles, Implicit::new((contact, drag)), NoWalls, settings).unwrap()
}

/// A pair across a border stands in the lists of two chunks, of which one keeps its impulse. Where
/// attention changes nothing, it does so there too.
#[test]
fn attention_costs_no_pair_its_impulse() {
    let run = |asks: bool| {
        let mut particles = Particles::new(vec![Class::new(R, 2500.0, 0).unwrap()]).unwrap();
        // The later the number the earlier the place: the copy that counts is in the later chunk.
        for k in (0..1331_u32).rev() {
            let at = DVec3::new(f64::from(k % 11), f64::from(k / 11 % 11), f64::from(k / 121));
            let swirl = DVec3::new(-at.y, at.x, 0.3 * at.x - 0.2 * at.z);
            let x = (2.0 * R + 2e-5) * at;
            particles.push(0, x, 0.01 * swirl, 3.0 * swirl).unwrap();
        }
        let drag = Drag { coefficient: 0.3, reach: 1e-4, asks: false };
        let mut scene = scene(particles, drag, 0.0);
        for step in 0..60 {
            scene.term_mut().inner_mut().1.asks = asks && step % 10 == 9;
            scene.advance(1).unwrap();
        }
        let mut all: Vec<_> = scene.particles().iter().collect();
        all.sort_by_key(|p| p.id);
        all
    };
    let (quiet, asking) = (run(false), run(true));
    let fastest = quiet.iter().fold(0.0_f64, |most, p| most.max(p.velocity.length()));
    // Those that ask are solved for in another order, so not to the bit.
    let apart = |(a, b): (&Particle, &Particle)| (a.velocity - b.velocity).length();
    let most = quiet.iter().zip(&asking).map(apart).fold(0.0, f64::max);
    assert!(most < 1e-9 * fastest, "{most:e} of {fastest}");
}

/// Spheres so dense that a chunk has more pairs that touch than are coloured at a time: their order
/// does not hang on what else the lists hold.
#[test]
fn no_skin_changes_a_bit_of_a_dense_packing() {
    let run = |skins: [f64; 2]| {
        let mut particles = Particles::new(vec![Class::new(R, 2500.0, 0).unwrap()]).unwrap();
        for k in 0..1000_u32 {
            let at = DVec3::new(f64::from(k % 10), f64::from(k / 10 % 10), f64::from(k / 100));
            // Half a row apart in every other layer: many neighbours, some touch and some do not.
            let shift = 0.5 * (at.z % 2.0) * DVec3::new(1.0, 1.0, 0.0);
            let wave =
                2e-5 * DVec3::new((3.0 * at.y).sin(), (2.0 * at.z).sin(), (5.0 * at.x).sin());
            let x = 1.99 * R * (DVec3::new(1.0, 1.0, 0.72) * at + shift) + wave;
            particles.push(0, x, 0.02 * wave / R, DVec3::ZERO).unwrap();
        }
        let drag = Drag { coefficient: 0.05, reach: 3e-5, asks: false };
        let mut scene = with_skins(particles, drag, 0.0, skins);
        scene.advance(40).unwrap();
        let mut touching = 0;
        scene.survey(|pair, _| touching += u32::from(pair.encounter.gap < 0.0));
        assert!(touching > 2_000, "{touching}");
        let mut all: Vec<_> = scene.particles().iter().collect();
        all.sort_by_key(|p| p.id);
        all.iter().flat_map(|p| p.position.to_array().map(f64::to_bits)).collect::<Vec<_>>()
    };
    let one = run([1e-4, 1e-6]);
    assert!(one == run([6e-4, 4e-4]) && one == run([3e-4, 2e-5]));
}

/// A sphere at the end of a row spins, and nothing bounds the torques of rolling friction: after one
/// step all spin alike, which takes as many rounds as it takes.
#[test]
fn rounds_go_on_until_rolling_is_settled_too() {
    let mut particles = Particles::new(vec![Class::new(R, 2500.0, 0).unwrap()]).unwrap();
    for k in 0..10_u32 {
        let spin = if k == 0 { 100.0 * DVec3::Z } else { DVec3::ZERO };
        let x = f64::from(k) * (2.0 * R - 1e-6) * DVec3::X;
        particles.push(0, x, DVec3::ZERO, spin).unwrap();
    }
    let drag = Drag { coefficient: 0.0, reach: 0.0, asks: false };
    let mut scene = scene(particles, drag, 1e6);
    scene.advance(1).unwrap();
    for p in scene.particles().iter() {
        assert!((p.spin.z - 10.0).abs() < 2.0, "{p:?}");
    }
    assert!(scene.passes().passes > 10, "{:?}", scene.passes());
}

#[test]
fn an_optional_implicit_term_is_implicit() {
    let mut particles = Particles::new(vec![Class::new(R, 2500.0, 0).unwrap()]).unwrap();
    for side in [-1.0, 1.0] {
        let (x, v) = (side * (R + 2e-5) * DVec3::X, -side * 0.01 * DVec3::X);
        particles.push(0, x, v, DVec3::ZERO).unwrap();
    }
    let drag = || Drag { coefficient: 0.3, reach: 1e-4, asks: false };
    let settings = || Settings { gravity: DVec3::ZERO, ..Settings::new(1e-6) };
    let mut plain =
        Simulation::new(particles.clone(), Implicit::new(drag()), NoWalls, settings()).unwrap();
    let mut optional =
        Simulation::new(particles, Some(Implicit::new(drag())), NoWalls, settings()).unwrap();
    plain.advance(50).unwrap();
    optional.advance(50).unwrap();
    let speed = |p: &Particles| p.iter().next().unwrap().velocity.x;
    assert!(speed(plain.particles()) < 0.9e-2, "{}", speed(plain.particles()));
    assert_eq!(speed(plain.particles()), speed(optional.particles()));
}

/// Three spheres in a row: a dashpot that pulls with `PULL` at most between the first two, a drag
/// between the last two, or the other way round.
struct Row {
    mirrored: bool,
}

const DASHPOT: f64 = 5.0;
const PULL: f64 = 0.01;

impl PairTerm for Row {
    /// Whether it is the drag that acts.
    type Column = bool;

    fn reach(&self) -> f64 {
        1e-4
    }

    fn idle(&self, encounter: &Encounter, drags: &mut bool) -> bool {
        *drags = (encounter.first == 1) != self.mirrored;
        encounter.gap > self.reach()
    }

    fn load(&self, _: &Pair, _: &mut bool) -> Load {
        Load::default()
    }

    fn live(&self, _: &bool) -> bool {
        false
    }

    fn resist(&self, _: &Pair, drags: &bool, _: f64) -> Resist {
        if *drags {
            Resist { drag: DASHPOT, clearance: f64::INFINITY, ..Resist::default() }
        } else {
            Resist { dashpot: DASHPOT, pull: PULL, ..Resist::default() }
        }
    }

    fn charge(&self, drags: &bool, gap: f64) -> [f64; 2] {
        if *drags { [DASHPOT * gap, DASHPOT] } else { [0.0; 2] }
    }

    fn stability(&self, classes: &[Class]) -> Vec<StabilityLoad> {
        vec![StabilityLoad::default(); classes.len()]
    }
}

/// Two spheres part at first, at a speed for which their dashpot pulls more than half of what it may.
/// Then a third one takes one of them along, towards the other or away from it: the dashpot pushes as
/// it should, or pulls no more than it may. Whichever of the pairs is looked at first.
#[test]
fn a_dashpot_is_capped_by_the_speed_that_is_found_and_not_by_the_first_guess() {
    let h = 1e-5;
    let parting = PULL / DASHPOT;
    for (parting, third) in [(10.0 * parting, -1.0), (0.8 * parting, 1.0)] {
        for mirrored in [false, true] {
            let sphere = Class::new(R, 2500.0, 0).unwrap();
            let mass = sphere.mass();
            let mut particles = Particles::new(vec![sphere]).unwrap();
            let mut speeds = [0.0, parting, third];
            if mirrored {
                speeds = [-third, -parting, 0.0];
            }
            for (k, speed) in speeds.into_iter().enumerate() {
                let x = k as f64 * 2.0 * R * DVec3::X;
                particles.push(0, x, speed * DVec3::X, DVec3::ZERO).unwrap();
            }
            let (gravity, pass_tolerance) = (DVec3::ZERO, 1e-4);
            let settings = Settings { gravity, pass_tolerance, ..Settings::new(h) };
            let term = Implicit::new(Row { mirrored });
            let mut scene = Simulation::new(particles, term, NoWalls, settings).unwrap();
            scene.advance(1).unwrap();
            let speed = |id: u32| scene.particles().get(id).unwrap().velocity.x;
            let (a, b) = if mirrored { (-speed(2), -speed(1)) } else { (speed(0), speed(1)) };
            // The first kick is half a step; so stiff a dashpot looks at the speed after it alone.
            let unbounded = DASHPOT * (b - a);
            let pull = unbounded.min(PULL);
            assert_eq!(unbounded > PULL, third > 0.0, "{a} {b}");
            // Impulses are found to 1e-4 and speeds to some g = h c/m* = 5 times that, twice over.
            assert!((mass * a / (0.5 * h * pull) - 1.0).abs() < 2e-2, "{a} {b} {pull}");
        }
    }
}

/// So stiff a drag that the passes stop early, and that the thousandth of an impulse which they may
/// leave over moves bodies faster than they would move otherwise: the next step is not to throw it
/// back.
#[test]
fn what_the_passes_leave_over_drives_nothing() {
    for coefficient in [1e3, 1e6] {
        let mut particles = Particles::new(vec![Class::new(R, 2500.0, 0).unwrap()]).unwrap();
        for k in 0..1000_u32 {
            let at = DVec3::new(f64::from(k % 10), f64::from(k / 10 % 10), f64::from(k / 100));
            let v = 0.01 * DVec3::new((at.y - at.z).sin(), (2.0 * at.z).sin(), (3.0 * at.x).sin());
            particles.push(0, (2.0 * R + 2e-5) * at, v, DVec3::ZERO).unwrap();
        }
        let drag = Drag { coefficient, reach: 1e-4, asks: false };
        let mut scene = scene(particles, drag, 0.0);
        let mut energy = scene.particles().kinetic_energy();
        let mut most = 0.0_f64;
        for _ in 0..100 {
            scene.advance(1).unwrap();
            let now = scene.particles().kinetic_energy();
            most = most.max(now / energy - 1.0);
            energy = now;
        }
        println!("{coefficient:e} N s/m: {most:e} {energy:e} {:?}", scene.passes());
        assert!(scene.passes().at_most > 0, "{:?}", scene.passes());
        assert!(most < 1e-9, "{most:e}");
    }
}
