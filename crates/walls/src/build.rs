//! Meshes of simple forms: rectangles, plates, boxes without a lid, prisms.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::{Mesh, WallError};

/// More elements than this along one edge are taken for a wrong unit.
const MOST: f64 = 100_000.0;

/// More pieces than this in one mesh are taken for a wrong unit.
const MOST_PIECES: f64 = 1e7;

/// A parallelogram from `corner` (m) along the edges `u` and `v` (m), cut into `cuts[0]` x
/// `cuts[1]` pieces of two triangles each.
///
/// # Errors
/// [`WallError::OutOfRange`] where a count is 0 or above 100 000, or there are more than 10⁷
/// pieces, else as [`Mesh::new`]
/// (degenerate where the edges are parallel).
pub fn rectangle(corner: DVec3, u: DVec3, v: DVec3, cuts: [u32; 2]) -> Result<Mesh, WallError> {
    for count in cuts {
        WallError::within("rectangle", "number of pieces", count.into(), (1.0, MOST))?;
    }
    let [nu, nv] = cuts;
    let total = f64::from(nu) * f64::from(nv);
    WallError::within("rectangle", "number of all pieces", total, (1.0, MOST_PIECES))?;
    let mut points = Vec::new();
    for j in 0..=nv {
        for i in 0..=nu {
            let along_u = u * (f64::from(i) / f64::from(nu));
            points.push(corner + along_u + v * (f64::from(j) / f64::from(nv)));
        }
    }
    let mut triangles = Vec::new();
    for j in 0..nv {
        for i in 0..nu {
            let a = j * (nu + 1) + i;
            let (b, c, d) = (a + 1, a + nu + 2, a + nu + 1);
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh::new(points, triangles)
}

/// A rectangular plate around `centre` (m), `length` m down the slope and `width` m across it.
///
/// It falls towards +x at `tilt` (rad) below the horizontal; its width lies along y.
///
/// # Errors
/// [`WallError::OutOfRange`] unless length and width are positive and finite, else as
/// [`rectangle`].
pub fn plate(
    centre: DVec3,
    length: f64,
    width: f64,
    tilt: f64,
    cuts: [u32; 2],
) -> Result<Mesh, WallError> {
    WallError::positive("plate", "length", length)?;
    WallError::positive("plate", "width", width)?;
    let (sin, cos) = tilt.sin_cos();
    let down = DVec3::new(cos, 0.0, -sin) * length;
    let across = DVec3::Y * width;
    rectangle(centre - 0.5 * (down + across), down, across, cuts)
}

/// The four upright walls of a box from corner `min` to corner `max` (m), open at the top, with a
/// floor at `min.z` if `floor`; each face in pieces no longer than `element_length` (m, infinite
/// for two triangles a face).
///
/// # Errors
/// [`WallError::OutOfRange`] unless `max` is above `min` along each axis and the element length is
/// positive and leaves at most 100 000 pieces along an edge and 10⁷ a face.
pub fn open_box(
    min: DVec3,
    max: DVec3,
    floor: bool,
    element_length: f64,
) -> Result<Mesh, WallError> {
    let size = max - min;
    let mut cuts = [1; 3];
    for k in 0..3 {
        WallError::positive("box", "edge", size[k])?;
        cuts[k] = pieces("box", size[k], element_length)?;
    }
    let [nx, ny, nz] = cuts;
    let (x, y, z) = (DVec3::X * size.x, DVec3::Y * size.y, DVec3::Z * size.z);
    let mut faces = vec![
        rectangle(min, x, z, [nx, nz])?,
        rectangle(min + y, x, z, [nx, nz])?,
        rectangle(min, y, z, [ny, nz])?,
        rectangle(min + x, y, z, [ny, nz])?,
    ];
    if floor {
        faces.push(rectangle(min, x, y, [nx, ny])?);
    }
    let corners = |mesh: &Mesh| -> Vec<[DVec3; 3]> {
        mesh.indices().iter().map(|t| t.map(|v| mesh.points()[v as usize])).collect()
    };
    let triangles: Vec<[DVec3; 3]> = faces.iter().flat_map(corners).collect();
    Mesh::from_triangles(&triangles)
}

/// How the polygon of a prism stands for a circle of the same nominal radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Fit {
    /// Edges on the circle, faces inside: the prism is too thin.
    Inscribed,
    /// The same volume.
    EqualVolume,
    /// Faces touch the circle: apertures between faces that stand upright are exact.
    #[default]
    Circumscribed,
}

impl Fit {
    /// Distance of the polygon's corners from the axis for a circle of `radius`, same unit.
    ///
    /// ```text
    /// r,   r √(2π/(n sin(2π/n))),   r/cos(π/n)
    /// ```
    #[must_use]
    pub fn corner_radius(self, radius: f64, sides: u32) -> f64 {
        let n = f64::from(sides);
        match self {
            Self::Inscribed => radius,
            Self::EqualVolume => radius * (TAU / (n * (TAU / n).sin())).sqrt(),
            Self::Circumscribed => radius / (PI / n).cos(),
        }
    }
}

/// A regular prism that stands for a cylinder.
///
/// Its triangles go ring by ring along the axis, then come the ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prism {
    /// Both ends of the axis, m.
    pub ends: [DVec3; 2],
    /// The middle of the first face points this way (made perpendicular to the axis). With a
    /// multiple of four sides and `up` upright two faces stand upright.
    pub up: DVec3,
    /// Radius of the cylinder it stands for, m.
    pub radius: f64,
    /// Number of faces, 3 to 100 000.
    pub sides: u32,
    /// How the polygon stands for the circle.
    pub fit: Fit,
    /// Number of pieces along the axis, 1 to 100 000.
    pub segments: u32,
    /// Whether it has flat ends.
    pub closed: bool,
}

