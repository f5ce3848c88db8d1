//! Settling a bed in the feed bin: minutes of work for a large one, so that it can be stopped,
//! killed and taken up again as a run can.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use glam::DVec3;
use pendular::MeshWalls;
use pendular::contact::Linear;
use pendular::dem::{Class, Contact, Particles, Settings, Simulation};
use serde::{Deserialize, Serialize};

use super::{apparatus, laws};
use crate::checkpoint::{Core, load, store};
use crate::error::SceneError;
use crate::makeup::Makeup;
use crate::packing::Placed;
use crate::progress::{Progress, Settled, Style};
use crate::say;
use crate::scene::Scene;

/// A bed counts as settled when its centres move with less than this share of the energy of a fall
/// by one radius.
pub(super) const AT_REST: f64 = 1e-5;
/// Steps between looks at the kinetic energy.
const LOOK: u64 = 1_000;
/// Steps between looks at the clock and the stop flag.
const BATCH: u64 = 100;

/// How a bed is settled.
pub(super) struct Settling<'a> {
    pub(super) time_step: f64,
    pub(super) threads: usize,
    /// Longest simulated time, s.
    pub(super) at_most: f64,
    /// Where the settling is kept while it lasts.
    pub(super) file: &'a Path,
    /// Wall time between checkpoints, s.
    pub(super) every: f64,
    /// Set when it is to stop.
    pub(super) stop: &'a AtomicBool,
    pub(super) style: Style,
}

/// A bed that has not settled yet.
#[derive(Debug, Serialize, Deserialize)]
struct Half {
    time_step: f64,
    core: Core,
}

type Bed = Simulation<Contact<Linear>, MeshWalls>;

/// Lets the loose spheres fall onto the floor of the bin until they are at rest.
pub(super) fn settle(
    scene: &Scene,
    classes: &[Class],
    loose: &[Placed],
    how: &Settling<'_>,
) -> Result<Vec<Placed>, SceneError> {
    let gravity = DVec3::from_array(scene.gravity).length();
    let of = |one: &Placed| &classes[usize::from(one.class)];
    let unit: f64 = loose.iter().map(|one| of(one).mass() * gravity * of(one).radius()).sum();
    let mut bed = begin(scene, classes, loose, how)?;
    let at = |bed: &Bed| Settled {
        time: bed.time(),
        at_most: how.at_most,
        step: bed.step(),
        spheres: loose.len(),
        motion: motion(bed, classes) / unit,
        at_rest: AT_REST,
    };
    let progress = Progress::new(how.at_most, how.style);
    progress.begin(bed.step(), bed.time());
    progress.settled(&at(&bed));
    let row = |time: f64| (time / scene.output_interval) as u64;
    let mut told = row(bed.time());
    let mut saved = Instant::now();
    while bed.time() < how.at_most {
        bed.advance(BATCH)?;
        let now = at(&bed);
        if bed.step().is_multiple_of(LOOK) && now.time > 0.1 && now.motion < AT_REST {
            break;
        }
        let stop = how.stop.load(Ordering::Relaxed);
        if stop || saved.elapsed().as_secs_f64() >= how.every {
            store(&Half { time_step: how.time_step, core: Core::of(&bed) }, how.file)?;
            saved = Instant::now();
        }
        if stop {
            progress.finish();
            return Err(SceneError::Settling { time: bed.time() });
        }
        progress.settle(&now);
        if row(now.time) > told {
            told = row(now.time);
            progress.settle_row(&now);
        }
    }
    progress.finish();
    let last = at(&bed);
    progress.settled(&last);
    if last.motion >= AT_REST && how.style.has_notes() {
        say::note(format_args!(
            "the bed still moves after {:.2} s, the longest that packing.settle_at_most allows: its \
             energy of motion is {:.1e} of that of a fall by one radius; it starts at rest",
            last.time, last.motion
        ));
    }
    let mut all: Vec<_> = bed.particles().iter().collect();
    all.sort_by_key(|particle| particle.id);
    let placed = |p: &pendular::dem::Particle| Placed { class: p.class, position: p.position };
    Ok(all.iter().map(placed).collect())
}

