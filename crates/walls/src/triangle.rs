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
    /// Which of the given corners is the first of `corners`.
    first: usize,
    /// Bit k: edge k (of `corners`) belongs to this triangle, not to a neighbour.
    owned: u8,
    /// For an owned edge with one neighbour, the neighbour's inward vector across it; else zero.
    beyond: [DVec3; 3],
}

impl Triangle {
    /// Prepares a triangle; `None` where it has no area.
    ///
    /// The normal is made perpendicular to the longest edge to rounding, so that distances hold
    /// even for triangles a million times longer than wide.
    pub(crate) fn new(points: [DVec3; 3]) -> Option<Self> {
        let first = longest_edge(points);
        let corners = [0, 1, 2].map(|k| points[(first + k) % 3]);
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
            first,
            owned: ALL,
            beyond: [DVec3::ZERO; 3],
        })
    }

    /// Position among `corners` of the edge from the `k`-th given corner to the next one.
    fn edge(&self, k: usize) -> usize {
        (k + 3 - self.first) % 3
    }

    /// The inward vector across the edge from the `k`-th given corner.
    pub(crate) fn inward(&self, k: usize) -> DVec3 {
        self.inward[self.edge(k)]
    }

    /// Gives the edge from the `k`-th given corner away to a neighbour that shares it.
    pub(crate) fn give_away(&mut self, k: usize) {
        self.owned &= !(1 << self.edge(k));
    }

    /// Tells the inward vector of the one neighbour at the edge from the `k`-th given corner.
    pub(crate) fn set_beyond(&mut self, k: usize, inward: DVec3) {
        self.beyond[self.edge(k)] = inward;
    }

    /// As [`Triangle::distance`], but `None` also where the closest point cannot be one of the
    /// whole mesh around it, because a neighbour has the same point or a nearer one:
    ///
    /// - on an edge that belongs to a neighbour,
    /// - between the ends of an edge whose neighbour has the point above its inside.
    ///
    /// Each time the neighbour is at most as far and of lower number, or truly nearer, so there is
    /// always one that answers.
    pub(crate) fn hit(&self, point: DVec3, limit: f64) -> Option<(f64, DVec3)> {
        self.nearest::<true>(point, limit)
    }

    /// Distance from `point` and unit vector towards the closest point of the triangle, or `None`
    /// where that is farther than `limit`.
    ///
    /// On the triangle itself (distance 0) the direction is against the triangle's normal.
    pub(crate) fn distance(&self, point: DVec3, limit: f64) -> Option<(f64, DVec3)> {
        self.nearest::<false>(point, limit)
    }

    #[inline(always)]
    fn nearest<const HIT: bool>(&self, point: DVec3, limit: f64) -> Option<(f64, DVec3)> {
        let from = self.corners.map(|corner| point - corner);
        let height = from[0].dot(self.normal);
        if height.abs() > limit {
            return None;
        }
        let depth = [0, 1, 2].map(|k| from[k].dot(self.inward[k]));
        let outside = [0, 1, 2].map(|k| u8::from(depth[k] < 0.0) << k);
        if depth[0] >= 0.0 && depth[1] >= 0.0 && depth[2] >= 0.0 {
            let direction = if height < 0.0 { self.normal } else { -self.normal };
            return Some((height.abs(), direction));
        }
        // The closest point of a convex polygon lies on an edge that the point is outside of.
        let mut answering = if HIT { self.owned } else { ALL };
        let mut at = [0.0; 3];
        for k in 0..3 {
            if outside[k] == 0 {
                continue;
            }
            let edge = self.corners[(k + 1) % 3] - self.corners[k];
            at[k] = from[k].dot(edge) * self.per_length2[k];
            let between = at[k] > 0.0 && at[k] < 1.0;
            if HIT && between && from[k].dot(self.beyond[k]) > SURELY_INSIDE * limit {
                answering &= !outside[k];
            }
        }
        if (outside[0] | outside[1] | outside[2]) & answering == 0 {
            return None;
        }
        let (mut best, mut best2, mut best_edge) = (DVec3::ZERO, f64::INFINITY, 0);
        for k in 0..3 {
            if outside[k] == 0 {
                continue;
            }
            let edge = self.corners[(k + 1) % 3] - self.corners[k];
            let towards = edge * at[k].clamp(0.0, 1.0) - from[k];
            let distance2 = towards.length_squared();
            if distance2 < best2 {
                (best, best2, best_edge) = (towards, distance2, outside[k]);
            }
        }
        let distance = best2.sqrt();
        if distance > limit || best_edge & answering == 0 {
            return None;
        }
        if distance < f64::MIN_POSITIVE.sqrt() {
            return Some((distance, -self.normal));
        }
        Some((distance, best / distance))
    }
}

/// A point is above a neighbour's inside when it is in by this part of the limit: far above
/// rounding, so that of two triangles not both can leave the answer to the other.
const SURELY_INSIDE: f64 = 1e-6;

