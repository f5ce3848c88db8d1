use glam::DVec3;

use crate::touch::Touch;
use crate::{Tessellation, WallError};

/// A half-space: everything behind a plane is solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    point: DVec3,
    normal: DVec3,
    area: f64,
}

impl Plane {
    /// A plane through `point` (m) whose `normal` (any length) points out of the solid, to the
    /// side where spheres are. `area` (m²) is the area of its one element.
    ///
    /// # Errors
    /// [`WallError::OutOfRange`] unless all coordinates are finite, the normal is not zero and the
    /// area is positive and finite.
    pub fn new(point: DVec3, normal: DVec3, area: f64) -> Result<Self, WallError> {
        WallError::finite("plane", "point", point)?;
        WallError::finite("plane", "normal", normal)?;
        WallError::positive("plane", "area", area)?;
        let Some(normal) = normal.try_normalize() else {
            let (part, quantity) = ("plane".into(), "length of the normal");
            let (value, allowed) = (normal.length(), (0.0, f64::MAX));
            return Err(WallError::OutOfRange { part, quantity, value, allowed });
        };
        Ok(Self { point, normal, area })
    }

    /// A point on the plane, m.
    #[must_use]
    pub fn point(&self) -> DVec3 {
        self.point
    }

    /// The unit normal, out of the solid.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Area of the one element, m².
    #[must_use]
    pub fn area(&self) -> f64 {
        self.area
    }

    /// A square of the plane's area around its point.
    #[must_use]
    pub fn tessellation(&self) -> Tessellation {
        let (u, v) = self.normal.any_orthonormal_pair();
        let half = 0.5 * self.area.sqrt();
        let corner = |a: f64, b: f64| self.point + u * (a * half) + v * (b * half);
        Tessellation {
            points: vec![corner(-1., -1.), corner(1., -1.), corner(1., 1.), corner(-1., 1.)],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            elements: vec![0, 0],
        }
    }

    /// Signed distance of a point from the plane, m; negative in the solid.
    #[inline]
    pub(crate) fn height(&self, point: DVec3) -> f64 {
        (point - self.point).dot(self.normal)
    }

    #[inline]
    pub(crate) fn touch(&self, centre: DVec3, radius: f64) -> Touch {
        Touch { element: 0, gap: self.height(centre) - radius, normal: -self.normal }
    }
}
