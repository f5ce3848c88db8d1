//! From a scene to a simulation.

use std::path::Path;

use glam::DVec3;
use pendular::capillary::AnyCapillary;
use pendular::contact::Linear;
use pendular::dem::{Class, Contact, Limit, PairContact, PairTerm, Particles, Settings};
use pendular::lubrication::{
    AnyNormalDrag, AnyTangentialDrag, Gap, NormalModel, Regularisation, TangentialModel,
};
use pendular::pair::Range;
use pendular::transfer::{AnyRupture, Dynamic, film};
use pendular::walls::{FrameKind, Harmonic, Motion, Sieve, WallError, Walls, Wires, build::Fit};
use pendular::{Bodies, Liquid, MeshWalls, PairLaws, SplitMethod, WallElement, Wet};

use crate::error::SceneError;
use crate::packing::{self, Placed, Space};
use crate::scene::{DynamicRupture, LiquidSpec, OutsideRange, Packing, Scene, Transfer, WireKind};

/// The liquid term of every scene: laws chosen at run time.
pub(crate) type WetTerm = Wet<AnyCapillary, AnyNormalDrag, AnyTangentialDrag>;

/// All that a run is made of.
pub(crate) struct Built {
    pub(crate) particles: Particles,
    pub(crate) walls: MeshWalls,
    pub(crate) contact: Contact<Linear>,
    pub(crate) wet: Option<WetTerm>,
    pub(crate) settings: Settings,
    pub(crate) derived: Derived,
}

/// Numbers that follow from a scene.
#[derive(Debug, Clone)]
pub(crate) struct Derived {
    /// Particles of each class.
    pub(crate) counts: Vec<u64>,
    /// Mass of one particle of each class, kg.
    pub(crate) masses: Vec<f64>,
    /// Dry mass of all particles, kg.
    pub(crate) solid_mass: f64,
    /// Film thickness at the start, m.
    pub(crate) film: f64,
    /// Liquid volume, m³.
    pub(crate) liquid: f64,
    /// Height of the plane below which a particle has passed, m.
    pub(crate) outlet: f64,
    /// Class, by particle id.
    pub(crate) class: Vec<u16>,
}

/// Builds a scene; `base` is the folder that its paths are relative to.
pub(crate) fn build(scene: &Scene, base: &Path, threads: usize) -> Result<Built, SceneError> {
    let classes = classes(scene)?;
    let placed = place(scene, &classes, base)?;
    let mut particles = Particles::new(classes.clone())?;
    for one in &placed {
        particles.push(one.class, one.position, DVec3::ZERO, DVec3::ZERO)?;
    }
    let walls = walls(scene)?;
    let derived = derive(scene, &classes, &placed);
    let contact = contact(scene, &classes)?;
    let wet = match &scene.liquid {
        Some(spec) => Some(wet(scene, spec, &classes, &derived, &walls)?),
        None => None,
    };
    let settings = settings(scene, &classes, &contact, wet.as_ref(), &derived, threads);
    Ok(Built { particles, walls: MeshWalls(walls), contact, wet, settings, derived })
}

fn classes(scene: &Scene) -> Result<Vec<Class>, SceneError> {
    let one = |class: &crate::scene::SizeClass| {
        let material = scene.material(&class.material).unwrap_or_default();
        Class::new(0.5e-3 * class.diameter_mm, class.density, material)
    };
    Ok(scene.classes.iter().map(one).collect::<Result<_, _>>()?)
}

