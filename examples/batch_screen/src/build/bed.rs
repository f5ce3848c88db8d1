//! The bed at the start: placed, read, or settled dry in the feed bin and kept for the next run.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use pendular::dem::Class;

use super::settle::{Settling, settle};
use super::{apparatus, region};
use crate::error::SceneError;
use crate::packing::{self, Placed, Space};
use crate::progress::Style;
use crate::replace::replace;
use crate::say;
use crate::scene::{Packing, Scene};

/// Where a bed comes from and where settled ones are kept.
pub(crate) struct Source<'a> {
    /// Folder that the scene's paths are relative to.
    pub(crate) base: &'a Path,
    /// Folder of the settled beds; `None` leaves the spheres where they are placed before they
    /// settle, which is enough to check a scene.
    pub(crate) beds: Option<&'a Path>,
    pub(crate) threads: usize,
    /// How to tell that a bed is being settled, which can take minutes.
    pub(crate) style: Style,
    /// Set when settling is to stop; it goes on from there the next time.
    pub(crate) stop: &'a AtomicBool,
    /// Wall time between checkpoints of the settling, s.
    pub(crate) checkpoint_every: f64,
}

/// One lock a bed, so that runs side by side do not settle the same one twice.
static BEDS: Mutex<BTreeMap<PathBuf, Arc<Mutex<()>>>> = Mutex::new(BTreeMap::new());

fn lock_of(bed: &Path) -> Arc<Mutex<()>> {
    let mut all = BEDS.lock().unwrap_or_else(PoisonError::into_inner);
    Arc::clone(all.entry(bed.to_path_buf()).or_default())
}

/// The particles of a scene at t = 0, at rest.
pub(crate) fn place(
    scene: &Scene,
    classes: &[Class],
    time_step: f64,
    source: &Source<'_>,
) -> Result<Vec<Placed>, SceneError> {
    let radii: Vec<f64> = classes.iter().map(Class::radius).collect();
    let densities: Vec<f64> = classes.iter().map(Class::density).collect();
    let counts = counts(scene, classes);
    match &scene.packing {
        Packing::File { path } => {
            let file = source.base.join(path);
            let wrong = |source| scene.at("packing.path", source);
            let placed = packing::from_file(&file, &radii, &densities).map_err(wrong)?;
            inside(scene, &file, &placed).map_err(wrong)?;
            complete(scene, &counts, &placed)?;
            Ok(placed)
        }
        Packing::Random { solid_fraction, clearance_mm } => {
            let wire = 0.5 * scene.screen.wire_diameter_mm;
            let bottom = 1e-3 * (wire + scene.motion.reach_mm()[2] + clearance_mm);
            packing::random(&radii, &counts, &space(scene, bottom, *solid_fraction), scene.seed)
                .map_err(|source| scene.at("packing.solid_fraction", source))
        }
        Packing::Bin { floor_height_mm, solid_fraction, settle_at_most } => {
            region::clear(scene, source.base, classes, &counts)?;
            let kept = source.beds.map(|beds| kept(scene, classes, &counts, time_step, beds));
            let lock = kept.as_deref().map(lock_of).unwrap_or_default();
            let _alone = lock.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(file) = kept.as_ref().filter(|file| file.exists()) {
                match look(file, &radii, &densities, &counts) {
                    Ok(bed) => return Ok(bed),
                    Err(why) if source.style.has_notes() => say::note(format_args!(
                        "the kept bed {} is not used: {why}; the bed settles again",
                        file.display()
                    )),
                    Err(_) => {}
                }
            }
            let space = space(scene, 1e-3 * floor_height_mm, *solid_fraction);
            let loose = packing::random(&radii, &counts, &space, scene.seed)
                .map_err(|source| scene.at("packing.solid_fraction", source))?;
            let Some(file) = kept else { return Ok(loose) };
            let half = file.with_extension("settling");
            let how = Settling {
                time_step,
                threads: source.threads,
                at_most: *settle_at_most,
                file: &half,
                every: source.checkpoint_every,
                stop: source.stop,
                style: source.style,
            };
            make_folder(&file)?;
            let settled = settle(scene, classes, &loose, &how)?;
            keep(&file, classes, &settled)?;
            // Nothing is lost where it cannot be removed: the bed is looked for first.
            let _ = fs::remove_file(&half);
            Ok(settled)
        }
    }
}

