//! The walls of a screening apparatus: screen, frame with the feed bin as its upper part, impact
//! plate and outlet below.

use std::path::Path;

use glam::DVec3;
use pendular::walls::build::{Fit, plate, rectangle};
use pendular::walls::{
    FrameKind, Harmonic, Mesh, Motion, Part, Plane, Shape, Sieve, WallError, Walls, Wires,
};

use crate::error::SceneError;
use crate::scene::{HarmonicTerm, Housing, Packing, PartFile, Scene, WireKind};

/// The frame goes on this far below the wire axes, m.
const SKIRT: f64 = 10e-3;
/// Clearance between the frame and the housing around it, m.
const CLEARANCE: f64 = 2e-3;

/// All walls during screening.
pub(crate) fn walls(scene: &Scene, base: &Path) -> Result<Walls, SceneError> {
    let mut parts = screen(scene, &motion(scene)).map_err(|e| scene.at("screen", e))?;
    if let Some(housing) = &scene.housing {
        parts.extend(below(scene, housing).map_err(|e| scene.at("housing", e))?);
    }
    for (k, file) in scene.parts.iter().enumerate() {
        parts.retain(|part| group(&part.name) != file.name);
        let wrong = |source| scene.at(&format!("parts[{k}].stl"), source);
        parts.push(from_file(scene, file, base).map_err(wrong)?);
    }
    Walls::new(parts).map_err(|e| scene.at("screen", e))
}

/// The walls in which the bed settles: all of them standing where they are at t = 0, and the floor
/// of the feed bin.
pub(crate) fn bin(scene: &Scene, floor: f64) -> Result<Walls, SceneError> {
    let mut parts = screen(scene, &standing(scene))?;
    parts.retain(|part| part.name == "frame");
    let plane = Plane::new(DVec3::Z * floor, DVec3::Z, 1.0)?;
    let material = scene.material(&scene.screen.material).unwrap_or_default();
    parts.push(Part::new("floor", Shape::Plane(plane)).with_material(material));
    Ok(Walls::new(parts)?)
}

/// Where the screen is at t = 0, for ever. A ramp begins at rest.
pub(crate) fn standing(scene: &Scene) -> Motion {
    let Motion { terms, ramp } = motion(scene);
    if ramp > 0.0 {
        return Motion::STILL;
    }
    let still = |term| Harmonic { frequency: 0.0, ..term };
    Motion { terms: terms.into_iter().map(still).collect(), ramp }
}

/// What a part is called in the results: all wires are one group.
pub(crate) fn group(part: &str) -> &str {
    if part.starts_with("wire-") { "wires" } else { part }
}

fn screen(scene: &Scene, motion: &Motion) -> Result<Vec<Part>, WallError> {
    let screen = &scene.screen;
    let patches = screen.frame_elements;
    let (wires, frame) = match screen.wires {
        WireKind::Cylinders => (Wires::Cylinders, FrameKind::Cylinder { patches }),
        WireKind::Mesh => (
            Wires::Prisms { sides: screen.wire_sides, fit: Fit::Circumscribed },
            FrameKind::Prism { sides: 180, bands: patches[1] },
        ),
    };
    let pitch = screen.aperture_mm + screen.wire_diameter_mm;
    let sieve = Sieve {
        aperture: 1e-3 * screen.aperture_mm,
        wire_diameter: 1e-3 * screen.wire_diameter_mm,
        frame_radius: 0.5e-3 * screen.diameter_mm,
        frame_bottom: -bottom(scene),
        frame_top: 1e-3 * (screen.height_mm + 50.0),
        wires,
        frame,
        element_length: 1e-3 * screen.wire_element_mm.unwrap_or(pitch),
    };
    let material = scene.material(&screen.material).unwrap_or_default();
    let parts = sieve.parts()?.into_iter();
    Ok(parts.map(|p| p.with_motion(motion.clone()).with_material(material)).collect())
}

/// Depth of the frame's lower end, m: a skirt over the housing, or down to where particles leave.
fn bottom(scene: &Scene) -> f64 {
    match scene.housing {
        Some(_) => SKIRT + 0.5e-3 * scene.screen.wire_diameter_mm,
        None => 1e-3 * (scene.screen.collect_below_mm + 20.0),
    }
}

/// The sum of the scene's harmonic terms, each along every axis that it moves.
fn motion(scene: &Scene) -> Motion {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let along = |term: HarmonicTerm| {
        let moving = (0..3).filter(move |&axis| term.amplitude_mm[axis] > 0.0);
        moving.map(move |axis| Harmonic {
            amplitude: 1e-3 * term.amplitude_mm[axis] * axes[axis],
            frequency: term.frequency,
            phase: term.phase_deg[axis].to_radians(),
        })
    };
    Motion { terms: scene.motion.all().flat_map(along).collect(), ramp: scene.motion.ramp }
}

