//! Set-ups that the tests through the whole core share.

use pendular::{Bodies, Liquid, NoDrag, PairLaws, SplitMethod, WallElement, Wet};
use pendular_capillary::{AnyCapillary, CapillaryLaw, ForceCurve};
use pendular_contact::{Dashpot, Linear};
use pendular_dem_core::{
    Boundary, Class, Contact, DVec3, Encounter, Load, Pair, PairContact, PairTerm, Particle,
    Particles, Settings, Simulation, StabilityLoad,
};
use pendular_lubrication::{
    AnyNormalDrag, AnyTangentialDrag, Gap, NormalDrag, NormalModel, TangentialDrag, TangentialModel,
};
use pendular_pair::{Bridge, Mate, OutOfRange, Range, Validity};
use pendular_transfer::{AnyRupture, Dynamic, formation};
use pendular_walls::Walls;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::Rng;

/// A bridge that does not pull.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NoPull;

impl CapillaryLaw for NoPull {
    type Curve = Self;

    fn validity(&self) -> Validity {
        Validity::ALL
    }

    fn curve(&self, _: &Bridge, _: Range) -> Result<Self, OutOfRange> {
        Ok(Self)
    }
}

impl ForceCurve for NoPull {
    fn force(&self, _: f64) -> f64 {
        0.0
    }
}

/// A constant force that presses the bodies of every pair together.
#[derive(Debug)]
pub(crate) struct Weight(pub(crate) f64);

impl PairTerm for Weight {
    type Column = ();

    fn reach(&self) -> f64 {
        1.0
    }

    fn idle(&self, _: &Encounter, (): &mut ()) -> bool {
        false
    }

    fn load(&self, _: &Pair, (): &mut ()) -> Load {
        Load { tension: self.0, ..Load::default() }
    }

    fn live(&self, (): &()) -> bool {
        false
    }

    fn stability(&self, classes: &[Class]) -> Vec<StabilityLoad> {
        vec![StabilityLoad::default(); classes.len()]
    }
}

/// Laws without drag, rupture after Lian.
pub(crate) fn static_laws<C>(capillary: C) -> PairLaws<C, NoDrag, NoDrag> {
    viscous_laws(capillary, NoDrag, NoDrag)
}

/// Laws with drag, rupture after Lian.
pub(crate) fn viscous_laws<C, N, S>(capillary: C, normal: N, tangential: S) -> PairLaws<C, N, S> {
    let (rupture, dynamic) = (AnyRupture::Lian, Dynamic::None);
    PairLaws { capillary, normal, tangential, rupture, dynamic }
}

/// A liquid of density 1000 kg/m³ that meets every body at one angle (rad).
pub(crate) fn liquid(surface_tension: f64, viscosity: f64, angle: f64) -> Liquid {
    let angles = vec![angle; 4];
    let (particle_angles, wall_angles) = (angles.clone(), angles);
    Liquid { surface_tension, viscosity, density: 1000.0, particle_angles, wall_angles }
}

/// What the liquid has to know of the bodies.
pub(crate) fn bodies(particles: &Particles, walls: Option<&Walls>) -> Bodies {
    let mut class = vec![0; particles.len()];
    particles.iter().for_each(|p| class[p.id as usize] = p.class);
    let classes = particles.classes();
    let mut bodies = Bodies {
        class,
        radii: classes.iter().map(Class::radius).collect(),
        materials: classes.iter().map(Class::material).collect(),
        ..Bodies::default()
    };
    for part in walls.iter().flat_map(|walls| walls.parts()) {
        bodies.half_sides.push(part.half_side);
        bodies.wall_materials.push(part.material);
        bodies.first_elements.push(bodies.elements.len() as u32);
        let areas = (0..part.shape.element_count()).filter_map(|k| part.shape.element_area(k));
        bodies.elements.extend(areas.map(|area| WallElement { area }));
    }
    bodies
}

/// The liquid term of a scene, the same laws with spheres and walls, whatever their range.
pub(crate) fn wet<C, N, S>(
    liquid: Liquid,
    laws: PairLaws<C, N, S>,
    bodies: Bodies,
    films: Vec<f64>,
    split: SplitMethod,
) -> Wet<C, N, S>
where
    C: CapillaryLaw + Copy,
    N: NormalDrag + Copy,
    S: TangentialDrag + Copy,
{
    Wet::new(liquid, laws, laws, split, Range::Extrapolate, bodies, films).unwrap()
}

