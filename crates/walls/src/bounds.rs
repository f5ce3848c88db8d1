use glam::DVec3;
use parry3d::bounding_volume::Aabb;
use parry3d::partitioning::{Bvh, BvhBuildStrategy};

/// An axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) min: DVec3,
    pub(crate) max: DVec3,
}

impl Bounds {
    /// The smallest box around points.
    pub(crate) fn around(points: impl IntoIterator<Item = DVec3>) -> Self {
        let empty = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };
        points.into_iter().fold(empty, |b, p| Self { min: b.min.min(p), max: b.max.max(p) })
    }

    /// The box enlarged by `margin` on both sides of each axis.
    pub(crate) fn enlarged(self, margin: DVec3) -> Self {
        Self { min: self.min - margin, max: self.max + margin }
    }

    /// Square of the distance from a point to the box, m²; 0 inside.
    pub(crate) fn distance_squared(self, point: DVec3) -> f64 {
        (self.min - point).max(point - self.max).max(DVec3::ZERO).length_squared()
    }

    fn aabb(self) -> Aabb {
        Aabb::new(self.min, self.max)
    }
}

/// A tree of boxes, for finding those near a point.
#[derive(Clone)]
pub(crate) struct Tree(Bvh);

impl Tree {
    /// A tree of numbered boxes.
    pub(crate) fn new(boxes: impl IntoIterator<Item = (usize, Bounds)>) -> Self {
        let leaves = boxes.into_iter().map(|(k, b)| (k, b.aabb()));
        Self(Bvh::from_iter(BvhBuildStrategy::Binned, leaves))
    }

    /// Calls `found` with each box that the cube of half side `reach` around `centre` meets.
    pub(crate) fn near(&self, centre: DVec3, reach: f64, mut found: impl FnMut(u32)) {
        let cube = Aabb::new(centre - DVec3::splat(reach), centre + DVec3::splat(reach));
        for k in self.0.intersect_aabb(&cube) {
            found(k);
        }
    }
}

impl std::fmt::Debug for Tree {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Tree")
    }
}
