//! Values of a scene that no type can rule out.

use pendular::capillary::AnyCapillary;
use pendular::lubrication::{NormalModel, TangentialModel};
use pendular::transfer::AnyRupture;

use crate::auto::{AUTO, NONE};
use crate::error::SceneError;
use crate::place::Place;
use crate::scene::{LiquidSpec, Scene};

mod extremes;
mod feed;
mod ranges;
mod units;
mod volumes;

pub(crate) use extremes::{STEEP, steps};
pub(crate) use ranges::laws;
pub(crate) use units::units;
pub(crate) use volumes::volumes;

/// Most wires of one direction that a sieve can have.
const MOST_WIRES: f64 = 1e4;

/// Longest length of a sieve, mm.
const LONGEST: f64 = 1e4;

/// A number as people write it: without hundreds of zeros.
pub(crate) fn number(value: f64) -> String {
    match value.abs() {
        0.0 | 1e-5..1e9 => value.to_string(),
        _ => format!("{value:e}"),
    }
}

/// Names one wrong value.
struct Check<'a> {
    scene: &'a Scene,
}

impl Check<'_> {
    fn fail(&self, key: &str, value: impl ToString, allowed: impl ToString) -> SceneError {
        self.scene.fail(key, value, allowed)
    }

    /// Something that is not there.
    fn missing(&self, key: &str, what: impl std::fmt::Display) -> SceneError {
        let (place, key) = (self.scene.origin.place(key), key.to_owned());
        SceneError::Syntax { place, key, message: what.to_string() }
    }

    fn positive(&self, key: &str, value: f64) -> Result<(), SceneError> {
        if value > 0.0 && value.is_finite() {
            return Ok(());
        }
        Err(self.fail(key, number(value), "a finite number above 0"))
    }

    /// Above 0, and not so large that it can only be a mistake.
    fn up_to(&self, key: &str, value: f64, most: f64) -> Result<(), SceneError> {
        if value > 0.0 && value <= most {
            return Ok(());
        }
        Err(self.fail(key, number(value), format!("above 0, at most {most}")))
    }

    fn within(&self, key: &str, value: f64, low: f64, high: f64) -> Result<(), SceneError> {
        if (low..=high).contains(&value) {
            return Ok(());
        }
        Err(self.fail(key, number(value), format!("{low} to {high}")))
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
    screen(scene, &check)?;
    feed::classes(scene, &check)?;
    feed::packing(scene, &check)?;
    scene.liquid.as_ref().map_or(Ok(()), |liquid| wet(liquid, &check))?;
    extremes::check(scene, &check)?;
    ranges::laws(scene)
}

/// Checks an interval of time of the command line, s.
pub(crate) fn interval(option: &str, value: f64) -> Result<(), SceneError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    let (place, key) = (Place::option(option), option.trim_start_matches('-').to_owned());
    let allowed = "a finite number above 0".to_owned();
    Err(SceneError::Value { place, key, value: number(value), allowed })
}

/// Checks a share of the command line.
pub(crate) fn share(option: &str, value: f64) -> Result<(), SceneError> {
    if value > 0.0 && value <= 1.0 {
        return Ok(());
    }
    let (place, key) = (Place::option(option), option.trim_start_matches('-').to_owned());
    Err(SceneError::Value {
        place,
        key,
        value: number(value),
        allowed: "above 0, at most 1".into(),
    })
}

/// Checks the interval of ParaView files.
pub(crate) fn vtk(scene: &Scene, interval: f64) -> Result<(), SceneError> {
    self::interval("--vtk", interval)?;
    if scene.time / interval <= extremes::MOST_ROWS {
        return Ok(());
    }
    let allowed = extremes::rows_allowed(scene.time);
    let (place, key) = (Place::option("--vtk"), "vtk".to_owned());
    Err(SceneError::Value { place, key, value: number(interval), allowed })
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

fn screen(scene: &Scene, check: &Check<'_>) -> Result<(), SceneError> {
    let screen = &scene.screen;
    known_material(scene, check, "screen.material", &screen.material)?;
    check.up_to("screen.aperture_mm", screen.aperture_mm, LONGEST)?;
    check.up_to("screen.wire_diameter_mm", screen.wire_diameter_mm, LONGEST)?;
    check.up_to("screen.diameter_mm", screen.diameter_mm, LONGEST)?;
    if screen.aperture_mm + screen.wire_diameter_mm > screen.diameter_mm {
        let value = format!("{} mm", number(screen.aperture_mm));
        let allowed = format!(
            "with its wire at most screen.diameter_mm = {} mm, so that a wire lies in the frame",
            number(screen.diameter_mm)
        );
        return Err(check.fail("screen.aperture_mm", value, allowed));
    }
    if MOST_WIRES * (screen.aperture_mm + screen.wire_diameter_mm) < screen.diameter_mm {
        let value = format!("{} mm", number(screen.aperture_mm));
        let allowed = format!(
            "at most {MOST_WIRES} wires across screen.diameter_mm = {} mm",
            number(screen.diameter_mm)
        );
        return Err(check.fail("screen.aperture_mm", value, allowed));
    }
    check.up_to("screen.height_mm", screen.height_mm, LONGEST)?;
    check.up_to("screen.collect_below_mm", screen.collect_below_mm, LONGEST)?;
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
        let name = format!("parts[{k}].name");
        feed::name(check, &name, &part.name)?;
        if scene.parts[..k].iter().any(|other| other.name == part.name) {
            return Err(check.fail(&name, &part.name, "a name of its own"));
        }
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
    check.within("liquid.density", liquid.density, 1.0, 1e5)?;
    check.up_to("liquid.surface_tension", liquid.surface_tension, 1e3)?;
    check.up_to("liquid.viscosity", liquid.viscosity, 1e6)?;
    if let Some(tolerance) = liquid.drag_tolerance {
        check.within("liquid.drag_tolerance", tolerance, 1e-9, 0.1)?;
    }
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