/// Kinetic energy of the spheres' centres, J. A sphere that only spins about the upright has no
/// part in it: no friction stops that, and the bed's positions do not feel it.
fn motion(bed: &Bed, classes: &[Class]) -> f64 {
    let one = |p: pendular::dem::Particle| {
        0.5 * classes[usize::from(p.class)].mass() * p.velocity.length_squared()
    };
    bed.particles().iter().map(one).sum()
}

/// The bed as it was when its settling was stopped, or else the loose spheres.
fn begin(
    scene: &Scene,
    classes: &[Class],
    loose: &[Placed],
    how: &Settling<'_>,
) -> Result<Bed, SceneError> {
    let floor = apparatus::floor(scene).unwrap_or(0.0);
    let walls = MeshWalls(apparatus::bin(scene, floor)?);
    let gravity = DVec3::from_array(scene.gravity);
    let settings = Settings { gravity, threads: how.threads, ..Settings::new(how.time_step) };
    let contact = laws::contact(scene, classes)?;
    let mut particles = Particles::new(classes.to_vec())?;
    let half = load::<Half>(how.file)
        .ok()
        .filter(|half| half.time_step.to_bits() == how.time_step.to_bits());
    if let Some(Half { core, .. }) = half {
        let snapshot = core.snapshot().map(|stored| contact.load_pair(stored).unwrap_or_default());
        let bed = Simulation::restore(particles, contact, walls, settings, snapshot)?;
        if how.style == Style::People {
            say::note(format_args!(
                "going on with the settling of the bed from t = {:.4} s",
                bed.time()
            ));
        }
        return Ok(bed);
    }
    if how.style == Style::People {
        say::note(format_args!(
            "settling {} spheres in the feed bin; kept for the next run",
            loose.len()
        ));
    }
    for one in loose {
        particles.push(one.class, one.position, DVec3::ZERO, DVec3::ZERO)?;
    }
    Ok(Simulation::new(particles, contact, walls, settings)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::packing::{Space, random};

    #[test]
    fn a_bed_that_is_stopped_again_and_again_settles_to_the_same_bits() {
        let text = crate::builtin::find("demo").unwrap();
        let text = text.replace("diameter_mm = 80 ", "diameter_mm = 40 ");
        let scene = Scene::parse(&text, Path::new("demo")).unwrap();
        let classes = super::super::classes(&scene).unwrap();
        let space = Space { radius: 0.018, bottom: 0.015, top: 0.12, solid_fraction: 0.3 };
        let radii: Vec<f64> = classes.iter().map(Class::radius).collect();
        let loose = random(&radii, &[8, 3, 1], &space, 1).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("bed.settling");
        let stop = AtomicBool::new(true);
        let how = Settling {
            time_step: 8e-6,
            threads: 1,
            at_most: 2.0,
            file: &file,
            every: 1e9,
            stop: &stop,
            style: Style::Silent,
        };
        for k in 1..=5 {
            let stopped = settle(&scene, &classes, &loose, &how).unwrap_err();
            let SceneError::Settling { time } = stopped else { panic!("{stopped}") };
            assert!((time - 8e-4 * f64::from(k)).abs() < 1e-9, "{time}");
        }
        stop.store(false, Ordering::Relaxed);
        let parts = settle(&scene, &classes, &loose, &how).unwrap();
        std::fs::remove_file(&file).unwrap();
        let whole = settle(&scene, &classes, &loose, &how).unwrap();
        assert_eq!(parts, whole);
        let low = whole.iter().map(|one| one.position.z).fold(f64::INFINITY, f64::min);
        assert!((low - 0.0175).abs() < 1e-4, "the lowest sphere lies on the floor: {low}");
    }
}