fn place(scene: &Scene, classes: &[Class], base: &Path) -> Result<Vec<Placed>, SceneError> {
    let radii: Vec<f64> = classes.iter().map(Class::radius).collect();
    let densities: Vec<f64> = classes.iter().map(Class::density).collect();
    match &scene.packing {
        Packing::File { path } => packing::from_file(&base.join(path), &radii, &densities),
        Packing::Random { solid_fraction, clearance_mm } => {
            let counts: Vec<u64> = scene
                .classes
                .iter()
                .zip(classes)
                .map(|(spec, class)| {
                    let by_mass = spec.mass_g.map(|g| (1e-3 * g / class.mass()).round() as u64);
                    by_mass.or(spec.count).unwrap_or(0)
                })
                .collect();
            let screen = &scene.screen;
            let above = 0.5 * screen.wire_diameter_mm + scene.motion.amplitude_mm[2];
            let space = Space {
                radius: 1e-3 * (0.5 * screen.diameter_mm - sideways(scene)),
                bottom: 1e-3 * (above + clearance_mm),
                top: 1e-3 * screen.height_mm,
                solid_fraction: *solid_fraction,
            };
            packing::random(&radii, &counts, &space, scene.seed)
        }
    }
}

/// How far the frame moves to the side, mm.
fn sideways(scene: &Scene) -> f64 {
    scene.motion.amplitude_mm[0].hypot(scene.motion.amplitude_mm[1])
}

fn walls(scene: &Scene) -> Result<Walls, WallError> {
    let screen = &scene.screen;
    let (wires, frame) = match screen.wires {
        WireKind::Cylinders => (Wires::Cylinders, FrameKind::Cylinder { patches: [36, 8] }),
        WireKind::Mesh => (
            Wires::Prisms { sides: screen.wire_sides, fit: Fit::Circumscribed },
            FrameKind::Prism { sides: 180, bands: 4 },
        ),
    };
    let sieve = Sieve {
        aperture: 1e-3 * screen.aperture_mm,
        wire_diameter: 1e-3 * screen.wire_diameter_mm,
        frame_radius: 0.5e-3 * screen.diameter_mm,
        frame_bottom: -1e-3 * (screen.collect_below_mm + 20.0),
        frame_top: 1e-3 * (screen.height_mm + 50.0),
        wires,
        frame,
        element_length: 1e-3 * (screen.aperture_mm + screen.wire_diameter_mm),
    };
    let motion = motion(scene);
    let material = scene.material(&screen.material).unwrap_or_default();
    let parts = sieve.parts()?.into_iter();
    let moved = parts.map(|p| p.with_motion(motion.clone()).with_material(material));
    Walls::new(moved.collect())
}

/// One harmonic term per axis that moves.
fn motion(scene: &Scene) -> Motion {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let spec = &scene.motion;
    let term = |axis: usize| Harmonic {
        amplitude: 1e-3 * spec.amplitude_mm[axis] * axes[axis],
        frequency: spec.frequency,
        phase: spec.phase_deg[axis].to_radians(),
    };
    let moving = (0..3).filter(|&axis| spec.amplitude_mm[axis] > 0.0);
    Motion { terms: moving.map(term).collect(), ramp: 0.0 }
}

fn derive(scene: &Scene, classes: &[Class], placed: &[Placed]) -> Derived {
    let mut counts = vec![0; classes.len()];
    placed.iter().for_each(|one| counts[usize::from(one.class)] += 1);
    let masses: Vec<f64> = classes.iter().map(Class::mass).collect();
    let solid_mass = counts.iter().zip(&masses).map(|(&n, m)| n as f64 * m).sum();
    let spec = scene.liquid.as_ref();
    let liquid =
        spec.map_or(0.0, |liquid| 0.01 * liquid.moisture_percent * solid_mass / liquid.density);
    Derived {
        film: film_thickness(classes, &counts, liquid),
        outlet: -1e-3 * scene.screen.collect_below_mm,
        class: placed.iter().map(|one| one.class).collect(),
        counts,
        masses,
        solid_mass,
        liquid,
    }
}