/// All three edges.
const ALL: u8 = 0b111;

/// Which corner the longest edge starts from.
fn longest_edge([a, b, c]: [DVec3; 3]) -> usize {
    let (ab, bc, ca) = (a.distance_squared(b), b.distance_squared(c), c.distance_squared(a));
    if ab >= bc && ab >= ca {
        0
    } else if bc >= ca {
        1
    } else {
        2
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Least value of a convex function on [0, 1] by ternary search.
    fn least(f: impl Fn(f64) -> f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..80 {
            let third = (high - low) / 3.0;
            if f(low + third) < f(high - third) {
                high -= third;
            } else {
                low += third;
            }
        }
        f(0.5 * (low + high)).min(f(0.0)).min(f(1.0))
    }

    /// Distance by brute force: the distance is a convex function over the triangle.
    fn searched([a, b, c]: [DVec3; 3], point: DVec3) -> f64 {
        least(|u| least(|v| (a + ((b - a) + (c - b) * v) * u - point).length()))
    }

    fn vector(size: f64) -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-size..size).prop_map(DVec3::from_array)
    }

    proptest! {
        #[test]
        fn distance_as_by_brute_force(
            a in vector(1.0), b in vector(1.0), c in vector(1.0), point in vector(1.5),
            // From well shaped to slivers a million times longer than wide.
            width in prop_oneof![Just(1.0), Just(1e-3), Just(1e-6)],
        ) {
            let c = a + (b - a) * 0.4 + (c - a) * width;
            let Some(triangle) = Triangle::new([a, b, c]) else { return Ok(()) };
            let (distance, normal) = triangle.distance(point, 10.0).unwrap();
            let expected = searched([a, b, c], point);
            // The search is good to about sqrt(rounding) in position, rounding in distance
            // unless that is small.
            prop_assert!((distance - expected).abs() < 1e-7, "{distance} {expected}");
            prop_assert!(distance <= expected + 1e-14);
            prop_assert!((normal.length() - 1.0).abs() < 1e-14);
            // The closest point is on the triangle.
            prop_assert!(searched([a, b, c], point + normal * distance) < 1e-7);
            // The limit cuts exactly there.
            prop_assert!(triangle.distance(point, distance * (1.0 - 1e-9)).is_none());
            prop_assert!(triangle.distance(point, distance * (1.0 + 1e-9)).is_some());
        }

        #[test]
        fn distance_as_by_parry(
            a in vector(1.0), b in vector(1.0), c in vector(1.0), point in vector(1.5),
        ) {
            use parry3d::query::PointQuery;
            let Some(triangle) = Triangle::new([a, b, c]) else { return Ok(()) };
            let (distance, _) = triangle.distance(point, 10.0).unwrap();
            let other = parry3d::shape::Triangle::new(a, b, c);
            let expected = other.distance_to_local_point(point, false);
            prop_assert!((distance - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn corners_edges_and_face_of_a_known_triangle() {
        let t = Triangle::new([DVec3::ZERO, DVec3::X * 3.0, DVec3::Y * 4.0]).unwrap();
        let at = |x, y, z| t.distance(DVec3::new(x, y, z), 100.0).unwrap();
        assert_eq!(at(1.0, 1.0, 2.0), (2.0, -DVec3::Z));
        assert_eq!(at(1.0, 1.0, -2.0), (2.0, DVec3::Z));
        assert_eq!(at(-3.0, -4.0, 0.0).0, 5.0);
        assert_eq!(at(1.0, -2.0, 0.0), (2.0, DVec3::Y));
        // The hypotenuse 4x + 3y = 12 from (3, 4): (12 + 12 - 12)/5.
        assert!((at(3.0, 4.0, 0.0).0 - 2.4).abs() < 1e-15);
        // On the face, the edge and the corner itself: distance 0 and a unit direction.
        for (x, y) in [(1.0, 1.0), (1.5, 0.0), (0.0, 0.0), (1.5, 2.0)] {
            let (distance, normal) = at(x, y, 0.0);
            assert!(distance < 1e-15 && (normal.length() - 1.0).abs() < 1e-15);
        }
        assert!(t.distance(DVec3::NAN, 1.0).is_none());
    }

    #[test]
    fn no_area_is_no_triangle() {
        let (a, b) = (DVec3::new(0.1, 0.2, 0.3), DVec3::new(0.7, -0.1, 0.9));
        assert!(Triangle::new([a, a, a]).is_none());
        assert!(Triangle::new([a, b, a]).is_none());
        assert!(Triangle::new([a, b, a.lerp(b, 0.3)]).is_none());
        assert!(Triangle::new([a, b, a.lerp(b, 0.3) + DVec3::Y * 1e-12]).is_some());
        assert!(Triangle::new([DVec3::ZERO, DVec3::X * 1e-200, DVec3::Y * 1e-200]).is_none());
    }
}
