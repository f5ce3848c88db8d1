//! Values that are fine by themselves and make a run that cannot be: more steps than can be made, a
//! bed that sinks into itself or does not settle.

use std::f64::consts::PI;

use glam::DVec3;

use super::{Check, feed, number};
use crate::error::SceneError;
use crate::scene::{Packing, Scene};

/// More steps than this are years of computing.
const MOST_STEPS: f64 = 1e12;
/// More rows of results than this fill any disk.
pub(super) const MOST_ROWS: f64 = 1e8;
/// Simulated times above this are named as what is wrong when the steps are too many, s.
const LONG: f64 = 1e5;
/// Wider apertures than this many of the largest diameter let everything through at once.
pub(crate) const STEEP: f64 = 2.0;

pub(super) fn check(scene: &Scene, check: &Check<'_>) -> Result<(), SceneError> {
    scene.time_step.map_or(Ok(()), |step| steps(scene, step))?;
    if scene.time / scene.output_interval > MOST_ROWS {
        let value = format!("{} s", number(scene.output_interval));
        return Err(check.fail("output_interval", value, rows_allowed(scene.time)));
    }
    if matches!(scene.packing, Packing::Bin { .. }) && scene.gravity[2] >= 0.0 {
        let allowed =
            "below 0: a bed settles onto the floor of the feed bin, at the lower end of z";
        return Err(check.fail("gravity[2]", number(scene.gravity[2]), allowed));
    }
    at_rest(scene, check)
}

/// What an interval of outputs may be.
pub(super) fn rows_allowed(time: f64) -> String {
    format!("from {:.1e} s: {MOST_ROWS:e} outputs in the run's time", time / MOST_ROWS)
}

/// Refuses a run of more steps than can be made.
pub(crate) fn steps(scene: &Scene, time_step: f64) -> Result<(), SceneError> {
    let steps = scene.time / time_step;
    if steps <= MOST_STEPS {
        return Ok(());
    }
    let (time, step) = (number(scene.time), number(time_step));
    let value = format!("{time} s in steps of {step} s, {steps:.1e} steps,");
    let (key, allowed) = if scene.time > LONG {
        ("time", format!("up to {MOST_STEPS:e} steps, {:.1e} s", MOST_STEPS * time_step))
    } else {
        let least = scene.time / MOST_STEPS;
        ("time_step", format!("up to {MOST_STEPS:e} steps, a time step from {least:.1e} s"))
    };
    Err(scene.fail(key, value, allowed))
}

/// Refuses contacts that yield under the weight of the bed alone by more than the guard lets pass.
/// A sphere at the bottom carries itself, and of the bed what stands above its cross-section.
fn at_rest(scene: &Scene, check: &Check<'_>) -> Result<(), SceneError> {
    let gravity = DVec3::from_array(scene.gravity).length();
    let all: f64 = scene
        .classes
        .iter()
        .map(|class| feed::spheres(class).unwrap_or(0.0) * feed::mass(class))
        .sum();
    let pressure = all * gravity / (PI * (0.5e-3 * scene.screen.diameter_mm).powi(2));
    let needed = scene.classes.iter().map(|class| {
        let radius = 0.5e-3 * class.diameter_mm;
        let force = (feed::mass(class) * gravity).max(pressure * PI * radius * radius);
        force / (scene.guard.overlap_share * radius)
    });
    let needed = needed.fold(0.0, f64::max);
    if scene.contact.stiffness >= needed {
        return Ok(());
    }
    let value = format!("{} N/m", number(scene.contact.stiffness));
    let allowed = format!(
        "from about {} N/m: with less the weight of the bed alone makes overlaps above \
         guard.overlap_share = {} of a radius",
        number(needed.ceil()),
        scene.guard.overlap_share
    );
    Err(check.fail("contact.stiffness", value, allowed))
}
