//! Values that no substance has: most often they are in another unit than the key's.

use super::number;
use crate::scene::Scene;

/// A line for each value that lies far outside of what there is.
pub(crate) fn units(scene: &Scene) -> Vec<String> {
    let mut notes = Vec::new();
    let mut look = |key: String, value: f64, (low, high): (f64, f64), unit: &str| {
        if !(low..=high).contains(&value) {
            notes.push(format!(
                "{key} = {} is {unit}: what there is has {} to {}",
                number(value),
                number(low),
                number(high)
            ));
        }
    };
    for (k, class) in scene.classes.iter().enumerate() {
        // Aerogels and foams to osmium.
        look(format!("classes[{k}].density"), class.density, (20.0, 23e3), "in kg/m3");
    }
    for (name, material) in &scene.materials {
        let key = |what: &str| format!("materials.{name}.{what}");
        // Gels to diamond.
        look(key("youngs_modulus"), material.youngs_modulus, (1e4, 1.3e12), "in Pa");
        // A plain 0 says that the liquid spreads; a right angle is 1.57 in radians.
        let angle = material.contact_angle_deg;
        if angle > 0.0 {
            look(key("contact_angle_deg"), angle, (1.6, 180.0), "in degrees, not in radians");
        }
    }
    if let Some(liquid) = &scene.liquid {
        // Liquefied gases to metals.
        look("liquid.density".into(), liquid.density, (300.0, 14e3), "in kg/m3");
        look("liquid.surface_tension".into(), liquid.surface_tension, (1e-3, 2.5), "in N/m");
        look("liquid.viscosity".into(), liquid.viscosity, (1e-4, 1e4), "in Pa s");
    }
    notes.extend(motion(scene));
    notes
}

/// Sieves shake at up to some ten times the weight, m/s².
const HARDEST: f64 = 1e3;

/// A screen that stands still, or shakes as none does.
fn motion(scene: &Scene) -> Option<String> {
    let one = |term: crate::scene::HarmonicTerm| {
        let farthest = 1e-3 * term.amplitude_mm.iter().fold(0.0, |m: f64, a| m.max(*a));
        farthest * (std::f64::consts::TAU * term.frequency).powi(2)
    };
    let most: f64 = scene.motion.all().map(one).sum();
    if most == 0.0 {
        return Some("the screen stands still: motion has no amplitude or no frequency".into());
    }
    (most > HARDEST).then(|| {
        format!(
            "the screen shakes at up to {most:.1e} m/s2, {:.0} times the weight: motion.frequency is in \
             Hz, motion.amplitude_mm in mm",
            most / 9.81
        )
    })
}