/// Reads a kept bed, or says why it is not the one that was kept. Beds of older versions have no
/// checksum: their counts must do.
fn look(
    file: &Path,
    radii: &[f64],
    densities: &[f64],
    counts: &[u64],
) -> Result<Vec<Placed>, String> {
    let text = fs::read_to_string(file).map_err(|e| e.to_string())?;
    if let Some((rows, sum)) = text.rsplit_once(CHECKSUM)
        && sum.trim_end() != checksum(rows)
    {
        return Err("its checksum is wrong".into());
    }
    let bed = packing::from_file(file, radii, densities).map_err(|e| e.to_string())?;
    for (class, &count) in counts.iter().enumerate() {
        let found = bed.iter().filter(|one| usize::from(one.class) == class).count() as u64;
        if found != count {
            return Err(format!(
                "it has {found} spheres of {} mm, the scene has {count}",
                2e3 * radii[class]
            ));
        }
    }
    Ok(bed)
}

/// How the last line of a kept bed begins; a CRC-32 of all before it follows.
const CHECKSUM: &str = "# crc32 ";

fn checksum(rows: &str) -> String {
    format!("{:08x}", crc32fast::hash(rows.as_bytes()))
}

/// Particles from a file must lie in the frame, above where they are collected.
fn inside(scene: &Scene, file: &Path, placed: &[Placed]) -> Result<(), SceneError> {
    let fail = |line: u64, message: String| {
        Err(SceneError::Csv { file: file.to_path_buf(), line, message })
    };
    if placed.is_empty() {
        return fail(1, "there is no particle in it".into());
    }
    let radius = 0.5e-3 * scene.screen.diameter_mm;
    let (low, _) = apparatus::collection(scene);
    let top = 1e-3 * (scene.screen.height_mm + 50.0);
    let out = |one: &Placed| {
        let x = one.position;
        x.truncate().length() > radius || x.z < low || x.z > top
    };
    match placed.iter().position(out) {
        None => Ok(()),
        Some(k) => {
            let allowed = format!("within {radius} m of the axis and from {low} to {top} m high");
            fail(
                k as u64 + 2,
                format!("{:?} lies outside the frame: {allowed}", placed[k].position.to_array()),
            )
        }
    }
}

/// A file holds as many spheres of each class as the scene says, where it does, and at least one.
fn complete(scene: &Scene, counts: &[u64], placed: &[Placed]) -> Result<(), SceneError> {
    for (k, class) in scene.classes.iter().enumerate() {
        let held = placed.iter().filter(|one| usize::from(one.class) == k).count() as u64;
        let (what, asked) = match (class.count, class.mass_g) {
            (Some(_), _) => ("count", Some(counts[k])),
            (None, Some(_)) => ("mass_g", Some(counts[k])),
            (None, None) => ("name", None),
        };
        let key = format!("classes[{k}].{what}");
        if held == 0 {
            let allowed = "classes of which it holds spheres";
            return Err(scene.fail(
                &key,
                "a class of which the packing's file holds none",
                allowed,
            ));
        }
        if let Some(asked) = asked.filter(|&asked| asked != held) {
            let allowed =
                format!("the {held} that the packing's file holds, or neither count nor mass_g");
            return Err(scene.fail(&key, format!("{asked} spheres"), allowed));
        }
    }
    Ok(())
}

fn counts(scene: &Scene, classes: &[Class]) -> Vec<u64> {
    let one = |(spec, class): (&crate::scene::SizeClass, &Class)| {
        let by_mass = spec.mass_g.map(|g| (1e-3 * g / class.mass()).round() as u64);
        by_mass.or(spec.count).unwrap_or(0)
    };
    scene.classes.iter().zip(classes).map(one).collect()
}

