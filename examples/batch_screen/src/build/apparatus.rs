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
    let standing = Motion {
        terms: motion(scene)
            .terms
            .into_iter()
            .map(|term| Harmonic { frequency: 0.0, ..term })
            .collect(),
        ramp: 0.0,
    };
    let mut parts = screen(scene, &standing)?;
    parts.retain(|part| part.name == "frame");
    let plane = Plane::new(DVec3::Z * floor, DVec3::Z, 1.0)?;
    let material = scene.material(&scene.screen.material).unwrap_or_default();
    parts.push(Part::new("floor", Shape::Plane(plane)).with_material(material));
    Ok(Walls::new(parts)?)
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
