//! What is fed: size classes and their packing.

use std::f64::consts::PI;

use super::{Check, LONGEST, known_material, number};
use crate::error::SceneError;
use crate::scene::{Packing, Scene, SizeClass};

/// More spheres than this are taken for a mistake: they fill the memory of any machine.
const MOST_SPHERES: f64 = 1e8;

/// Mass of one sphere, kg.
pub(super) fn mass(class: &SizeClass) -> f64 {
    class.density * PI / 6.0 * (1e-3 * class.diameter_mm).powi(3)
}

/// Spheres of a class, as far as the scene says.
pub(super) fn spheres(class: &SizeClass) -> Option<f64> {
    let by_mass = class.mass_g.map(|g| (1e-3 * g / mass(class)).round());
    by_mass.or(class.count.map(|count| count as f64))
}

/// Headers and rows that the tables have besides those of classes and parts.
const TAKEN: [&str; 9] = [
    "total",
    "time_s",
    "all",
    "bridges",
    "blocked",
    "apertures",
    "particles_above",
    "cut_size_mm",
    "imperfection",
];

/// Names become headers of tables: none may break them or mean something else there.
pub(super) fn name(check: &Check<'_>, key: &str, name: &str) -> Result<(), SceneError> {
    let breaks = |c: char| c.is_control() || matches!(c, ',' | ';' | '"');
    let begins = |word: &&str| name.starts_with(*word);
    let taken = TAKEN.contains(&name) || ["above ", "fines ", "retained "].iter().any(begins);
    if name.is_empty() || name.trim() != name || taken || name.contains(breaks) {
        let allowed = "a name for the tables, without commas, semicolons, quotes, line ends or outer \
                       spaces, and none that a column or row of theirs has, such as `total`";
        return Err(check.fail(key, format!("{name:?}"), allowed));
    }
    Ok(())
}

pub(super) fn classes(scene: &Scene, check: &Check<'_>) -> Result<(), SceneError> {
    if scene.classes.is_empty() {
        return Err(check.missing("classes", "the list is empty; allowed: at least one size class"));
    }
    for (k, class) in scene.classes.iter().enumerate() {
        let key = |what: &str| format!("classes[{k}].{what}");
        name(check, &key("name"), &class.name)?;
        known_material(scene, check, &key("material"), &class.material)?;
        check.up_to(&key("diameter_mm"), class.diameter_mm, LONGEST)?;
        check.up_to(&key("density"), class.density, 1e6)?;
        amount(scene, check, k)?;
        fits(scene, check, k)?;
        if scene.classes[..k].iter().any(|other| other.name == class.name) {
            return Err(check.fail(&key("name"), &class.name, "a name of its own"));
        }
    }
    let all: f64 = scene.classes.iter().filter_map(spheres).sum();
    if all > MOST_SPHERES {
        let most = scene.classes.iter().map(|class| spheres(class).unwrap_or(0.0));
        let k = most.enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(k, _)| k);
        let what = if scene.classes[k].count.is_some() { "count" } else { "mass_g" };
        let allowed = format!("up to {MOST_SPHERES:e} in all classes together");
        return Err(check.fail(
            &format!("classes[{k}].{what}"),
            format!("{all:.1e} spheres"),
            allowed,
        ));
    }
    pairs(scene, check)
}

/// A class needs a sphere at least: its share retained would be zero over zero.
fn amount(scene: &Scene, check: &Check<'_>, k: usize) -> Result<(), SceneError> {
    let class = &scene.classes[k];
    let key = |what: &str| format!("classes[{k}].{what}");
    match (class.mass_g, class.count) {
        (Some(mass_g), None) => {
            check.positive(&key("mass_g"), mass_g)?;
            if spheres(class) < Some(1.0) {
                let one = format!("from {:.3e} g, the mass of one sphere", 1e3 * mass(class));
                return Err(check.fail(&key("mass_g"), format!("{} g", number(mass_g)), one));
            }
            Ok(())
        }
        (None, Some(0)) => Err(check.fail(&key("count"), 0, "a whole number from 1")),
        (None, Some(_)) => Ok(()),
        (Some(_), Some(_)) => {
            Err(check.fail(&key("count"), "both count and mass_g", "one of the two"))
        }
        (None, None) if matches!(scene.packing, Packing::File { .. }) => Ok(()),
        (None, None) => {
            let message = "the class has neither mass_g nor count; allowed: one of the two";
            Err(check.missing(&key("mass_g"), message))
        }
    }
}

