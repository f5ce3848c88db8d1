//! From a scene to a simulation.

pub(crate) mod apparatus;
mod bed;
mod files;
mod laws;
pub(crate) mod region;
mod settle;

use std::path::Path;

use glam::DVec3;
use pendular::capillary::AnyCapillary;
use pendular::contact::Linear;
use pendular::dem::{Class, Contact, Limit, PairTerm, Particles, Settings, StabilityLoad};
use pendular::lubrication::{AnyNormalDrag, AnyTangentialDrag};
use pendular::transfer::film;
use pendular::{MeshWalls, Wet};

pub(crate) use self::bed::Source;
pub(crate) use self::files::Files;
use crate::error::SceneError;
use crate::scene::{Drag, Scene};

/// The liquid term of every scene: laws chosen at run time.
pub(crate) type WetTerm = Wet<AnyCapillary, Option<AnyNormalDrag>, Option<AnyTangentialDrag>>;

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
    /// Class, by particle id.
    pub(crate) class: Vec<u16>,
    /// Whether drags are solved for at the end of the step.
    pub(crate) implicit: bool,
    /// Checksums of the files that the scene names.
    pub(crate) files: Files,
}

/// Builds a scene, its bed settled if it is to be.
pub(crate) fn build(scene: &Scene, source: &Source<'_>) -> Result<Built, SceneError> {
    let classes = classes(scene)?;
    let contact = laws::contact(scene, &classes).map_err(|e| scene.at("contacts", e))?;
    let dry_limit = Limit::packing(&classes, &contact.stability(&classes)).time_step;
    // The bed settles at a stable step even where the run is to be unstable.
    let dry_step = scene.time_step.filter(|&step| step <= dry_limit).unwrap_or(SHARE * dry_limit);
    let placed = bed::place(scene, &classes, dry_step, source)?;
    let mut particles = Particles::new(classes.clone())?;
    for one in &placed {
        particles.push(one.class, one.position, DVec3::ZERO, DVec3::ZERO)?;
    }
    let class = placed.iter().map(|one| one.class).collect();
    let mut built = around(scene, source.base, source.threads, particles, class)?;
    built.derived.files = Files::of(scene, source.base)?;
    Ok(built)
}

/// Builds what is around the particles of a stored run, whose classes by id are `class` and which
/// began with the `files`.
pub(crate) fn again(
    scene: &Scene,
    base: &Path,
    threads: usize,
    class: Vec<u16>,
    files: Files,
) -> Result<Built, SceneError> {
    let mut built = around(scene, base, threads, Particles::new(classes(scene)?)?, class)?;
    built.derived.files = files;
    Ok(built)
}

fn around(
    scene: &Scene,
    base: &Path,
    threads: usize,
    particles: Particles,
    class: Vec<u16>,
) -> Result<Built, SceneError> {
    let classes = particles.classes().to_vec();
    let contact = laws::contact(scene, &classes).map_err(|e| scene.at("contacts", e))?;
    let walls = apparatus::walls(scene, base)?;
    let mut derived = derive(scene, &classes, class);
    let wet = match &scene.liquid {
        Some(spec) => {
            let wet = laws::wet(scene, spec, &classes, &derived, &walls);
            Some(wet.map_err(|e| scene.at("liquid", e))?)
        }
        None => None,
    };
    let loads = loads(&classes, &contact, wet.as_ref());
    derived.implicit = is_implicit(scene, &classes, &loads);
    let limit = Limit::packing(&classes, &resisted(loads, derived.implicit)).time_step;
    let settings = settings(scene, limit, threads);
    Ok(Built { particles, walls: MeshWalls(walls), contact, wet, settings, derived })
}

/// Whether the drags are to be implicit: as the scene says, or where they would limit the step more
/// than the contacts do.
fn is_implicit(scene: &Scene, classes: &[Class], loads: &[StabilityLoad]) -> bool {
    match scene.liquid.as_ref().map(|liquid| liquid.drag) {
        None | Some(Drag::Explicit) => false,
        Some(Drag::Implicit) => true,
        Some(Drag::Auto) => {
            let rows = Limit::table(classes, loads);
            let row = |term: &str| rows.iter().find(|row| row.term == term);
            let (drag, contact) = (row("viscous drag"), row("contact springs and dashpots"));
            let step = |row: Option<&Limit>| row.map_or(f64::INFINITY, |row| row.time_step);
            step(drag) < step(contact)
        }
    }
}

/// What limits the step of the scheme.
fn resisted(loads: Vec<StabilityLoad>, implicit: bool) -> Vec<StabilityLoad> {
    if implicit {
        loads.into_iter().map(StabilityLoad::resisted_implicitly).collect()
    } else {
        loads
    }
}

fn classes(scene: &Scene) -> Result<Vec<Class>, SceneError> {
    let one = |(k, class): (usize, &crate::scene::SizeClass)| {
        let material = scene.material(&class.material).unwrap_or_default();
        Class::new(0.5e-3 * class.diameter_mm, class.density, material)
            .map_err(|e| scene.at(&format!("classes[{k}]"), e))
    };
    scene.classes.iter().enumerate().map(one).collect()
}

fn derive(scene: &Scene, classes: &[Class], class: Vec<u16>) -> Derived {
    let mut counts = vec![0; classes.len()];
    class.iter().for_each(|&one| counts[usize::from(one)] += 1);
    let masses: Vec<f64> = classes.iter().map(Class::mass).collect();
    let solid_mass = counts.iter().zip(&masses).map(|(&n, m)| n as f64 * m).sum();
    let spec = scene.liquid.as_ref();
    let liquid =
        spec.map_or(0.0, |liquid| 0.01 * liquid.moisture_percent * solid_mass / liquid.density);
    Derived {
        film: film_thickness(classes, &counts, liquid),
        class,
        implicit: false,
        files: Files::default(),
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

/// Share of the stability limit that a scene without a time step runs at.
const SHARE: f64 = 0.5;

fn settings(scene: &Scene, limit: f64, threads: usize) -> Settings {
    let step = scene.time_step.unwrap_or(SHARE * limit);
    let around = 1e-3 * (0.5 * scene.screen.diameter_mm + scene.screen.wire_diameter_mm) + 5e-3;
    let (low, far) = apparatus::collection(scene);
    let top = 1e-3 * (scene.screen.height_mm + 50.0);
    let mut settings = Settings::new(step);
    settings.gravity = DVec3::from_array(scene.gravity);
    settings.threads = threads;
    if let Some(tolerance) = scene.liquid.as_ref().and_then(|liquid| liquid.drag_tolerance) {
        settings.pass_tolerance = tolerance;
    }
    let far = if far.is_finite() { far } else { around };
    settings.domain =
        Some((DVec3::new(-around, -around, low), DVec3::new(far.max(around), around, top)));
    settings
}

/// The longest stable time step of a built scene.
pub(crate) fn limit(built: &Built) -> Limit {
    Limit::packing(built.particles.classes(), &loads_of(built))
}

/// The strongest pairs of each class of a built scene.
pub(crate) fn loads_of(built: &Built) -> Vec<StabilityLoad> {
    let loads = loads(built.particles.classes(), &built.contact, built.wet.as_ref());
    resisted(loads, built.derived.implicit)
}

fn loads(
    classes: &[Class],
    contact: &Contact<Linear>,
    wet: Option<&WetTerm>,
) -> Vec<StabilityLoad> {
    let dry = contact.stability(classes);
    match wet {
        None => dry,
        Some(wet) => dry.into_iter().zip(wet.stability(classes)).map(|(a, b)| a + b).collect(),
    }
}
