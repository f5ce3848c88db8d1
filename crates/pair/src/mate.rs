/// The second body of a bridge.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Mate {
    /// Another sphere.
    Sphere {
        /// Radius r_j of the sphere, m; greater than 0.
        radius: f64,
    },
    /// A wall. Force laws see it as a plane; the formation rules tell a large wall from a wire.
    Wall {
        /// Half the wall's width, m; greater than 0. A wire's radius, `f64::INFINITY` for a plane.
        half_side: f64,
    },
}

impl Mate {
    /// An unbounded plane.
    pub const PLANE: Self = Self::Wall { half_side: f64::INFINITY };

    /// The radius that a force law sees, m: the sphere's, or `f64::INFINITY` for a wall.
    #[must_use]
    pub fn radius(self) -> f64 {
        match self {
            Self::Sphere { radius } => radius,
            Self::Wall { .. } => f64::INFINITY,
        }
    }

    /// Whether the second body is a wall.
    #[must_use]
    pub fn is_wall(self) -> bool {
        matches!(self, Self::Wall { .. })
    }
}