fn space(scene: &Scene, bottom: f64, solid_fraction: f64) -> Space {
    let motion = scene.motion.reach_mm();
    let radius = 1e-3 * (0.5 * scene.screen.diameter_mm - motion[0].hypot(motion[1]));
    Space { radius, bottom, top: 1e-3 * scene.screen.height_mm, solid_fraction }
}

/// The file of a settled bed: its name is a hash of all that made it.
fn kept(scene: &Scene, classes: &[Class], counts: &[u64], time_step: f64, beds: &Path) -> PathBuf {
    // Beds of scenes with a ramp once settled in a frame that stood elsewhere.
    let still = if scene.motion.ramp > 0.0 { " still" } else { "" };
    let made_of = format!(
        "{:?} {classes:?} {counts:?} {time_step:?} {} {:?} {:?} {:?} {:?} {:?} {:?} {:?} {:?}{still}",
        env!("CARGO_PKG_VERSION"),
        super::settle::AT_REST,
        scene.seed,
        scene.packing,
        scene.gravity,
        scene.materials,
        scene.contacts,
        scene.contact,
        (scene.screen.diameter_mm, scene.screen.height_mm, scene.screen.wires),
        scene.motion,
    );
    beds.join(format!("bed-{:016x}.csv", fnv(made_of.as_bytes())))
}

/// FNV-1a, 64 bits: short, and the same everywhere.
fn fnv(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, &b| (hash ^ u64::from(b)).wrapping_mul(0x100_0000_01b3))
}

/// Before a bed settles, which can take minutes: there has to be a place to keep it in.
fn make_folder(file: &Path) -> Result<(), SceneError> {
    let folder = file.parent().unwrap_or(Path::new("."));
    let fail = |source| SceneError::Unwritable { file: folder.to_path_buf(), source };
    fs::create_dir_all(folder).map_err(fail)?;
    tempfile::tempfile_in(folder).map(drop).map_err(fail)
}

/// Writes a bed to be used again.
fn keep(file: &Path, classes: &[Class], settled: &[Placed]) -> Result<(), SceneError> {
    let fail = |source| SceneError::Unwritable { file: file.to_path_buf(), source };
    make_folder(file)?;
    let mut text = String::from("id,x,y,z,radius,density\n");
    for (id, one) in settled.iter().enumerate() {
        let class = &classes[usize::from(one.class)];
        let [x, y, z] = one.position.to_array();
        // The shortest text that reads back to the same bits.
        text += &format!("{id},{x:?},{y:?},{z:?},{:?},{:?}\n", class.radius(), class.density());
    }
    text += &format!("{CHECKSUM}{}\n", checksum(&text));
    replace(file, text.as_bytes()).map_err(fail)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn a_kept_bed_reads_back_to_the_bit() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("deep/bed.csv");
        let classes = [Class::new(2.5e-3, 1358.0, 0).unwrap()];
        let position = DVec3::new(0.1 + 0.2, -1.0 / 3.0, 1e-17);
        let bed = [Placed { class: 0, position }];
        keep(&file, &classes, &bed).unwrap();
        let read = |counts: &[u64]| look(&file, &[2.5e-3], &[1358.0], counts);
        assert_eq!(read(&[1]).unwrap(), bed);
        assert_eq!(fs::read_dir(file.parent().unwrap()).unwrap().count(), 1);
        // One of an older version has no checksum; one that was changed or cut is not used.
        let text = fs::read_to_string(&file).unwrap();
        let rows = text.split_once('#').unwrap().0;
        fs::write(&file, rows).unwrap();
        assert_eq!(read(&[1]).unwrap(), bed);
        for (changed, wanted) in [
            (text.replace("0.3", "0.2"), "its checksum is wrong"),
            (rows.replace("0.3", "x"), "line 2"),
            (rows.split_inclusive('\n').take(1).collect(), "0 spheres of 5 mm, the scene has 1"),
            (String::new(), "header"),
        ] {
            fs::write(&file, changed).unwrap();
            let said = read(&[1]).unwrap_err();
            assert!(said.contains(wanted), "{said}");
        }
    }

    #[test]
    fn fnv_of_a_known_text() {
        assert_eq!(fnv(b"a"), 0xaf63_dc4c_8601_ec8c);
    }
}