/// The plate that falls towards +x, and the upright walls of the outlet on its other three sides.
fn below(scene: &Scene, housing: &Housing) -> Result<Vec<Part>, WallError> {
    let half = 0.5e-3 * scene.screen.diameter_mm + CLEARANCE;
    let tilt = housing.plate_angle_deg.to_radians();
    let high = -bottom(scene) - 1e-3 * housing.plate_gap_mm;
    let end = half + 1e-3 * housing.outlet_length_mm;
    let low = high - (half + end) * tilt.tan();
    let middle = DVec3::new(0.5 * (end - half), 0.0, 0.5 * (high + low));
    let length = (half + end) / tilt.cos();
    let slope = plate(middle, length, 2.0 * half, tilt, [24, 16])?;
    // The walls start above the lower end of the frame, so that nothing flies out between.
    let top = -0.5 * SKIRT;
    let (x, z) = (DVec3::X * (half + end), DVec3::Z * (top - low));
    let sides = [
        rectangle(DVec3::new(-half, -half, low), DVec3::Y * 2.0 * half, z, [8, 8])?,
        rectangle(DVec3::new(-half, -half, low), x, z, [8, 8])?,
        rectangle(DVec3::new(-half, half, low), x, z, [8, 8])?,
    ];
    let corners = |mesh: &Mesh| -> Vec<[DVec3; 3]> {
        mesh.indices().iter().map(|t| t.map(|v| mesh.points()[v as usize])).collect()
    };
    let outlet = Mesh::from_triangles(&sides.iter().flat_map(corners).collect::<Vec<_>>())?;
    let material = scene.material(&housing.material).unwrap_or_default();
    Ok(vec![
        Part::new("impact plate", Shape::Mesh(slope)).with_material(material),
        Part::new("outlet", Shape::Mesh(outlet)).with_material(material),
    ])
}

/// Lowest and farthest point that a particle may reach before it is in the collecting bin: z and x.
pub(crate) fn collection(scene: &Scene) -> (f64, f64) {
    let half = 0.5e-3 * scene.screen.diameter_mm + CLEARANCE;
    match &scene.housing {
        None => (-1e-3 * scene.screen.collect_below_mm, f64::INFINITY),
        Some(housing) => {
            let high = -bottom(scene) - 1e-3 * housing.plate_gap_mm;
            let end = half + 1e-3 * housing.outlet_length_mm;
            let low = high - (half + end) * housing.plate_angle_deg.to_radians().tan();
            (low - 20e-3, end)
        }
    }
}

/// Height of the feed bin's floor above the wire axes, m, where the bed settles in one.
pub(crate) fn floor(scene: &Scene) -> Option<f64> {
    match &scene.packing {
        Packing::Bin { floor_height_mm, .. } => Some(1e-3 * floor_height_mm),
        _ => None,
    }
}

