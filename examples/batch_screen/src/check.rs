//! Values of a scene that no type can rule out.

use pendular::capillary::AnyCapillary;
use pendular::lubrication::{NormalModel, TangentialModel};
use pendular::transfer::AnyRupture;

use crate::auto::{AUTO, NONE};
use crate::error::SceneError;
use crate::place::Place;
use crate::scene::{LiquidSpec, Packing, Scene};

/// Names one wrong value.
struct Check<'a> {
    scene: &'a Scene,
}

impl Check<'_> {
    fn fail(&self, key: &str, value: impl ToString, allowed: impl ToString) -> SceneError {
        self.scene.fail(key, value, allowed)
    }

    fn positive(&self, key: &str, value: f64) -> Result<(), SceneError> {
        if value > 0.0 && value.is_finite() {
            return Ok(());
        }
        Err(self.fail(key, value, "a finite number above 0"))
    }

    fn within(&self, key: &str, value: f64, low: f64, high: f64) -> Result<(), SceneError> {
        if (low..=high).contains(&value) {
            return Ok(());
        }
        Err(self.fail(key, value, format!("{low} to {high}")))
    }

    /// The name of a law or one of `words`.
    fn name(&self, key: &str, name: &str, laws: &[&str], words: &[&str]) -> Result<(), SceneError> {
        let known = [laws, words].concat();
        if known.contains(&name) {
            return Ok(());
        }
        Err(self.fail(key, format!("`{name}`"), known.join(", ")))
    }
}

/// Checks all values of a scene; the first wrong one is reported with its place and what is allowed.
pub(crate) fn check(scene: &Scene) -> Result<(), SceneError> {
    let check = Check { scene };
    check.positive("time", scene.time)?;
    check.positive("output_interval", scene.output_interval)?;
    if let Some(step) = scene.time_step {
        check.positive("time_step", step)?;
    }
    for (axis, g) in scene.gravity.iter().enumerate() {
        check.within(&format!("gravity[{axis}]"), *g, -1e3, 1e3)?;
    }
    check.within("guard.overlap_share", scene.guard.overlap_share, 1e-3, 10.0)?;
    scene.guard.speed.map_or(Ok(()), |speed| check.positive("guard.speed", speed))?;
    crate::assumed::check(scene)?;
    materials(scene, &check)?;
    classes(scene, &check)?;
    screen(scene, &check)?;
    scene.liquid.as_ref().map_or(Ok(()), |liquid| wet(liquid, &check))
}

/// Checks an interval of time of the command line, s.
pub(crate) fn interval(option: &str, value: f64) -> Result<(), SceneError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    let (place, key) = (Place::option(option), option.trim_start_matches('-').to_owned());
    let allowed = "a finite number above 0".to_owned();
    Err(SceneError::Value { place, key, value: value.to_string(), allowed })
}

fn materials(scene: &Scene, check: &Check<'_>) -> Result<(), SceneError> {
    for (name, material) in &scene.materials {
        let key = |what: &str| format!("materials.{name}.{what}");
        check.positive(&key("youngs_modulus"), material.youngs_modulus)?;
        check.within(&key("poisson_ratio"), material.poisson_ratio, 0.0, 0.5)?;
        check.within(&key("contact_angle_deg"), material.contact_angle_deg, 0.0, 179.999)?;
    }
    for (k, pair) in scene.contacts.iter().enumerate() {
        let key = |what: &str| format!("contacts[{k}].{what}");
        for name in &pair.between {
            known_material(scene, check, &key("between"), name)?;
        }
        check.within(&key("friction"), pair.friction, 0.0, 10.0)?;
        check.within(&key("rolling_friction"), pair.rolling_friction, 0.0, 1.0)?;
        check.within(&key("restitution"), pair.restitution, 1e-3, 1.0)?;
    }
    check.positive("contact.stiffness", scene.contact.stiffness)?;
    if let Some(ratio) = scene.contact.tangential_ratio {
        check.within("contact.tangential_ratio", ratio, 0.0, 2.0)?;
    }
    Ok(())
}

fn known_material(
    scene: &Scene,
    check: &Check<'_>,
    key: &str,
    name: &str,
) -> Result<(), SceneError> {
    if scene.material(name).is_some() {
        return Ok(());
    }
    let known: Vec<_> = scene.materials.keys().map(String::as_str).collect();
    Err(check.fail(key, format!("`{name}`"), known.join(", ")))
}

fn classes(scene: &Scene, check: &Check<'_>) -> Result<(), SceneError> {
    if scene.classes.is_empty() {
        return Err(check.fail("classes", "an empty list", "at least one size class"));
    }
    for (k, class) in scene.classes.iter().enumerate() {
        let key = |what: &str| format!("classes[{k}].{what}");
        known_material(scene, check, &key("material"), &class.material)?;
        check.positive(&key("diameter_mm"), class.diameter_mm)?;
        check.positive(&key("density"), class.density)?;
        match (class.mass_g, class.count) {
            (Some(mass), None) => check.positive(&key("mass_g"), mass)?,
            (None, Some(_)) => {}
            (Some(_), Some(_)) => {
                return Err(check.fail(&key("count"), "both count and mass_g", "one of the two"));
            }
            (None, None) if matches!(scene.packing, Packing::File { .. }) => {}
            (None, None) => {
                return Err(check.fail(&key("mass_g"), "nothing", "mass_g or count"));
            }
        }
        if scene.classes[..k].iter().any(|other| other.name == class.name) {
            return Err(check.fail(&key("name"), &class.name, "a name of its own"));
        }
    }
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
                let missing = format!("no pair {} with {other}", first.material);
                return Err(check.fail("contacts", missing, "an entry for every pair in use"));
            }
        }
    }
    packing(scene, check)
}

