use std::collections::HashMap;
use std::collections::hash_map::Entry;

use glam::DVec3;

use crate::bounds::{Bounds, Tree};
use crate::error::Origin;
use crate::touch::{Touch, merge};
use crate::triangle::Triangle;
use crate::{Tessellation, WallError};

/// A surface of triangles. Both sides are solid: it touches spheres from either side.
///
/// Each triangle is one element. Neighbouring triangles act as one surface: a sphere on a flat
/// floor has one touch however the floor is cut up, two in an inner corner, one on a ridge.
/// A sphere's centre must not cross the surface, so overlaps have to stay well below its radius.
#[derive(Debug, Clone)]
pub struct Mesh {
    points: Vec<DVec3>,
    indices: Vec<[u32; 3]>,
    triangles: Vec<Triangle>,
    areas: Vec<f64>,
    bounds: Bounds,
    tree: Tree,
    /// How far coplanar faces may be out of plane, m.
    tolerance: f64,
}

impl Mesh {
    /// A mesh of shared vertices (m) and triangles of three vertex indices.
    ///
    /// # Errors
    /// [`WallError::Empty`], [`WallError::NoVertex`], [`WallError::NotFinite`] and
    /// [`WallError::Degenerate`], with the first triangle at fault.
    pub fn new(points: Vec<DVec3>, indices: Vec<[u32; 3]>) -> Result<Self, WallError> {
        for (triangle, corners) in indices.iter().enumerate() {
            let missing = corners.iter().find(|v| **v as usize >= points.len());
            if let Some(&vertex) = missing {
                return Err(WallError::NoVertex { triangle, vertex, count: points.len() });
            }
        }
        Self::prepare(points, indices, &Origin::Arrays)
    }

    /// A mesh of separate triangles (corners in m); corners that are equal become one vertex.
    ///
    /// # Errors
    /// As [`Mesh::new`].
    pub fn from_triangles(triangles: &[[DVec3; 3]]) -> Result<Self, WallError> {
        Self::weld(triangles, &Origin::Arrays)
    }

    pub(crate) fn weld(triangles: &[[DVec3; 3]], origin: &Origin) -> Result<Self, WallError> {
        let mut points = Vec::new();
        let mut known: HashMap<[u64; 3], u32> = HashMap::new();
        let mut indices = Vec::with_capacity(triangles.len());
        for corners in triangles {
            indices.push(corners.map(|corner| {
                // Adding zero makes -0 and 0 the same vertex.
                let bits = corner.to_array().map(|x| (x + 0.0).to_bits());
                match known.entry(bits) {
                    Entry::Occupied(entry) => *entry.get(),
                    Entry::Vacant(entry) => {
                        points.push(corner);
                        *entry.insert((points.len() - 1) as u32)
                    }
                }
            }));
        }
        Self::prepare(points, indices, origin)
    }

    fn prepare(
        points: Vec<DVec3>,
        indices: Vec<[u32; 3]>,
        origin: &Origin,
    ) -> Result<Self, WallError> {
        if indices.is_empty() {
            return Err(WallError::Empty { origin: origin.clone() });
        }
        let mut triangles = Vec::with_capacity(indices.len());
        let mut areas = Vec::with_capacity(indices.len());
        for (triangle, corners) in indices.iter().enumerate() {
            let [a, b, c] = corners.map(|v| points[v as usize]);
            let area = 0.5 * (b - a).cross(c - a).length();
            // The area of finite but huge coordinates overflows: refused as well.
            if ![a, b, c].iter().all(|p| p.is_finite()) || !area.is_finite() {
                return Err(WallError::NotFinite { origin: origin.clone(), triangle });
            }
            let prepared = Triangle::new([a, b, c])
                .ok_or_else(|| WallError::Degenerate { origin: origin.clone(), triangle })?;
            triangles.push(prepared);
            areas.push(area);
        }
        link_neighbours(&indices, &mut triangles);
        let corners = |t: &[u32; 3]| t.map(|v| points[v as usize]);
        let tree = Tree::new(indices.iter().map(|t| Bounds::around(corners(t))).enumerate());
        let bounds = Bounds::around(indices.iter().flat_map(corners));
        Ok(Self { points, indices, triangles, areas, bounds, tree, tolerance: 0.0 })
    }

    /// The same mesh, where faces up to `tolerance` (m) out of plane count as one flat face.
    ///
    /// Negative or NaN counts as 0. Meshes from STL files have a tolerance of the rounding of
    /// their single-precision coordinates, others 0.
    #[must_use]
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        Self { tolerance: tolerance.max(0.0), ..self }
    }

    /// The same mesh, shifted by `offset` (m).
    ///
    /// # Errors
    /// [`WallError::NotFinite`] or [`WallError::Degenerate`] where the shifted coordinates cannot
    /// hold the mesh.
    pub fn shifted(&self, offset: DVec3) -> Result<Self, WallError> {
        let points = self.points.iter().map(|p| *p + offset).collect();
        let moved = Self::prepare(points, self.indices.clone(), &Origin::Arrays)?;
        Ok(moved.with_tolerance(self.tolerance))
    }

    /// The vertices, m.
    #[must_use]
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The triangles, as indices into [`Mesh::points`].
    #[must_use]
    pub fn indices(&self) -> &[[u32; 3]] {
        &self.indices
    }

    /// The areas of the triangles, m².
    #[must_use]
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// The mesh as it is, each triangle its own element.
    #[must_use]
    pub fn tessellation(&self) -> Tessellation {
        Tessellation {
            points: self.points.clone(),
            triangles: self.indices.clone(),
            elements: (0..self.indices.len() as u32).collect(),
        }
    }

    pub(crate) fn bounds(&self) -> Bounds {
        self.bounds
    }

    pub(crate) fn candidates(&self, centre: DVec3, reach: f64, out: &mut Vec<u32>) {
        self.tree.near(centre, reach, |k| {
            if self.triangles[k as usize].distance(centre, reach).is_some() {
                out.push(k);
            }
        });
        out.sort_unstable();
    }

    pub(crate) fn touches(
        &self,
        candidates: &[u32],
        centre: DVec3,
        radius: f64,
        reach: f64,
        out: &mut Vec<Touch>,
    ) {
        for &element in candidates {
            let hit = self.triangles[element as usize].hit(centre, radius + reach);
            if let Some((distance, normal)) = hit {
                out.push(Touch { element, gap: distance - radius, normal });
            }
        }
        merge(out, radius, self.tolerance);
    }
}