fn from_file(scene: &Scene, file: &PartFile, base: &Path) -> Result<Part, WallError> {
    let mesh = Mesh::from_stl(base.join(&file.stl), file.scale)?;
    let motion = if file.moves { motion(scene) } else { Motion::STILL };
    let material = scene.material(&file.material).unwrap_or_default();
    let half_side = file.half_side_mm.map_or(f64::INFINITY, |mm| 1e-3 * mm);
    let part = Part::new(file.name.clone(), Shape::Mesh(mesh)).with_motion(motion);
    Ok(part.with_material(material).with_half_side(half_side))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    #[test]
    fn the_motion_is_the_sum_of_the_terms_of_the_commented_sample() {
        let demo = crate::builtin::find("demo").unwrap();
        let (before, after) = demo.split_once("# [[motion.terms]]").unwrap();
        let (block, rest) = after.split_once("\n\n").unwrap();
        let block = block.replace("\n# ", "\n");
        let text = format!("{before}[[motion.terms]]{block}\n\n{rest}");
        let scene = Scene::parse(&text, Path::new("s.toml")).unwrap();
        let motion = motion(&scene);
        for time in [0.0, 3e-3, 0.1234] {
            let x = motion.displacement(time);
            let first = TAU * 50.6 * time;
            // The quarter turns are exact by hand: sin(a + 90°) = cos a.
            assert!((x.x - 0.08e-3 * first.cos()).abs() < 1e-15);
            assert!((x.z - 1e-3 * (first.sin() + 0.1 * (2.0 * first).cos())).abs() < 1e-15);
        }
        assert_eq!(scene.motion.reach_mm(), [0.08, 0.05, 1.1]);
    }

    #[test]
    fn a_bed_settles_in_a_frame_that_stands_where_the_run_begins() {
        for ramp in [0.0, 0.2] {
            let demo = crate::builtin::find("demo").unwrap();
            let text = demo.replace("[motion]", &format!("[motion]\nramp = {ramp}"));
            let scene = Scene::parse(&text, Path::new("s.toml")).unwrap();
            let mut bin = bin(&scene, 15e-3).unwrap();
            let mut walls = walls(&scene, Path::new(".")).unwrap();
            bin.move_to(0.7, 0.7);
            walls.move_to(0.0, 0.0);
            let frame = walls.parts().iter().position(|part| part.name == "frame").unwrap() as u32;
            let (settled, begins) = (bin.displacement(0), walls.displacement(frame));
            assert_eq!(bin.parts()[0].name, "frame");
            assert_eq!(settled, begins, "ramp {ramp}");
            assert_eq!(begins == DVec3::ZERO, ramp > 0.0, "{begins}");
        }
    }

    /// The demo with these lines in place of its housing's heading, which they come before.
    fn scene(lines: &str) -> Scene {
        let demo = crate::builtin::find("demo").unwrap();
        Scene::parse(
            &demo.replace("[housing]", &format!("{lines}\n[housing]")),
            Path::new("s.toml"),
        )
        .unwrap()
    }

    #[test]
    fn a_screen_from_a_file_moves_as_the_built_in_one_does() {
        let folder = tempfile::tempdir().unwrap();
        let sheet =
            rectangle(DVec3::new(-40.0, -40.0, 0.0), DVec3::X * 80.0, DVec3::Y * 80.0, [2, 2]);
        let mut file = std::fs::File::create(folder.path().join("sheet.stl")).unwrap();
        sheet.unwrap().write_stl(&mut file, 1.0).unwrap();
        for moves in [true, false] {
            let part = format!(
                "[[parts]]\nname = \"wires\"\nstl = \"sheet.stl\"\nmaterial = \"steel\"\nmoves = {moves}\n"
            );
            let scene = scene(&part);
            let mut walls = walls(&scene, folder.path()).unwrap();
            let named = |name: &str| walls.parts().iter().position(|part| part.name == name);
            let (sheet, frame) = (named("wires").unwrap() as u32, named("frame").unwrap() as u32);
            assert!(!walls.parts().iter().any(|part| part.name.starts_with("wire-")));
            for time in [1e-3, 7.3e-3, 0.0421] {
                walls.move_to(time, time);
                let (by, at) = (walls.displacement(frame), walls.velocity(frame));
                assert!(by.length() > 1e-5 && at.length() > 1e-3);
                let (own, speed) = (walls.displacement(sheet), walls.velocity(sheet));
                assert_eq!([own, speed], if moves { [by, at] } else { [DVec3::ZERO; 2] });
                // A sphere that rests on the sheet touches it wherever it is.
                let on_it = DVec3::new(3e-3, 2e-3, 2e-3 - 1e-6) + own;
                let (mut near, mut touches) = (Vec::new(), Vec::new());
                walls.candidates(sheet, on_it, 3e-3, &mut near);
                walls.touches(sheet, &near, on_it, 2e-3, 0.0, &mut touches);
                assert!(touches.iter().any(|touch| (touch.gap + 1e-6).abs() < 1e-9), "{touches:?}");
            }
        }
    }

    #[test]
    fn films_on_frame_and_wires_are_as_fine_as_asked_for() {
        let count = |lines: &str| {
            let demo = crate::builtin::find("demo").unwrap();
            let scene = Scene::parse(
                &demo.replace("[screen]", &format!("[screen]\n{lines}")),
                Path::new("s.toml"),
            );
            let walls = walls(&scene.unwrap(), Path::new(".")).unwrap();
            let frame = walls.parts().iter().find(|part| part.name == "frame").unwrap();
            let wires = walls.parts().iter().filter(|part| part.name.starts_with("wire-"));
            let wires: u32 = wires.map(|wire| wire.shape.element_count()).sum();
            (frame.shape.element_count(), wires)
        };
        let (_, plain) = count("");
        assert_eq!(count("frame_elements = [30, 5]").0, 150);
        // A quarter of the pitch: about four times as many.
        let finer = count("wire_element_mm = 2.0").1;
        let coarser = count("wire_element_mm = 1000.0").1;
        assert!(finer > 3 * plain && coarser < plain / 3, "{finer} {plain} {coarser}");
    }
}