fn packing(scene: &Scene, check: &Check<'_>) -> Result<(), SceneError> {
    match &scene.packing {
        Packing::Random { solid_fraction, clearance_mm } => {
            check.within("packing.solid_fraction", *solid_fraction, 1e-3, 0.35)?;
            check.within("packing.clearance_mm", *clearance_mm, 0.0, 1e4)
        }
        Packing::Bin { floor_height_mm, solid_fraction, settle_at_most } => {
            check.within("packing.solid_fraction", *solid_fraction, 1e-3, 0.35)?;
            let lowest = 0.5 * scene.screen.wire_diameter_mm + scene.motion.reach_mm()[2];
            let highest = scene.screen.height_mm;
            check.within("packing.floor_height_mm", *floor_height_mm, lowest, highest)?;
            check.positive("packing.settle_at_most", *settle_at_most)
        }
        Packing::File { .. } => Ok(()),
    }
}

fn screen(scene: &Scene, check: &Check<'_>) -> Result<(), SceneError> {
    let screen = &scene.screen;
    known_material(scene, check, "screen.material", &screen.material)?;
    check.positive("screen.aperture_mm", screen.aperture_mm)?;
    check.positive("screen.wire_diameter_mm", screen.wire_diameter_mm)?;
    check.positive("screen.diameter_mm", screen.diameter_mm)?;
    check.positive("screen.height_mm", screen.height_mm)?;
    check.positive("screen.collect_below_mm", screen.collect_below_mm)?;
    for (k, many) in screen.frame_elements.iter().enumerate() {
        check.within(&format!("screen.frame_elements[{k}]"), f64::from(*many), 1.0, 1e3)?;
    }
    let element = screen.wire_element_mm.unwrap_or(screen.diameter_mm);
    check.within("screen.wire_element_mm", element, 0.1, 1e4)?;
    check.within("screen.wire_sides", f64::from(screen.wire_sides), 3.0, 256.0)?;
    motion(scene, check)?;
    if let Some(housing) = &scene.housing {
        known_material(scene, check, "housing.material", &housing.material)?;
        check.within("housing.plate_angle_deg", housing.plate_angle_deg, 5.0, 80.0)?;
        check.within("housing.plate_gap_mm", housing.plate_gap_mm, 0.0, 1e4)?;
        check.within("housing.outlet_length_mm", housing.outlet_length_mm, 0.0, 1e4)?;
    }
    for (k, part) in scene.parts.iter().enumerate() {
        known_material(scene, check, &format!("parts[{k}].material"), &part.material)?;
        check.positive(&format!("parts[{k}].scale"), part.scale)?;
        if let Some(half) = part.half_side_mm {
            check.positive(&format!("parts[{k}].half_side_mm"), half)?;
        }
    }
    Ok(())
}

fn motion(scene: &Scene, check: &Check<'_>) -> Result<(), SceneError> {
    check.within("motion.ramp", scene.motion.ramp, 0.0, 1e6)?;
    for (k, term) in scene.motion.all().enumerate() {
        let table = match k {
            0 => "motion".to_owned(),
            k => format!("motion.terms[{}]", k - 1),
        };
        check.within(&format!("{table}.frequency"), term.frequency, 0.0, 1e5)?;
        for axis in 0..3 {
            let (amplitude, phase) = (term.amplitude_mm[axis], term.phase_deg[axis]);
            check.within(&format!("{table}.amplitude_mm[{axis}]"), amplitude, 0.0, 1e3)?;
            check.within(&format!("{table}.phase_deg[{axis}]"), phase, -360.0, 360.0)?;
        }
    }
    Ok(())
}

fn wet(liquid: &LiquidSpec, check: &Check<'_>) -> Result<(), SceneError> {
    check.within("liquid.moisture_percent", liquid.moisture_percent, 0.0, 100.0)?;
    check.positive("liquid.density", liquid.density)?;
    check.positive("liquid.surface_tension", liquid.surface_tension)?;
    check.positive("liquid.viscosity", liquid.viscosity)?;
    check.within("liquid.roughness_share", liquid.roughness_share, 1e-9, 1.0)?;
    let laws = AnyCapillary::ALL.map(|law| law.name());
    check.name("liquid.capillary", &liquid.capillary, &laws, &[AUTO])?;
    check.name("liquid.capillary_wall", &liquid.capillary_wall, &laws, &[AUTO])?;
    let (normal, tangential, drag) = (NormalModel::NAMES, TangentialModel::NAMES, &[NONE, AUTO]);
    check.name("liquid.normal_drag", &liquid.normal_drag, normal, drag)?;
    check.name("liquid.tangential_drag", &liquid.tangential_drag, tangential, drag)?;
    check.name("liquid.tangential_drag_wall", &liquid.tangential_drag_wall, tangential, drag)?;
    check.name("liquid.rupture", &liquid.rupture, &AnyRupture::NAMES, &[])?;
    check.name("liquid.rupture_wall", &liquid.rupture_wall, &AnyRupture::NAMES, &[])
}
