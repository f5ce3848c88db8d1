//! A triangle prepared for many closest-point queries.

use glam::DVec3;

/// A triangle with its normals worked out once.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Triangle {
    /// Corners; the first two span the longest edge.
    corners: [DVec3; 3],
    /// Unit normal.
    normal: DVec3,
    /// Unit vectors in the plane, across edge k (corner k to k + 1), pointing inwards.
    inward: [DVec3; 3],
    /// 1/(length of edge k)².
    per_length2: [f64; 3],
}

impl Triangle {
    /// Prepares a triangle; `None` where it has no area.
    ///
    /// The normal is made perpendicular to the longest edge to rounding, so that distances hold
    /// even for triangles a million times longer than wide.
    pub(crate) fn new(points: [DVec3; 3]) -> Option<Self> {
        let corners = longest_edge_first(points);
        let edge = corners[1] - corners[0];
        let side = corners[2] - corners[0];
        let along = edge.try_normalize()?;
        let height = side - along * side.dot(along);
        let size = corners.iter().map(|c| c.abs().max_element()).fold(0.0, f64::max);
        // Below this the direction of the normal is made of rounding errors alone.
        if height.length() <= 8.0 * f64::EPSILON * size {
            return None;
        }
        let across = (height - along * height.dot(along)).try_normalize()?;
        let normal = along.cross(across).try_normalize()?;
        let mut inward = [across; 3];
        let mut per_length2 = [0.0; 3];
        for k in 0..3 {
            let edge = corners[(k + 1) % 3] - corners[k];
            per_length2[k] = 1.0 / edge.length_squared();
            if k > 0 {
                inward[k] = normal.cross(edge).try_normalize()?;
            }
        }
        per_length2.iter().all(|l| l.is_finite()).then_some(Self {
            corners,
            normal,
            inward,
            per_length2,
        })
    }

    /// Distance from `point` and unit vector towards the closest point of the triangle, or `None`
    /// where that is farther than `limit`.
    ///
    /// On the triangle itself (distance 0) the direction is against the triangle's normal.
    pub(crate) fn nearest(&self, point: DVec3, limit: f64) -> Option<(f64, DVec3)> {
        let height = (point - self.corners[0]).dot(self.normal);
        if height.abs() > limit {
            return None;
        }
        let mut inside = true;
        let mut best = DVec3::ZERO;
        let mut best2 = f64::INFINITY;
        for k in 0..3 {
            let from = point - self.corners[k];
            let depth = from.dot(self.inward[k]);
            if depth >= 0.0 {
                continue;
            }
            if depth < -limit {
                return None;
            }
            // The closest point of a convex polygon lies on an edge that the point is outside of.
            inside = false;
            let edge = self.corners[(k + 1) % 3] - self.corners[k];
            let at = (from.dot(edge) * self.per_length2[k]).clamp(0.0, 1.0);
            let towards = edge * at - from;
            let distance2 = towards.length_squared();
            if distance2 < best2 {
                best2 = distance2;
                best = towards;
            }
        }
        if inside {
            let direction = if height < 0.0 { self.normal } else { -self.normal };
            return Some((height.abs(), direction));
        }
        let distance = best2.sqrt();
        if distance > limit {
            return None;
        }
        if distance < f64::MIN_POSITIVE.sqrt() {
            return Some((distance, -self.normal));
        }
        Some((distance, best / distance))
    }
}

/// The corners turned round, in the same sense, so that the longest edge comes first.
fn longest_edge_first([a, b, c]: [DVec3; 3]) -> [DVec3; 3] {
    let (ab, bc, ca) = (a.distance_squared(b), b.distance_squared(c), c.distance_squared(a));
    if ab >= bc && ab >= ca {
        [a, b, c]
    } else if bc >= ca {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
