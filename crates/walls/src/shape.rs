use glam::DVec3;

use crate::bounds::Bounds;
use crate::touch::Touch;
use crate::{Frame, Mesh, Plane, Wire};

/// The surface of a part, in its rest position.
#[derive(Debug, Clone)]
#[allow(clippy::large_enum_variant)] // parts are few; a box would cost a jump per touch
pub enum Shape {
    /// Triangles, solid on both sides.
    Mesh(Mesh),
    /// A half-space.
    Plane(Plane),
    /// A solid cylinder touched from outside.
    Wire(Wire),
    /// A thin cylindrical shell with spheres inside.
    Frame(Frame),
}

/// Triangles for drawing a part.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tessellation {
    /// Vertices in the rest position, m.
    pub points: Vec<DVec3>,
    /// Triangles, as indices into `points`.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle the element of the part that it belongs to.
    pub elements: Vec<u32>,
}

impl Shape {
    /// Number of elements: the patches on which liquid is kept apart, at least 1.
    #[must_use]
    pub fn element_count(&self) -> u32 {
        match self {
            Self::Mesh(mesh) => mesh.indices().len() as u32,
            Self::Plane(_) => 1,
            Self::Wire(wire) => wire.segments(),
            Self::Frame(frame) => frame.patches()[0] * frame.patches()[1],
        }
    }

    /// Area of element `k`, m²; `None` where there is no such element.
    #[must_use]
    pub fn element_area(&self, k: u32) -> Option<f64> {
        if k >= self.element_count() {
            return None;
        }
        match self {
            Self::Mesh(mesh) => mesh.areas().get(k as usize).copied(),
            Self::Plane(plane) => Some(plane.area()),
            Self::Wire(wire) => Some(wire.segment_area()),
            Self::Frame(frame) => Some(frame.patch_area()),
        }
    }

    /// Triangles for drawing; `sides` is the number of sides of a cylinder.
    #[must_use]
    pub fn tessellation(&self, sides: u32) -> Tessellation {
        match self {
            Self::Mesh(mesh) => mesh.tessellation(),
            Self::Plane(plane) => plane.tessellation(),
            Self::Wire(wire) => wire.tessellation(sides),
            Self::Frame(frame) => frame.tessellation(sides),
        }
    }

    /// The box around the shape; `None` for a plane, which has none.
    pub(crate) fn bounds(&self) -> Option<Bounds> {
        match self {
            Self::Mesh(mesh) => Some(mesh.bounds()),
            Self::Plane(_) => None,
            Self::Wire(wire) => Some(wire.bounds()),
            Self::Frame(frame) => Some(frame.bounds()),
        }
    }

    /// Whether the shape may have a point within `reach` of `point` (in the part's frame).
    pub(crate) fn may_reach(&self, point: DVec3, reach: f64) -> bool {
        match self {
            Self::Mesh(mesh) => mesh.bounds().distance_squared(point) <= reach * reach,
            Self::Plane(plane) => plane.height(point) <= reach,
            Self::Wire(wire) => wire.distance(point) <= reach,
            Self::Frame(frame) => frame.distance(point) <= reach,
        }
    }

    /// As [`crate::Walls::candidates`], in the part's frame.
    pub(crate) fn candidates(&self, centre: DVec3, reach: f64, out: &mut Vec<u32>) {
        out.clear();
        if let Self::Mesh(mesh) = self {
            mesh.candidates(centre, reach, out);
        }
    }

    /// As [`crate::Walls::touches`], in the part's frame.
    pub(crate) fn touches(
        &self,
        candidates: &[u32],
        centre: DVec3,
        radius: f64,
        reach: f64,
        out: &mut Vec<Touch>,
    ) {
        let touch = match self {
            Self::Mesh(mesh) => return mesh.touches(candidates, centre, radius, reach, out),
            _ => self.single_touch(centre, radius),
        };
        if let Some(touch) = touch.filter(|touch| touch.gap <= reach) {
            out.push(touch);
        }
    }

    /// The one place where a sphere can touch a plane, a wire or a frame, whatever the gap.
    #[inline]
    pub(crate) fn single_touch(&self, centre: DVec3, radius: f64) -> Option<Touch> {
        match self {
            Self::Mesh(_) => None,
            Self::Plane(plane) => Some(plane.touch(centre, radius)),
            Self::Wire(wire) => Some(wire.touch(centre, radius)),
            Self::Frame(frame) => Some(frame.touch(centre, radius)),
        }
    }
}