/// A sphere has to fit into the frame, wherever that has moved to.
fn fits(scene: &Scene, check: &Check<'_>, k: usize) -> Result<(), SceneError> {
    if matches!(scene.packing, Packing::File { .. }) {
        return Ok(());
    }
    let reach = scene.motion.reach_mm();
    let inside = scene.screen.diameter_mm - 2.0 * reach[0].hypot(reach[1]);
    let diameter = scene.classes[k].diameter_mm;
    if inside <= 0.0 {
        let value = format!("a reach of {} mm", number(reach[0].hypot(reach[1])));
        let allowed = format!(
            "below {} mm, half of screen.diameter_mm, so that the spheres stand in the frame",
            number(0.5 * scene.screen.diameter_mm)
        );
        return Err(check.fail("motion.amplitude_mm", value, allowed));
    }
    if diameter < inside {
        return Ok(());
    }
    let value = format!("{} mm", number(diameter));
    let allowed = format!(
        "below {inside:.2} mm: the sphere does not fit into the frame of screen.diameter_mm = {} mm and its \
         motion",
        number(scene.screen.diameter_mm)
    );
    Err(check.fail(&format!("classes[{k}].diameter_mm"), value, allowed))
}

/// Every pair of materials that can meet has friction and restitution.
fn pairs(scene: &Scene, check: &Check<'_>) -> Result<(), SceneError> {
    let walls: Vec<&String> = [&scene.screen.material]
        .into_iter()
        .chain(scene.housing.iter().map(|housing| &housing.material))
        .chain(scene.parts.iter().map(|part| &part.material))
        .collect();
    for (a, first) in scene.classes.iter().enumerate() {
        let others = scene.classes[a..].iter().map(|c| &c.material);
        for other in others.chain(walls.iter().copied()) {
            let found = scene.contacts.iter().any(|pair| {
                let [x, y] = &pair.between;
                (x == &first.material && y == other) || (y == &first.material && x == other)
            });
            if !found && scene.material(other).is_some() {
                let message = format!(
                    "there is no pair {} with {other}; allowed: an entry for every pair in use",
                    first.material
                );
                return Err(check.missing("contacts", message));
            }
        }
    }
    Ok(())
}

pub(super) fn packing(scene: &Scene, check: &Check<'_>) -> Result<(), SceneError> {
    match &scene.packing {
        Packing::Random { solid_fraction, clearance_mm } => {
            check.within("packing.solid_fraction", *solid_fraction, 1e-3, 0.35)?;
            check.within("packing.clearance_mm", *clearance_mm, 0.0, 1e4)
        }
        Packing::Bin { floor_height_mm, solid_fraction, settle_at_most } => {
            check.within("packing.solid_fraction", *solid_fraction, 1e-3, 0.35)?;
            let (wire, reach) = (0.5 * scene.screen.wire_diameter_mm, scene.motion.reach_mm()[2]);
            let highest = scene.screen.height_mm;
            if wire + reach > highest {
                let value = format!("a reach of {} mm upwards", number(reach));
                let allowed = format!(
                    "with half a wire at most screen.height_mm = {} mm: the floor of the feed bin \
                     has to be above it",
                    number(highest)
                );
                return Err(check.fail("motion.amplitude_mm[2]", value, allowed));
            }
            check.within("packing.floor_height_mm", *floor_height_mm, wire + reach, highest)?;
            check.positive("packing.settle_at_most", *settle_at_most)
        }
        Packing::File { .. } => Ok(()),
    }
}
