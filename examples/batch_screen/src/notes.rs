//! What is allowed in a scene but hardly meant: told before a run, and its parts from files, so that
//! their units and places can be seen.

use glam::DVec3;
use pendular::dem::{Class, Particle};
use pendular::walls::{Part, Shape, Walls};

use crate::build::region::region;
use crate::build::{Built, apparatus};
use crate::check::{STEEP, number};
use crate::limits::drop_speed;
use crate::scene::Scene;

/// A line for each part from a file and for each oddity.
pub(crate) fn text(scene: &Scene, built: &Built) -> String {
    let parts = parts(scene, &built.walls.0);
    let lines = parts.into_iter().map(|part| format!("  part         {part}\n"));
    let notes = of(scene, built).into_iter().map(|note| format!("  note         {note}\n"));
    lines.chain(notes).collect()
}

fn parts(scene: &Scene, walls: &Walls) -> Vec<String> {
    let of = |file: &crate::scene::PartFile| {
        let part = walls.parts().iter().find(|part| part.name == file.name)?;
        let Shape::Mesh(mesh) = &part.shape else { return None };
        let points = || mesh.points().iter().copied();
        let low = 1e3 * points().fold(DVec3::INFINITY, DVec3::min);
        let high = 1e3 * points().fold(DVec3::NEG_INFINITY, DVec3::max);
        let size = high - low;
        let (name, triangles) = (&file.name, mesh.indices().len());
        let s = if triangles == 1 { "" } else { "s" };
        Some(format!(
            "{name}: {triangles} triangle{s} from {}, {:.2} x {:.2} x {:.2} mm, x {:.2} to {:.2}, \
             y {:.2} to {:.2}, z {:.2} to {:.2} mm",
            file.stl.display(),
            size.x,
            size.y,
            size.z,
            low.x,
            high.x,
            low.y,
            high.y,
            low.z,
            high.z
        ))
    };
    scene.parts.iter().filter_map(of).collect()
}

fn of(scene: &Scene, built: &Built) -> Vec<String> {
    let mut notes = Vec::new();
    let time_step = built.settings.time_step;
    if scene.output_interval < time_step {
        notes.push(format!(
            "output_interval = {} s is below the time step: there is a row a step",
            number(scene.output_interval)
        ));
    }
    if scene.time < 0.5 * time_step {
        let (time, step) = (number(scene.time), number(time_step));
        notes.push(format!("time = {time} s is below half a step of {step} s: nothing moves"));
    }
    if scene.gravity[2] >= 0.0 {
        notes.push("gravity[2] is not below 0: nothing falls onto the screen".into());
    }
    let diameters = || scene.classes.iter().map(|class| class.diameter_mm);
    let (least, most) =
        (diameters().fold(f64::INFINITY, f64::min), diameters().fold(0.0, f64::max));
    let aperture = scene.screen.aperture_mm;
    let built_in = scene.parts.iter().all(|part| part.name != "wires");
    if built_in && aperture <= least {
        notes.push(format!(
            "no class can pass: the smallest has {least} mm, screen.aperture_mm is {aperture}"
        ));
    } else if built_in && aperture > STEEP * most {
        notes.push(format!(
            "all classes fall through at once: the largest has {most} mm, screen.aperture_mm is \
             {aperture}"
        ));
    }
    if scene.liquid.as_ref().is_some_and(|liquid| liquid.moisture_percent == 0.0) {
        notes.push("liquid.moisture_percent is 0: a dry run; without [liquid] it is faster".into());
    }
    notes.extend(crate::check::units(scene));
    notes.extend(crate::check::volumes(scene, built));
    notes.extend(reached(scene, built));
    notes.extend(fall(scene, built.particles.classes()));
    notes
}

/// Parts where spheres are before they settle, though not surely after that.
fn reached(scene: &Scene, built: &Built) -> Vec<String> {
    if apparatus::floor(scene).is_none() {
        return Vec::new();
    }
    let classes = built.particles.classes();
    let top = |one: Particle| one.position.z + classes[usize::from(one.class)].radius();
    let top = built.particles.iter().map(top).fold(f64::NEG_INFINITY, f64::max);
    let region = region(scene, classes, &built.derived.counts, top);
    let named = |name: &str| scene.parts.iter().any(|file| file.name == name);
    let parts = built.walls.0.parts().iter();
    let held = parts.filter(|part| named(&part.name) && region.holds(part));
    let note = |part: &Part| {
        format!(
            "part `{}` reaches into the space of the spheres, below z = {:.2} mm: a bed that has \
             settled into it is refused at the start of a run",
            part.name,
            1e3 * top
        )
    };
    held.map(note).collect()
}

/// A fall onto the screen that alone makes the guard stop the run.
fn fall(scene: &Scene, classes: &[Class]) -> Option<String> {
    let speed = drop_speed(scene);
    let share =
        |class: &Class| speed * (class.mass() / scene.contact.stiffness).sqrt() / class.radius();
    let deepest = classes.iter().map(share).fold(0.0, f64::max);
    (deepest > scene.guard.overlap_share).then(|| {
        format!(
            "a fall onto the screen makes overlaps of about {:.0} % of a radius, more than the guard \
             lets pass: contact.stiffness = {} N/m is low",
            100.0 * deepest,
            number(scene.contact.stiffness)
        )
    })
}
