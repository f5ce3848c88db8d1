use std::f64::consts::TAU;

use glam::DVec3;

use crate::bounds::Bounds;
use crate::touch::Touch;
use crate::{Tessellation, WallError};

/// Axis, radius and directions of a finite cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cylinder {
    pub(crate) start: DVec3,
    /// Unit vectors: along the axis, and two across it from which angles count.
    pub(crate) axis: DVec3,
    pub(crate) across: [DVec3; 2],
    pub(crate) length: f64,
    pub(crate) radius: f64,
}

/// Where a point is, seen from a cylinder.
struct Place {
    /// Distance from the start along the axis, m.
    along: f64,
    /// Distance from the axis, m.
    radial: f64,
    /// Unit vector from the axis to the point.
    outward: DVec3,
}

impl Cylinder {
    fn new(kind: &str, start: DVec3, end: DVec3, radius: f64) -> Result<Self, WallError> {
        WallError::finite(kind, "start", start)?;
        WallError::finite(kind, "end", end)?;
        WallError::positive(kind, "radius", radius)?;
        let length = start.distance(end);
        WallError::positive(kind, "length", length)?;
        let axis = (end - start) / length;
        let (u, v) = axis.any_orthonormal_pair();
        Ok(Self { start, axis, across: [u, v], length, radius })
    }

    fn place(&self, point: DVec3) -> Place {
        let from = point - self.start;
        let along = from.dot(self.axis);
        let across = from - self.axis * along;
        let radial = across.length();
        // On the axis any direction will do.
        let outward = if radial > 0.0 { across / radial } else { self.across[0] };
        Place { along, radial, outward }
    }

    fn bounds(&self) -> Bounds {
        // Half extent of a disc of normal a along x: r sqrt(1 - a_x²).
        let cross = (DVec3::ONE - self.axis * self.axis).max(DVec3::ZERO);
        let margin = DVec3::new(cross.x.sqrt(), cross.y.sqrt(), cross.z.sqrt()) * self.radius;
        Bounds::around([self.start, self.start + self.axis * self.length]).enlarged(margin)
    }

    /// Which of `count` equal segments along the axis holds a position.
    fn segment(&self, along: f64, count: u32) -> u32 {
        // A cast of a negative float gives 0.
        ((along / self.length * f64::from(count)) as u32).min(count - 1)
    }

    /// The lateral surface as `rings` x `sides` rectangles, element given by ring and side.
    fn surface(&self, rings: u32, sides: u32, element: impl Fn(u32, u32) -> u32) -> Tessellation {
        let mut mesh = Tessellation::default();
        for ring in 0..=rings {
            let foot = self.start + self.axis * (self.length * f64::from(ring) / f64::from(rings));
            for side in 0..sides {
                let (sin, cos) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
                let out = self.across[0] * cos + self.across[1] * sin;
                mesh.points.push(foot + out * self.radius);
            }
        }
        for ring in 0..rings {
            for side in 0..sides {
                let (a, b) = (ring * sides + side, ring * sides + (side + 1) % sides);
                mesh.triangles.extend([[a, b, b + sides], [a, b + sides, a + sides]]);
                mesh.elements.extend([element(ring, side); 2]);
            }
        }
        mesh
    }
}

/// A straight round wire: a solid cylinder with flat ends, touched from outside.
///
/// Its elements are equal segments along the axis, counted from the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wire {
    cylinder: Cylinder,
    segments: u32,
}

impl Wire {
    /// A wire of `radius` (m) from `start` to `end` (m) with `segments` elements along it.
    ///
    /// # Errors
    /// [`WallError::OutOfRange`] unless coordinates are finite, radius and length positive and
    /// finite, and there is at least one segment.
    pub fn new(start: DVec3, end: DVec3, radius: f64, segments: u32) -> Result<Self, WallError> {
        WallError::count("wire", "number of segments", segments, 1)?;
        Ok(Self { cylinder: Cylinder::new("wire", start, end, radius)?, segments })
    }

    /// Both ends of the axis, m.
    #[must_use]
    pub fn ends(&self) -> [DVec3; 2] {
        let c = &self.cylinder;
        [c.start, c.start + c.axis * c.length]
    }