impl Prism {
    /// The mesh.
    ///
    /// # Errors
    /// [`WallError::OutOfRange`] unless radius and length are positive and finite, `up` is not
    /// along the axis and the counts are in range.
    pub fn mesh(&self) -> Result<Mesh, WallError> {
        let [start, end] = self.ends;
        WallError::positive("prism", "radius", self.radius)?;
        WallError::within("prism", "number of sides", self.sides.into(), (3.0, MOST))?;
        WallError::within("prism", "number of segments", self.segments.into(), (1.0, MOST))?;
        let faces = f64::from(self.sides) * f64::from(self.segments);
        WallError::within("prism", "number of all faces", faces, (3.0, MOST_PIECES))?;
        WallError::positive("prism", "length", start.distance(end))?;
        let axis = (end - start).normalize();
        let up = self.up - axis * self.up.dot(axis);
        // An `up` along the axis leaves rounding errors only.
        let least = (1e-9 * self.up.length(), f64::MAX);
        WallError::within("prism", "part of `up` across the axis", up.length(), least)?;
        WallError::positive("prism", "part of `up` across the axis", up.length())?;
        let points = self.points(axis, up.normalize());
        Mesh::new(points, self.triangles())
    }

    fn points(&self, axis: DVec3, up: DVec3) -> Vec<DVec3> {
        let [start, end] = self.ends;
        let aside = axis.cross(up);
        let corner_radius = self.fit.corner_radius(self.radius, self.sides);
        let mut points = Vec::new();
        for ring in 0..=self.segments {
            let foot = start + (end - start) * (f64::from(ring) / f64::from(self.segments));
            for side in 0..self.sides {
                let (sin, cos) = (TAU * (f64::from(side) - 0.5) / f64::from(self.sides)).sin_cos();
                points.push(foot + (up * cos + aside * sin) * corner_radius);
            }
        }
        points
    }

    fn triangles(&self) -> Vec<[u32; 3]> {
        let sides = self.sides;
        let mut triangles = Vec::new();
        for ring in 0..self.segments {
            for side in 0..sides {
                let (a, b) = (ring * sides + side, ring * sides + (side + 1) % sides);
                triangles.extend([[a, b, b + sides], [a, b + sides, a + sides]]);
            }
        }
        if self.closed {
            let last = self.segments * sides;
            for side in 1..sides - 1 {
                triangles.extend([[0, side + 1, side], [last, last + side, last + side + 1]]);
            }
        }
        triangles
    }
}

/// Number of equal pieces, none longer than `element_length`, that make up `length` (m).
pub(crate) fn pieces(part: &str, length: f64, element_length: f64) -> Result<u32, WallError> {
    let allowed = (length / MOST, f64::INFINITY);
    WallError::within(part, "element length", element_length, allowed)?;
    // A whole number of elements must not gain one more by rounding.
    Ok(((length / element_length * (1.0 - 1e-12)).ceil()).max(1.0) as u32)
}
