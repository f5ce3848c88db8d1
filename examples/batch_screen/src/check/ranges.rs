//! Whether the laws of the liquid hold for the angles and radii of a scene that refuses bridges
//! outside their ranges.

use pendular::capillary::{AnyCapillary, CapillaryLaw};
use pendular::pair::{Bridge, Mate, Validity};
use pendular::transfer::{AnyRupture, RuptureLaw};

use crate::error::SceneError;
use crate::scene::{LiquidSpec, OutsideRange, Scene};

/// A body as the laws see it.
struct Body<'a> {
    material: &'a str,
    mate: Mate,
}

/// Refuses laws outside whose ranges bridges of the scene are sure to lie. What is left open is not
/// looked at before it is decided.
pub(crate) fn laws(scene: &Scene) -> Result<(), SceneError> {
    let Some(liquid) = &scene.liquid else { return Ok(()) };
    if liquid.outside_range == OutsideRange::Extrapolate || liquid.moisture_percent == 0.0 {
        return Ok(());
    }
    let spheres: Vec<Body<'_>> = scene
        .classes
        .iter()
        .map(|class| {
            let mate = Mate::Sphere { radius: 0.5e-3 * class.diameter_mm };
            Body { material: &class.material, mate }
        })
        .collect();
    let walls = [&scene.screen.material]
        .into_iter()
        .chain(scene.housing.iter().map(|housing| &housing.material))
        .chain(scene.parts.iter().map(|part| &part.material));
    let walls: Vec<Body<'_>> = walls.map(|material| Body { material, mate: Mate::PLANE }).collect();
    for (bodies, laws) in [(&spheres, between(liquid)), (&walls, with_walls(liquid))] {
        for (key, name, validity) in laws {
            let Some(validity) = validity else { continue };
            for class in &scene.classes {
                for body in bodies {
                    let radius = 0.5e-3 * class.diameter_mm;
                    let pair = (radius, class.material.as_str(), body);
                    let wrong = outside(scene, liquid, pair, &validity);
                    if let Some((what, range)) = wrong {
                        let allowed = format!(
                            "{range}, another law, or liquid.outside_range = \"extrapolate\""
                        );
                        return Err(scene.fail(key, format!("`{name}` at {what}"), allowed));
                    }
                }
            }
        }
    }
    Ok(())
}

/// Key, name and range of a capillary and of a rupture law; no range while the law is left open.
pub(super) type Named<'a> = [(&'static str, &'a str, Option<Validity>); 2];

pub(super) fn between(liquid: &LiquidSpec) -> Named<'_> {
    let (capillary, rupture) = (&liquid.capillary, &liquid.rupture);
    [
        ("liquid.capillary", capillary, of_capillary(capillary)),
        ("liquid.rupture", rupture, of_rupture(rupture)),
    ]
}

pub(super) fn with_walls(liquid: &LiquidSpec) -> Named<'_> {
    let (capillary, rupture) = (&liquid.capillary_wall, &liquid.rupture_wall);
    [
        ("liquid.capillary_wall", capillary, of_capillary(capillary)),
        ("liquid.rupture_wall", rupture, of_rupture_wall(rupture)),
    ]
}

fn of_capillary(name: &str) -> Option<Validity> {
    name.parse().ok().map(|law: AnyCapillary| law.validity())
}

fn of_rupture(name: &str) -> Option<Validity> {
    name.parse().ok().map(|law: AnyRupture| law.validity())
}

fn of_rupture_wall(name: &str) -> Option<Validity> {
    name.parse().ok().map(|law: AnyRupture| law.wall_validity())
}

/// What of a pair lies outside a range, and that range.
fn outside(
    scene: &Scene,
    liquid: &LiquidSpec,
    (radius, material, body): (f64, &str, &Body<'_>),
    validity: &Validity,
) -> Option<(String, String)> {
    let names = [material, body.material];
    let degrees = names.map(|name| scene.materials[name].contact_angle_deg);
    let angles = degrees.map(f64::to_radians);
    let (low, high) = validity.contact_angle;
    for (k, angle) in angles.iter().enumerate() {
        if !(low..=high).contains(angle) {
            let what = format!("materials.{}.contact_angle_deg = {} degrees", names[k], degrees[k]);
            let range = format!(
                "contact angles of {:.0} to {:.0} degrees",
                low.to_degrees(),
                high.to_degrees()
            );
            return Some((what, range));
        }
    }
    if (angles[0] - angles[1]).abs() > validity.angle_difference {
        let what = format!(
            "contact angles of {} degrees ({}) and {} degrees ({})",
            degrees[0], names[0], degrees[1], names[1]
        );
        let most = validity.angle_difference.to_degrees();
        return Some((what, format!("angles that differ by at most {most:.0} degrees")));
    }
    // Only its radii matter.
    let volume = 1e-3 * radius.powi(3);
    let bridge = Bridge::new(radius, body.mate, volume, angles, liquid.surface_tension).ok()?;
    let (ratio, (least, most)) = (bridge.radius_ratio(), validity.radius_ratio);
    if (least..=most).contains(&ratio) {
        return None;
    }
    let what = match body.mate {
        Mate::Sphere { .. } => format!("a ratio of radii of {ratio:.2}"),
        Mate::Wall { .. } => "a wall".into(),
    };
    let range = match (least.is_finite(), most.is_finite()) {
        (true, true) => format!("two spheres with ratios of radii of {least} to {most}"),
        (true, false) => format!("ratios of radii from {least}"),
        _ => "a sphere and a wall".into(),
    };
    Some((what, range))
}
