use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};

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
        give_shared_edges_to_one(&indices, &mut triangles);
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

/// Leaves each edge to the first triangle that has it, so that it is looked at once.
fn give_shared_edges_to_one(indices: &[[u32; 3]], triangles: &mut [Triangle]) {
    let mut known = HashSet::new();
    for (corners, triangle) in indices.iter().zip(triangles) {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            if !known.insert((a.min(b), a.max(b))) {
                triangle.give_away(k);
            }
        }
    }
}