/// Leaves each edge to the first triangle that has it, so that it is looked at once, and tells
/// that one about its neighbour if there is exactly one.
fn link_neighbours(indices: &[[u32; 3]], triangles: &mut [Triangle]) {
    let mut owners: HashMap<(u32, u32), (usize, usize, u32)> = HashMap::new();
    for (t, corners) in indices.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            let (owner, edge, others) = owners.entry((a.min(b), a.max(b))).or_insert((t, k, 0));
            if *owner == t {
                continue;
            }
            *others += 1;
            triangles[t].give_away(k);
            let beyond = if *others == 1 { triangles[t].inward(k) } else { DVec3::ZERO };
            triangles[*owner].set_beyond(*edge, beyond);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point(size: f64) -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-size..size).prop_map(DVec3::from_array)
    }

    /// Triangles over a few shared points: edges with one, two and many triangles.
    fn soup() -> impl Strategy<Value = Mesh> {
        let indices = prop::collection::vec(prop::array::uniform3(0u32..8), 1..14);
        (prop::collection::vec(point(1.0), 8), indices).prop_filter_map(
            "flat",
            |(points, mut indices)| {
                indices.retain(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
                Mesh::new(points, indices).ok()
            },
        )
    }

    /// A rough surface over a grid of 4 x 4 squares.
    fn surface() -> impl Strategy<Value = Mesh> {
        (prop::collection::vec(-1.0..1.0, 25), 0.0..0.5).prop_map(|(heights, rough)| {
            let at = |k: usize| DVec3::new((k % 5) as f64, (k / 5) as f64, rough * heights[k]);
            let mut indices = Vec::new();
            for k in (0..19u32).filter(|k| k % 5 != 4) {
                indices.extend([[k, k + 1, k + 6], [k, k + 6, k + 5]]);
            }
            Mesh::new((0..25).map(at).collect(), indices).unwrap()
        })
    }

    /// A centre somewhere, or close above a place in, on an edge of or at a corner of a triangle.
    fn centre(mesh: &Mesh, pick: usize, share: [f64; 2], off: DVec3) -> DVec3 {
        let [a, b, c] = mesh.indices[pick % mesh.indices.len()].map(|v| mesh.points[v as usize]);
        a.lerp(b, share[0]).lerp(c, share[1]) + off
    }

    fn share() -> impl Strategy<Value = [f64; 2]> {
        prop::array::uniform2(prop_oneof![Just(0.0), Just(1.0), 0.0..1.0])
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn leaving_edges_to_neighbours_loses_nothing(
            (mesh, sound) in prop_oneof![
                soup().prop_map(|m| (m, false)),
                surface().prop_map(|m| (m, true)),
            ],
            pick in 0usize..100, share in share(),
            off in prop_oneof![point(0.2), point(1.0), (-0.5..0.5).prop_map(|z| DVec3::Z * z)],
        ) {
            let centre = centre(&mesh, pick, share, off);
            let (radius, reach) = (0.3, 0.5);
            let (mut candidates, mut found) = (Vec::new(), Vec::new());
            mesh.candidates(centre, radius + reach, &mut candidates);
            mesh.touches(&candidates, centre, radius, reach, &mut found);
            // The nearest of all triangles, each asked on its own.
            let nearest = mesh
                .triangles
                .iter()
                .filter_map(|t| t.distance(centre, radius + reach))
                .map(|(distance, _)| distance - radius)
                .fold(f64::INFINITY, f64::min);
            prop_assert_eq!(nearest == f64::INFINITY, found.is_empty());
            if let Some(first) = found.first() {
                prop_assert!((first.gap - nearest).abs() < 1e-12);
            }
            // What is kept was among the hits of single triangles. On a surface that does not
            // cross itself every face hit that no nearer hit hides is kept.
            let mut single: Vec<Touch> = (0u32..)
                .zip(&mesh.triangles)
                .filter_map(|(element, t)| {
                    let (distance, normal) = t.distance(centre, radius + reach)?;
                    Some(Touch { element, gap: distance - radius, normal })
                })
                .collect();
            prop_assert!(found.iter().all(|f| single.contains(f)));
            merge(&mut single, radius, 0.0);
            let is_face = |t: &Touch| {
                let [a, b, c] = mesh.indices[t.element as usize].map(|v| mesh.points[v as usize]);
                (b - a).cross(c - a).normalize().dot(t.normal).abs() > 1.0 - 1e-12
            };
            for touch in single.iter().filter(|t| sound && is_face(t)) {
                // In a nearly flat valley (SAME_PLANE) either of two faces may stand for both.
                let kept = found.iter().any(|f| {
                    (f.gap - touch.gap).abs() < 1e-5 && (f.normal - touch.normal).length() < 5e-3
                });
                prop_assert!(kept, "{:?} of {:?}, kept {:?}", touch, single, found);
            }
        }
    }
}
