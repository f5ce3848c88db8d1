use pendular_pair::{Bridge, Mate, OutOfRange, Range};

use crate::RuptureLaw;
use crate::rupture::WillettUnequal2000;

/// Which of the three set-ups of the parabola a pair is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Two spheres.
    Sphere,
    /// A sphere and a wall with a half side of at least its radius.
    LargeWall,
    /// A sphere and a wall with a smaller half side, for example a wire.
    SmallWall,
}

impl Kind {
    /// The kind's name in table files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::LargeWall => "large_wall",
            Self::SmallWall => "small_wall",
        }
    }

    /// The kind of that name, if there is one.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Sphere, Self::LargeWall, Self::SmallWall].into_iter().find(|k| k.name() == name)
    }
}

/// Two bodies whose bridge is to be split, as the parabola sees them: two spheres.
///
/// The second radius is the other sphere's, the particle's own for a large wall, the half side
/// for a small one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair {
    kind: Kind,
    radii: [f64; 2],
    contact_angles: [f64; 2],
}

impl Pair {
    /// A pair of bodies.
    ///
    /// # Units
    /// `radius` rᵢ m, `contact_angles` [θᵢ, θⱼ] rad (sphere, mate).
    ///
    /// # Errors
    /// [`OutOfRange`] for lengths and angles that [`Bridge::new`] does not take.
    pub fn new(radius: f64, mate: Mate, contact_angles: [f64; 2]) -> Result<Self, OutOfRange> {
        // Any volume and surface tension will do: they are not part of the pair.
        Ok(Self::of(&Bridge::new(radius, mate, 1.0, contact_angles, 1.0)?))
    }

    /// The pair of a bridge.
    #[must_use]
    pub fn of(bridge: &Bridge) -> Self {
        let radius = bridge.radius();
        let (kind, second) = match bridge.mate() {
            Mate::Sphere { radius } => (Kind::Sphere, radius),
            Mate::Wall { half_side } if half_side < radius => (Kind::SmallWall, half_side),
            Mate::Wall { .. } => (Kind::LargeWall, radius),
        };
        Self { kind, radii: [radius, second], contact_angles: bridge.contact_angles() }
    }

    /// What the second body is.
    #[must_use]
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// Radii of the two spheres that the profile hangs on, m.
    #[must_use]
    pub fn radii(&self) -> [f64; 2] {
        self.radii
    }

    /// Contact angles [θᵢ, θⱼ], rad.
    #[must_use]
    pub fn contact_angles(&self) -> [f64; 2] {
        self.contact_angles
    }

    /// Length R of V* = V/R³ here, m: the harmonic mean of [`Pair::radii`].
    ///
    /// Against a large wall that is the particle's radius, half of what
    /// [`Bridge::harmonic_radius`] gives there: the profile is that of two equal spheres.
    #[must_use]
    pub fn scale(&self) -> f64 {
        let [i, j] = self.radii;
        2.0 * (i * j / (i + j))
    }

    /// V* of a volume in m³, on [`Pair::scale`].
    #[must_use]
    pub fn v_star(&self, volume: f64) -> f64 {
        (volume.cbrt() / self.scale()).powi(3)
    }

    /// Volume of a V*, m³.
    #[must_use]
    pub fn volume(&self, v_star: f64) -> f64 {
        v_star * self.scale().powi(3)
    }

    /// Gap at which the bridge is taken to part, m: [`WillettUnequal2000`] of [`Pair::radii`].
    ///
    /// # Errors
    /// [`OutOfRange`] if the volume is not positive, or beyond the formula's turning point.
    pub fn rupture_distance(&self, volume: f64) -> Result<f64, OutOfRange> {
        let mate = Mate::Sphere { radius: self.radii[1] };
        let bridge = Bridge::new(self.radii[0], mate, volume, self.contact_angles, 1.0)?;
        WillettUnequal2000.distance(&bridge, Range::Extrapolate)
    }

    /// The same pair seen from the other sphere; `None` against a wall.
    #[must_use]
    pub fn swapped(&self) -> Option<Self> {
        let [i, j] = self.radii;
        let [ti, tj] = self.contact_angles;
        let other = Self { kind: Kind::Sphere, radii: [j, i], contact_angles: [tj, ti] };
        (self.kind == Kind::Sphere).then_some(other)
    }

    /// Whether a transfer table of `other` serves this pair: same kind, angles and size ratio.
    pub(super) fn similar(&self, other: &Self) -> bool {
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs().max(b.abs());
        self.kind == other.kind
            && near(self.radii[0] * other.radii[1], self.radii[1] * other.radii[0])
            && near(self.contact_angles[0], other.contact_angles[0])
            && near(self.contact_angles[1], other.contact_angles[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(radius: f64, mate: Mate) -> Pair {
        Pair::new(radius, mate, [0.2, 0.3]).unwrap()
    }

    #[test]
    fn kinds_and_scales() {
        let sphere = pair(3.0, Mate::Sphere { radius: 1.0 });
        assert_eq!((sphere.kind(), sphere.scale()), (Kind::Sphere, 1.5));
        let wall = pair(3.0, Mate::PLANE);
        assert_eq!((wall.kind(), wall.scale()), (Kind::LargeWall, 3.0));
        assert_eq!(pair(3.0, Mate::Wall { half_side: 3.0 }).kind(), Kind::LargeWall);
        let wire = pair(3.0, Mate::Wall { half_side: 1.0 });
        assert_eq!((wire.kind(), wire.scale()), (Kind::SmallWall, 1.5));
        assert_eq!(wire.swapped(), None);
        assert_eq!(sphere.swapped().and_then(|p| p.swapped()), Some(sphere));
    }

    #[test]
    fn volumes_and_names_round_trip() {
        let p = pair(3.0, Mate::Sphere { radius: 1.0 });
        assert!((p.v_star(p.volume(1e-5)) / 1e-5 - 1.0).abs() < 1e-14);
        for kind in [Kind::Sphere, Kind::LargeWall, Kind::SmallWall] {
            assert_eq!(Kind::from_name(kind.name()), Some(kind));
        }
        assert_eq!(Kind::from_name("plane"), None);
    }

    #[test]
    fn similar_pairs_share_kind_angles_and_ratio() {
        let p = pair(5e-3, Mate::Sphere { radius: 3.5e-3 });
        assert!(p.similar(&pair(10.0, Mate::Sphere { radius: 7.0 })));
        assert!(!p.similar(&pair(3.5e-3, Mate::Sphere { radius: 5e-3 })));
        assert!(!p.similar(&pair(5e-3, Mate::Wall { half_side: 3.5e-3 })));
        assert!(!p.similar(&Pair { contact_angles: [0.2, 0.31], ..p }));
    }
}
