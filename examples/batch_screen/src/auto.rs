//! Laws that a scene leaves open with `"auto"`: decided before the run, and said.
//!
//! A capillary law is the cheapest one whose error against the exact bridge stays within
//! [`FORCE_TOLERANCE`] over the scene's bridges. A drag or dynamic rupture is kept unless a pilot
//! run with enough bridges shows that it does less than [`LEAST_SHARE`] of the impulse.

use pendular::Acting;
use pendular::capillary::AnyCapillary;
use pendular::capillary::advise::{self, Advice, AdviseError, BridgeRange};

use crate::build::{Built, Source, build};
use crate::error::RunError;
use crate::evidence;
use crate::limits::bridge_volume;
use crate::pilot;
use crate::scene::{DynamicRupture, LiquidSpec, Scene};

/// A law that the program chooses.
pub(crate) const AUTO: &str = "auto";
/// No such force.
pub(crate) const NONE: &str = "none";
/// Relative error of the capillary force that does not matter beside what a scene leaves open.
pub(crate) const FORCE_TOLERANCE: f64 = 0.05;
/// A force with a smaller share of the impulse is left out.
const LEAST_SHARE: f64 = 0.01;
/// Simulated time of the pilot run, s.
const PILOT: f64 = 0.1;

/// Key and what was decided for it.
pub(crate) type Decision = (String, String);

/// Whether a scene leaves anything open.
pub(crate) fn is_open(scene: &Scene) -> bool {
    scene.liquid.as_ref().is_some_and(|liquid| {
        names(liquid).iter().any(|(_, name)| *name == AUTO)
            || liquid.dynamic_rupture == DynamicRupture::Auto
    })
}

fn names(liquid: &LiquidSpec) -> [(&'static str, &str); 5] {
    [
        ("capillary", &liquid.capillary),
        ("capillary_wall", &liquid.capillary_wall),
        ("normal_drag", &liquid.normal_drag),
        ("tangential_drag", &liquid.tangential_drag),
        ("tangential_drag_wall", &liquid.tangential_drag_wall),
    ]
}

/// Decides what the scene leaves open.
pub(crate) fn decide(scene: &Scene, source: &Source<'_>) -> Result<Vec<Decision>, RunError> {
    let Some(liquid) = &scene.liquid else { return Ok(Vec::new()) };
    if !is_open(scene) {
        return Ok(Vec::new());
    }
    let mut full = scene.clone();
    apply(&mut full, &defaults(liquid));
    let built = build(&full, source)?;
    let law = advise(&full, &built, FORCE_TOLERANCE).map_or(AnyCapillary::Tabulated, |a| a.law);
    full.time = PILOT.min(full.time);
    let open = |key: &str| names(liquid).iter().any(|(name, law)| *name == key && *law == AUTO);
    let drags = ["normal_drag", "tangential_drag", "tangential_drag_wall"];
    let pilot =
        if drags.iter().any(|key| open(key)) || liquid.dynamic_rupture == DynamicRupture::Auto {
            Some(pilot::fly(&full, source)?.outcome)
        } else {
            None
        };
    let small = |acting| {
        pilot.as_ref().is_some_and(|outcome| {
            let counts = &outcome.tally.counts;
            let seen =
                if acting == Acting::DynamicRupture { counts.ruptured } else { counts.formed };
            seen >= evidence::LEAST && outcome.budget.of_impulse(acting) < LEAST_SHARE
        })
    };
    let mut decisions = defaults(liquid);
    for (key, value) in &mut decisions {
        let acting = match key.as_str() {
            "capillary" | "capillary_wall" => {
                *value = law.name().into();
                continue;
            }
            "normal_drag" => Acting::ViscousNormal,
            "dynamic_rupture" => Acting::DynamicRupture,
            _ => Acting::ViscousTangential,
        };
        if small(acting) {
            *value = NONE.into();
        }
    }
    Ok(decisions)
}

/// What stands for each open law until it is decided: the fullest physics.
fn defaults(liquid: &LiquidSpec) -> Vec<Decision> {
    let full = |key: &str| match key {
        "capillary" | "capillary_wall" => "tabulated",
        "normal_drag" => "pitois",
        _ => "popov",
    };
    let mut open: Vec<Decision> = names(liquid)
        .into_iter()
        .filter(|(_, name)| *name == AUTO)
        .map(|(key, _)| (key.to_owned(), full(key).to_owned()))
        .collect();
    if liquid.dynamic_rupture == DynamicRupture::Auto {
        open.push(("dynamic_rupture".into(), "pitois".into()));
    }
    open
}

/// Puts decisions into a scene.
pub(crate) fn apply(scene: &mut Scene, decisions: &[Decision]) {
    let Some(liquid) = &mut scene.liquid else { return };
    for (key, value) in decisions {
        let name = match key.as_str() {
            "capillary" => &mut liquid.capillary,
            "capillary_wall" => &mut liquid.capillary_wall,
            "normal_drag" => &mut liquid.normal_drag,
            "tangential_drag" => &mut liquid.tangential_drag,
            "tangential_drag_wall" => &mut liquid.tangential_drag_wall,
            _ => {
                let none = value == NONE;
                liquid.dynamic_rupture =
                    if none { DynamicRupture::None } else { DynamicRupture::Pitois };
                continue;
            }
        };
        name.clone_from(value);
    }
}

/// The cheapest capillary law for the bridges of a scene, walls included.
pub(crate) fn advise(scene: &Scene, built: &Built, tolerance: f64) -> Result<Advice, AdviseError> {
    let radii: Vec<f64> = scene.classes.iter().map(|class| 5e-4 * class.diameter_mm).collect();
    let least = radii.iter().copied().fold(f64::INFINITY, f64::min);
    let most = radii.iter().copied().fold(0.0, f64::max);
    let v_star = |radius: f64| bridge_volume(radius, built.derived.film) / radius.powi(3);
    let angles = || scene.materials.values().map(|m| m.contact_angle_deg.to_radians());
    let lowest = angles().fold(f64::INFINITY, f64::min);
    let highest = angles().fold(0.0, f64::max);
    let range = BridgeRange {
        // Films thin out while liquid goes to walls and leaves with the fines.
        v_star: ((0.01 * v_star(most)).max(1e-8), (2.0 * v_star(least)).min(0.5)),
        contact_angle: (lowest, highest),
        angle_difference: highest - lowest,
        radius_ratio: (1.0, most / least),
        gap: (0.0, 0.9),
    };
    advise::advise(&range, tolerance)
}

/// Decisions as text.
pub(crate) fn text(decisions: &[Decision]) -> String {
    let one = |(key, value): &Decision| format!("{key} = \"{value}\"");
    decisions.iter().map(one).collect::<Vec<_>>().join(", ")
}