/// Films of two spheres that give half of `volume` each to their bridge.
pub(crate) fn films_for(volume: f64, radii: [f64; 2]) -> Vec<f64> {
    let fraction = |r, other| formation::sphere_fraction(r, Mate::Sphere { radius: other });
    let [i, j] = radii;
    vec![0.5 * volume / fraction(i, j).unwrap(), 0.5 * volume / fraction(j, i).unwrap()]
}

/// Settings without gravity and without a look at the stability limit.
pub(crate) fn weightless(time_step: f64) -> Settings {
    Settings { gravity: DVec3::ZERO, allow_unstable: true, ..Settings::new(time_step) }
}

/// Two spheres on the x axis, the first at the origin.
pub(crate) fn two(classes: [Class; 2], gap: f64, speeds: [f64; 2]) -> Particles {
    let distance = classes[0].radius() + classes[1].radius() + gap;
    let mut particles = Particles::new(classes.to_vec()).unwrap();
    particles.push(0, DVec3::ZERO, speeds[0] * DVec3::X, DVec3::ZERO).unwrap();
    particles.push(1, distance * DVec3::X, speeds[1] * DVec3::X, DVec3::ZERO).unwrap();
    particles
}

/// A particle that must be there.
pub(crate) fn at<T: PairTerm, B: Boundary>(simulation: &Simulation<T, B>, id: u32) -> Particle {
    simulation.particles().get(id).unwrap()
}

/// Contact parameters of every pair in a test.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rub {
    pub(crate) stiffness: f64,
    pub(crate) restitution: f64,
    pub(crate) friction: f64,
    pub(crate) rolling: f64,
}

pub(crate) fn contact(classes: &[Class], rub: Rub) -> Contact<Linear> {
    let law = move |mass: f64| {
        let pushes = Dashpot::PushesOnly;
        let normal =
            Linear::from_restitution_with(rub.stiffness, rub.restitution, mass, pushes).unwrap();
        PairContact {
            normal: normal.with_tangential_ratio(2.0 / 7.0).unwrap(),
            friction: rub.friction,
            rolling_friction: rub.rolling,
            tangential_damping: 0.0,
        }
    };
    let between = move |a: &Class, b: &Class| law(a.mass() * b.mass() / (a.mass() + b.mass()));
    Contact::new(classes, 1, between, move |a, _| law(a.mass()))
}

pub(crate) fn uniform(random: &mut Pcg64, low: f64, high: f64) -> f64 {
    low + (high - low) * (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// Every bit of the particles' state, by id.
pub(crate) fn bits<T: PairTerm, B: Boundary>(simulation: &Simulation<T, B>) -> Vec<u64> {
    let mut all: Vec<_> = simulation.particles().iter().collect();
    all.sort_by_key(|p| p.id);
    let vectors = all.iter().flat_map(|p| [p.position, p.velocity, p.spin]);
    vectors.flat_map(|v| v.to_array()).map(f64::to_bits).collect()
}

/// Rows of a data file whose lines of comment begin with `#`.
pub(crate) fn table(name: &str) -> Vec<std::collections::HashMap<String, String>> {
    let mut reader =
        csv::ReaderBuilder::new().comment(Some(b'#')).from_path(data_file(name)).unwrap();
    let rows: Vec<_> = reader.deserialize().map(Result::unwrap).collect();
    assert!(!rows.is_empty(), "{name}");
    rows
}

pub(crate) fn data_file(name: &str) -> std::path::PathBuf {
    std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../data").join(name)
}

/// A data file in TOML.
pub(crate) fn toml(name: &str) -> toml::Table {
    std::fs::read_to_string(data_file(name)).unwrap().parse().unwrap()
}

/// A liquid with the laws of a screening scene, chosen by name.
pub(crate) type AnyWet = Wet<AnyCapillary, AnyNormalDrag, AnyTangentialDrag>;

/// Water on POM: Lambert, Pitois, Popov, the parabola's transfer ratio.
pub(crate) fn any_wet(particles: &Particles, walls: Option<&Walls>, films: Vec<f64>) -> AnyWet {
    let near = Gap::RelativeRoughness { fraction: 1e-3 }.into();
    let laws = viscous_laws(
        AnyCapillary::Lambert,
        NormalModel::Pitois2000.with(near),
        TangentialModel::Popov2010.with(near),
    );
    let bodies = bodies(particles, walls);
    wet(liquid(0.07275, 1e-3, 0.6), laws, bodies, films, SplitMethod::Parabola)
}
