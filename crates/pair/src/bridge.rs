use crate::{Mate, OutOfRange};

/// What is constant over the life of a pendular bridge.
///
/// The fields are checked once, in [`Bridge::new`]; every `Bridge` that exists is valid, so laws
/// need not look again.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Bridge {
    radius: f64,
    mate: Mate,
    volume: f64,
    contact_angles: [f64; 2],
    surface_tension: f64,
}

impl Bridge {
    /// A bridge between a sphere and its mate.
    ///
    /// # Units
    /// `radius` r_i m, `volume` V m³, `contact_angles` [θ_i, θ_j] rad (first body, mate),
    /// `surface_tension` σ N/m.
    ///
    /// # Errors
    /// [`OutOfRange`] unless all lengths, the volume and the surface tension are positive and
    /// finite (a wall's `half_side` may be infinite) and both contact angles lie in [0, π).
    pub fn new(
        radius: f64,
        mate: Mate,
        volume: f64,
        contact_angles: [f64; 2],
        surface_tension: f64,
    ) -> Result<Self, OutOfRange> {
        OutOfRange::positive("radius", radius)?;
        match mate {
            Mate::Sphere { radius } => OutOfRange::positive("mate radius", radius)?,
            Mate::Wall { half_side } if half_side == f64::INFINITY => {}
            Mate::Wall { half_side } => OutOfRange::positive("wall half side", half_side)?,
        }
        OutOfRange::positive("bridge volume", volume)?;
        for angle in contact_angles {
            if !(0.0..std::f64::consts::PI).contains(&angle) {
                let allowed = (0.0, std::f64::consts::PI);
                return Err(OutOfRange { quantity: "contact angle", value: angle, allowed });
            }
        }
        OutOfRange::positive("surface tension", surface_tension)?;
        Ok(Self { radius, mate, volume, contact_angles, surface_tension })
    }

    /// Radius r_i of the first sphere, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The second body.
    #[must_use]
    pub fn mate(&self) -> Mate {
        self.mate
    }

    /// Volume V, m³.
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Contact angles [θ_i, θ_j] on the first sphere and on its mate, rad.
    #[must_use]
    pub fn contact_angles(&self) -> [f64; 2] {
        self.contact_angles
    }

    /// Surface tension σ, N/m.
    #[must_use]
    pub fn surface_tension(&self) -> f64 {
        self.surface_tension
    }

    /// Harmonic (Derjaguin) radius R = 2 r_i r_j/(r_i + r_j), m; 2 r_i against a wall.
    #[must_use]
    pub fn harmonic_radius(&self) -> f64 {
        2.0 * self.reduced_radius()
    }

    /// Reduced radius R* = r_i r_j/(r_i + r_j) = R/2, m; r_i against a wall.
    #[must_use]
    pub fn reduced_radius(&self) -> f64 {
        match self.mate {
            Mate::Sphere { radius } => self.radius * radius / (self.radius + radius),
            Mate::Wall { .. } => self.radius,
        }
    }

    /// Larger over smaller radius, at least 1; `f64::INFINITY` against a wall.
    #[must_use]
    pub fn radius_ratio(&self) -> f64 {
        let mate = self.mate.radius();
        self.radius.max(mate) / self.radius.min(mate)
    }

    /// Mean contact angle θ = (θ_i + θ_j)/2, rad.
    #[must_use]
    pub fn mean_contact_angle(&self) -> f64 {
        0.5 * (self.contact_angles[0] + self.contact_angles[1])
    }

    /// cos θ_i + cos θ_j.
    #[must_use]
    pub fn cosine_sum(&self) -> f64 {
        self.contact_angles[0].cos() + self.contact_angles[1].cos()
    }

    /// Dimensionless volume V* = V/R³ with the harmonic radius R.
    #[must_use]
    pub fn v_star(&self) -> f64 {
        self.volume / self.harmonic_radius().powi(3)
    }

    /// The same bridge seen from the other sphere; `None` against a wall.
    #[must_use]
    pub fn swapped(&self) -> Option<Self> {
        match self.mate {
            Mate::Wall { .. } => None,
            Mate::Sphere { radius } => Some(Self {
                radius,
                mate: Mate::Sphere { radius: self.radius },
                contact_angles: [self.contact_angles[1], self.contact_angles[0]],
                ..*self
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radii_by_hand() {
        let b = Bridge::new(3.0, Mate::Sphere { radius: 1.0 }, 2.0, [0.1, 0.3], 1.0).unwrap();
        assert_eq!(b.harmonic_radius(), 1.5);
        assert_eq!(b.reduced_radius(), 0.75);
        assert_eq!(b.radius_ratio(), 3.0);
        assert_eq!(b.v_star(), 2.0 / 3.375);
        assert_eq!(b.swapped().unwrap().swapped(), Some(b));
    }

    #[test]
    fn a_plane_is_the_limit_of_a_large_sphere() {
        let plane = Bridge::new(1.0, Mate::PLANE, 1.0, [0.0; 2], 1.0).unwrap();
        let sphere = Bridge::new(1.0, Mate::Sphere { radius: 1e12 }, 1.0, [0.0; 2], 1.0).unwrap();
        assert!((plane.harmonic_radius() - sphere.harmonic_radius()).abs() < 1e-11);
    }

    #[test]
    fn bad_values_name_the_quantity() {
        let bad = |r, m, v, t, s| Bridge::new(r, m, v, [t, 0.0], s).unwrap_err().quantity;
        assert_eq!(bad(f64::NAN, Mate::PLANE, 1.0, 0.0, 1.0), "radius");
        assert_eq!(bad(0.0, Mate::PLANE, 1.0, 0.0, 1.0), "radius");
        assert_eq!(bad(1.0, Mate::Sphere { radius: -1.0 }, 1.0, 0.0, 1.0), "mate radius");
        assert_eq!(bad(1.0, Mate::Wall { half_side: 0.0 }, 1.0, 0.0, 1.0), "wall half side");
        assert_eq!(bad(1.0, Mate::PLANE, -1.0, 0.0, 1.0), "bridge volume");
        assert_eq!(bad(1.0, Mate::PLANE, 1.0, std::f64::consts::PI, 1.0), "contact angle");
        assert_eq!(bad(1.0, Mate::PLANE, 1.0, f64::NAN, 1.0), "contact angle");
        assert_eq!(bad(1.0, Mate::PLANE, 1.0, 0.0, f64::INFINITY), "surface tension");
    }
}