/// The film thickness that all particles share when they carry the volume `liquid`, by bisection.
fn film_thickness(classes: &[Class], counts: &[u64], liquid: f64) -> f64 {
    let volume = |h: f64| -> f64 {
        let one = |class: &Class| film::volume(class.radius(), h).unwrap_or(0.0);
        classes.iter().zip(counts).map(|(class, &n)| n as f64 * one(class)).sum()
    };
    if liquid <= 0.0 {
        return 0.0;
    }
    let (mut low, mut high) = (0.0, 1e-6);
    while volume(high) < liquid {
        high *= 2.0;
    }
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if volume(middle) < liquid { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The pair of materials, as numbers for the contact law.
#[derive(Debug, Clone, Copy)]
struct Surfaces {
    friction: f64,
    rolling_friction: f64,
    restitution: f64,
    tangential_ratio: f64,
}

fn surfaces(scene: &Scene, a: &str, b: &str) -> Surfaces {
    let found = scene.contacts.iter().find(|pair| {
        let [x, y] = &pair.between;
        (x == a && y == b) || (x == b && y == a)
    });
    let (m, n) = (&scene.materials[a], &scene.materials[b]);
    // k_t/k_n of Mindlin for two materials; (1 − ν)/(1 − ν/2) when they are the same.
    let shear = |m: &crate::scene::Material| m.youngs_modulus / (2.0 * (1.0 + m.poisson_ratio));
    let sum = |share: f64| {
        (1.0 - share * m.poisson_ratio) / shear(m) + (1.0 - share * n.poisson_ratio) / shear(n)
    };
    let ratio = scene.contact.tangential_ratio.unwrap_or(sum(1.0) / sum(0.5));
    Surfaces {
        friction: found.map_or(0.0, |pair| pair.friction),
        rolling_friction: found.map_or(0.0, |pair| pair.rolling_friction),
        restitution: found.map_or(1.0, |pair| pair.restitution),
        tangential_ratio: ratio,
    }
}

fn contact(scene: &Scene, classes: &[Class]) -> Result<Contact<Linear>, SceneError> {
    let names: Vec<&String> = scene.materials.keys().collect();
    let n = names.len();
    let table: Vec<Surfaces> = (0..n * n)
        .map(|k| {
            let (a, b) = (names[k / n], names[k % n]);
            surfaces(scene, a, b)
        })
        .collect();
    let stiffness = scene.contact.stiffness;
    let law = move |s: Surfaces, reduced_mass: f64| {
        let normal = Linear::from_restitution(stiffness, s.restitution, reduced_mass)?
            .with_tangential_ratio(s.tangential_ratio)?;
        Ok::<_, pendular::contact::ContactError>(PairContact {
            normal,
            friction: s.friction,
            rolling_friction: s.rolling_friction,
            tangential_damping: 0.0,
        })
    };
    let pairs: Vec<Vec<PairContact<Linear>>> = classes
        .iter()
        .map(|a| {
            let other = |b: &Class| {
                let reduced = a.mass() * b.mass() / (a.mass() + b.mass());
                law(table[usize::from(a.material()) * n + usize::from(b.material())], reduced)
            };
            classes.iter().map(other).collect::<Result<_, _>>()
        })
        .collect::<Result<_, _>>()?;
    let walls: Vec<Vec<PairContact<Linear>>> = classes
        .iter()
        .map(|a| (0..n).map(|m| law(table[usize::from(a.material()) * n + m], a.mass())).collect())
        .collect::<Result<_, _>>()?;
    let own = classes.to_vec();
    let find = {
        let own = own.clone();
        move |class: &Class| own.iter().position(|c| c == class).unwrap_or(0)
    };
    let find_wall = find.clone();
    Ok(Contact::new(
        classes,
        n as u8,
        move |a, b| pairs[find(a)][find(b)],
        move |a, m| walls[find_wall(a)][usize::from(m)],
    ))
}

fn wet(
    scene: &Scene,
    spec: &LiquidSpec,
    classes: &[Class],
    derived: &Derived,
    walls: &Walls,
) -> Result<WetTerm, SceneError> {
    let angles: Vec<f64> =
        scene.materials.values().map(|m| m.contact_angle_deg.to_radians()).collect();
    let liquid = Liquid {
        surface_tension: spec.surface_tension,
        viscosity: spec.viscosity,
        density: spec.density,
        particle_angles: angles.clone(),
        wall_angles: angles,
    };
    let elements = |part: &pendular::walls::Part| {
        let shape = part.shape.clone();
        (0..shape.element_count())
            .map(move |k| WallElement { area: shape.element_area(k).unwrap_or(f64::NAN) })
            .collect::<Vec<_>>()
    };
    let parts = walls.parts();
    let bodies = Bodies {
        class: derived.class.clone(),
        radii: classes.iter().map(Class::radius).collect(),
        materials: classes.iter().map(Class::material).collect(),
        half_sides: parts.iter().map(|part| part.half_side).collect(),
        wall_materials: parts.iter().map(|part| part.material).collect(),
        first_elements: (0..parts.len() as u32).map(|k| walls.first_element(k)).collect(),
        elements: parts.iter().flat_map(elements).collect(),
    };
    let film_of = |class: &u16| {
        let radius = classes[usize::from(*class)].radius();
        film::volume(radius, derived.film).unwrap_or(0.0)
    };
    let films = derived.class.iter().map(film_of).collect();
    let split = match spec.transfer {
        Transfer::Parabola => SplitMethod::Parabola,
        Transfer::Half => SplitMethod::Half,
    };
    let range = match spec.outside_range {
        OutsideRange::Refuse => Range::Strict,
        OutsideRange::Extrapolate => Range::Extrapolate,
    };
    let between = laws(spec, &spec.capillary, &spec.tangential_drag, &spec.rupture);
    let with_walls =
        laws(spec, &spec.capillary_wall, &spec.tangential_drag_wall, &spec.rupture_wall);
    Ok(Wet::new(liquid, between, with_walls, split, range, bodies, films)?)
}

type Laws = PairLaws<AnyCapillary, AnyNormalDrag, AnyTangentialDrag>;

/// The laws by their names, which the scene's check has found to be known.
fn laws(spec: &LiquidSpec, capillary: &str, tangential: &str, rupture: &str) -> Laws {
    let gap = Gap::RelativeRoughness { fraction: spec.roughness_share };
    let near = Regularisation::from(gap);
    let dynamic = match spec.dynamic_rupture {
        DynamicRupture::None => Dynamic::None,
        DynamicRupture::Pitois => Dynamic::Pitois2001 { viscosity: spec.viscosity },
        DynamicRupture::Grohn => Dynamic::Grohn2022,
    };
    PairLaws {
        capillary: capillary.parse().unwrap_or(AnyCapillary::Lambert),
        normal: spec.normal_drag.parse().unwrap_or(NormalModel::Pitois2000).with(near),
        tangential: tangential.parse().unwrap_or(TangentialModel::Popov2010).with(near),
        rupture: rupture.parse().unwrap_or(AnyRupture::Willett),
        dynamic,
    }
}

/// Share of the stability limit that a scene without a time step runs at.
const SHARE: f64 = 0.5;

fn settings(
    scene: &Scene,
    classes: &[Class],
    contact: &Contact<Linear>,
    wet: Option<&WetTerm>,
    derived: &Derived,
    threads: usize,
) -> Settings {
    let step = scene.time_step.unwrap_or_else(|| {
        let loads = loads(classes, contact, wet);
        SHARE * Limit::packing(classes, &loads).time_step
    });
    let radius = 1e-3 * (0.5 * scene.screen.diameter_mm + scene.screen.wire_diameter_mm);
    let mut settings = Settings::new(step);
    settings.gravity = DVec3::from_array(scene.gravity);
    settings.threads = threads;
    settings.domain = Some((
        DVec3::new(-radius, -radius, derived.outlet),
        DVec3::new(radius, radius, 1e-3 * (scene.screen.height_mm + 50.0)),
    ));
    settings
}

/// The longest stable time step of a built scene.
pub(crate) fn limit(built: &Built) -> Limit {
    let classes = built.particles.classes();
    Limit::packing(classes, &loads(classes, &built.contact, built.wet.as_ref()))
}

fn loads(
    classes: &[Class],
    contact: &Contact<Linear>,
    wet: Option<&WetTerm>,
) -> Vec<pendular::dem::StabilityLoad> {
    let dry = contact.stability(classes);
    match wet {
        None => dry,
        Some(wet) => dry.into_iter().zip(wet.stability(classes)).map(|(a, b)| a + b).collect(),
    }
}