    /// Radius, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.cylinder.radius
    }

    /// Number of elements.
    #[must_use]
    pub fn segments(&self) -> u32 {
        self.segments
    }

    /// Lateral area of each element, m²; the flat ends count for nothing.
    #[must_use]
    pub fn segment_area(&self) -> f64 {
        TAU * self.cylinder.radius * self.cylinder.length / f64::from(self.segments)
    }

    /// The lateral surface and the ends with `sides` (at least 3) sides.
    #[must_use]
    pub fn tessellation(&self, sides: u32) -> Tessellation {
        let sides = sides.max(3);
        let mut mesh = self.cylinder.surface(self.segments, sides, |ring, _| ring);
        let last = self.segments * sides;
        for side in 1..sides - 1 {
            mesh.triangles.push([0, side + 1, side]);
            mesh.triangles.push([last, last + side, last + side + 1]);
            mesh.elements.extend([0, self.segments - 1]);
        }
        mesh
    }

    pub(crate) fn bounds(&self) -> Bounds {
        self.cylinder.bounds()
    }

    /// Distance to the solid, m; negative in it.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        self.nearest(point).0
    }

    pub(crate) fn touch(&self, centre: DVec3, radius: f64) -> Touch {
        let (distance, normal, along) = self.nearest(centre);
        let element = self.cylinder.segment(along, self.segments);
        Touch { element, gap: distance - radius, normal }
    }

    /// Signed distance, unit vector towards the surface (inwards) and position along the axis.
    fn nearest(&self, point: DVec3) -> (f64, DVec3, f64) {
        let c = &self.cylinder;
        let Place { along, radial, outward } = c.place(point);
        let side = radial - c.radius;
        let end = (-along).max(along - c.length);
        let out_of_end = if along < 0.5 * c.length { -c.axis } else { c.axis };
        if end <= 0.0 && (side > 0.0 || side >= end) {
            (side, -outward, along)
        } else if side <= 0.0 {
            (end, -out_of_end, along)
        } else {
            // Beyond an end and beside it: the rim is nearest.
            let distance = side.hypot(end);
            (distance, -(outward * side + out_of_end * end) / distance, along)
        }
    }
}

/// A round frame or pipe: a thin cylindrical shell, open at both ends, spheres inside it.
///
/// A sphere touches it from outside as well, and at the rims of the open ends. Only the nearest
/// point counts, so a sphere nearly as wide as the pipe has one touch. Its elements are patches:
/// `height · around + angle`, the angle counted from an arbitrary but fixed direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    cylinder: Cylinder,
    around: u32,
    along: u32,
}

impl Frame {
    /// A frame of `radius` (m) around the axis from `start` to `end` (m) with `patches` elements
    /// around and along it.
    ///
    /// # Errors
    /// [`WallError::OutOfRange`] unless coordinates are finite, radius and length positive and
    /// finite, and there is at least one patch each way.
    pub fn new(
        start: DVec3,
        end: DVec3,
        radius: f64,
        patches: [u32; 2],
    ) -> Result<Self, WallError> {
        WallError::count("frame", "number of patches around", patches[0], 1)?;
        WallError::count("frame", "number of patches along", patches[1], 1)?;
        let patch_count = f64::from(patches[0]) * f64::from(patches[1]);
        WallError::within("frame", "number of patches", patch_count, (1.0, f64::from(u32::MAX)))?;
        let cylinder = Cylinder::new("frame", start, end, radius)?;
        Ok(Self { cylinder, around: patches[0], along: patches[1] })
    }

    /// Both ends of the axis, m.
    #[must_use]
    pub fn ends(&self) -> [DVec3; 2] {
        let c = &self.cylinder;
        [c.start, c.start + c.axis * c.length]
    }

    /// Inner radius, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.cylinder.radius
    }

    /// Number of elements around and along the frame.
    #[must_use]
    pub fn patches(&self) -> [u32; 2] {
        [self.around, self.along]
    }

    /// Area of each element, m² (the inner side).
    #[must_use]
    pub fn patch_area(&self) -> f64 {
        TAU * self.cylinder.radius * self.cylinder.length
            / (f64::from(self.around) * f64::from(self.along))
    }

    /// The surface with at least `sides` sides, a multiple of the patches around.
    #[must_use]
    pub fn tessellation(&self, sides: u32) -> Tessellation {
        let per_patch = sides.max(3).div_ceil(self.around);
        self.cylinder.surface(self.along, per_patch * self.around, |ring, side| {
            ring * self.around + side / per_patch
        })
    }

    pub(crate) fn bounds(&self) -> Bounds {
        self.cylinder.bounds()
    }

    /// Distance to the shell, m.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        let place = self.cylinder.place(point);
        let side = place.radial - self.cylinder.radius;
        let end = (-place.along).max(place.along - self.cylinder.length).max(0.0);
        (side * side + end * end).sqrt()
    }

    pub(crate) fn touch(&self, centre: DVec3, radius: f64) -> Touch {
        let c = &self.cylinder;
        let place = c.place(centre);
        let side = place.radial - c.radius;
        // Vector from the centre to the nearest point of the shell.
        let back = place.along - place.along.clamp(0.0, c.length);
        let (distance, normal) = if back == 0.0 {
            (side.abs(), if side > 0.0 { -place.outward } else { place.outward })
        } else {
            let distance = side.hypot(back);
            (distance, -(place.outward * side + c.axis * back) / distance)
        };
        Touch { element: self.patch(&place), gap: distance - radius, normal }
    }

    fn patch(&self, place: &Place) -> u32 {
        let c = &self.cylinder;
        let row = if self.along == 1 { 0 } else { c.segment(place.along, self.along) };
        if self.around == 1 {
            return row;
        }
        let angle = place.outward.dot(c.across[1]).atan2(place.outward.dot(c.across[0]));
        let turn = if angle < 0.0 { angle + TAU } else { angle } / TAU;
        row * self.around + ((turn * f64::from(self.around)) as u32).min(self.around - 1)
    }
}
