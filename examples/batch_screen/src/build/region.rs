//! The space that the settled bed is sure to fill: a part there is found before minutes of settling,
//! which know nothing of parts.

use std::f64::consts::PI;
use std::path::Path;

use glam::{DVec2, DVec3};
use pendular::dem::Class;
use pendular::walls::{Mesh, Part, Shape};

use super::apparatus;
use crate::error::SceneError;
use crate::scene::Scene;

/// No random packing of spheres is denser: equal ones cannot be, and mixtures of a few sizes settle
/// at 0.55 to 0.7.
const DENSEST: f64 = 0.74;

/// An upright cylinder.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Region {
    axis: DVec2,
    radius: f64,
    pub(crate) bottom: f64,
    pub(crate) top: f64,
}

impl Region {
    /// Whether a part reaches into it, as it stands at t = 0.
    pub(crate) fn holds(&self, part: &Part) -> bool {
        let Shape::Mesh(mesh) = &part.shape else { return false };
        let shift = part.motion.displacement(0.0);
        triangles(mesh).any(|corners| self.meets(corners.map(|x| x + shift)))
    }

    fn meets(&self, triangle: [DVec3; 3]) -> bool {
        let above = cut(&triangle, |x| x.z - self.bottom);
        let within = cut(&above, |x| self.top - x.z);
        let flat: Vec<DVec2> = within.iter().map(|x| x.truncate() - self.axis).collect();
        !flat.is_empty() && distance(&flat) < self.radius
    }
}

/// The space that spheres of a scene fill up to `top`, but for half a smallest sphere at its sides
/// and floor, where a frame from a file and the settled spheres may share it.
pub(crate) fn region(scene: &Scene, classes: &[Class], counts: &[u64], top: f64) -> Region {
    let present = classes.iter().zip(counts).filter(|(_, count)| **count > 0);
    let smallest = present.map(|(class, _)| class.radius()).fold(f64::INFINITY, f64::min);
    let axis = apparatus::standing(scene).displacement(0.0).truncate();
    let radius = 0.5e-3 * scene.screen.diameter_mm - smallest;
    Region { axis, radius, bottom: apparatus::floor(scene).unwrap_or(0.0) + smallest, top }
}

/// Refuses parts that reach into the bed that is to settle.
pub(super) fn clear(
    scene: &Scene,
    base: &Path,
    classes: &[Class],
    counts: &[u64],
) -> Result<(), SceneError> {
    let Some(floor) = apparatus::floor(scene).filter(|_| !scene.parts.is_empty()) else {
        return Ok(());
    };
    let volume = |(class, &n): (&Class, &u64)| n as f64 * 4.0 / 3.0 * PI * class.radius().powi(3);
    let solid: f64 = classes.iter().zip(counts).map(volume).sum();
    let area = PI * (0.5e-3 * scene.screen.diameter_mm).powi(2);
    let top = floor + solid / (DENSEST * area);
    let region = region(scene, classes, counts, top);
    let walls = apparatus::walls(scene, base)?;
    for (k, file) in scene.parts.iter().enumerate() {
        let part = walls.parts().iter().find(|part| part.name == file.name);
        if part.is_some_and(|part| region.holds(part)) {
            let source = SceneError::PartInBed { part: file.name.clone(), floor, top };
            return Err(scene.at(&format!("parts[{k}]"), source));
        }
    }
    Ok(())
}

fn triangles(mesh: &Mesh) -> impl Iterator<Item = [DVec3; 3]> {
    mesh.indices().iter().map(|corners| corners.map(|k| mesh.points()[k as usize]))
}

/// What of a convex polygon lies where `side` is not negative.
fn cut(polygon: &[DVec3], side: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for (k, &a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let (at_a, at_b) = (side(a), side(b));
        if at_a >= 0.0 {
            kept.push(a);
        }
        if (at_a < 0.0) != (at_b < 0.0) {
            kept.push(a + (b - a) * (at_a / (at_a - at_b)));
        }
    }
    kept
}

/// Distance of the origin from a convex polygon of at least one corner, 0 inside.
fn distance(polygon: &[DVec2]) -> f64 {
    let edges = || polygon.iter().zip(polygon.iter().cycle().skip(1)).take(polygon.len());
    let turn = |(a, b): (&DVec2, &DVec2)| a.perp_dot(*b);
    let area: f64 = edges().map(turn).sum();
    if area != 0.0 && (edges().all(|e| turn(e) >= 0.0) || edges().all(|e| turn(e) <= 0.0)) {
        return 0.0;
    }
    let from = |(a, b): (&DVec2, &DVec2)| {
        let along = *b - *a;
        let share = (-a.dot(along) / along.length_squared()).clamp(0.0, 1.0);
        let share = if share.is_finite() { share } else { 0.0 };
        (*a + share * along).length()
    };
    edges().map(from).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    const REGION: Region =
        Region { axis: DVec2::new(1.0, 0.0), radius: 2.0, bottom: 1.0, top: 3.0 };

    #[test]
    fn triangles_are_held_against_the_cylinder_where_they_are_and_not_by_their_boxes() {
        let z = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        for (triangle, meets) in [
            // Around the axis, no corner or edge inside.
            ([z(-20.0, -20.0, 2.0), z(20.0, -20.0, 2.0), z(0.0, 30.0, 2.0)], true),
            ([z(-20.0, -20.0, 0.9), z(20.0, -20.0, 0.9), z(0.0, 30.0, 0.9)], false),
            ([z(-20.0, -20.0, 3.1), z(20.0, -20.0, 3.1), z(0.0, 30.0, 3.1)], false),
            // A corner inside; an edge that crosses; beside it, though its box is not.
            ([z(2.5, 0.0, 2.0), z(9.0, 1.0, 2.0), z(9.0, -1.0, 2.0)], true),
            ([z(3.1, 0.0, 2.0), z(9.0, 1.0, 2.0), z(9.0, -1.0, 2.0)], false),
            ([z(2.0, -9.0, 2.0), z(2.0, 9.0, 2.0), z(9.0, 0.0, 2.0)], true),
            ([z(3.0, 2.0, 2.0), z(1.0, 4.5, 2.0), z(4.0, 4.0, 2.0)], false),
            // Upright, above the axis: its footprint is a line.
            ([z(1.0, -5.0, 0.0), z(1.0, 5.0, 0.0), z(1.0, 0.0, 9.0)], true),
            ([z(4.0, -5.0, 0.0), z(4.0, 5.0, 0.0), z(4.0, 0.0, 9.0)], false),
            // Inclined: inside the radius only below the bottom.
            ([z(1.0, 0.0, 0.0), z(9.0, 1.0, 4.0), z(9.0, -1.0, 4.0)], false),
            ([z(1.0, 0.0, 0.8), z(9.0, 1.0, 4.0), z(9.0, -1.0, 4.0)], true),
        ] {
            assert_eq!(REGION.meets(triangle), meets, "{triangle:?}");
            let [a, b, c] = triangle;
            assert_eq!(REGION.meets([c, b, a]), meets, "{triangle:?} the other way round");
        }
    }
}
