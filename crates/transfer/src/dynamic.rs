use pendular_pair::{Bridge, OutOfRange};

/// How much longer a bridge lives when its bodies move apart fast.
///
/// The static rupture distance of a [`RuptureLaw`](crate::RuptureLaw) is multiplied by a factor of
/// at least 1:
///
/// ```text
/// Pitois2001   1 + √Ca,   Ca = v η/σ
/// Grohn2022    (1 + C v)^(2/3),   C = 6.266 s/m (two spheres), 4.424 s/m (sphere and wall)
/// ```
/// v is the magnitude of the relative velocity of the bodies, m/s: the velocity under the root is
/// printed as a vector in Elskamp & Kruggel-Emden (2018), eq. (33), where a number is due.
///
/// # Range
/// Pitois: the case of Elskamp & Kruggel-Emden (2018), Fig. 5b, reaches Ca = 0.05. Grohn: the constants were fitted together with
/// [`Mikami1998`](crate::rupture::Mikami1998) for one liquid and speeds of about 0.3 to 4 m/s;
/// with another static law, liquid or solid they are an assumption.
///
/// # References
/// Pitois, Moucheront & Chateau (2001), Eur. Phys. J. B 23, 79. Grohn et al. (2022) as quoted by
/// Krull, Strohner & Antonyuk (2025), KONA, eqs. (27) and (28).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Dynamic {
    /// No effect of the speed: the factor is 1.
    #[default]
    None,
    /// Pitois, Moucheront & Chateau (2001).
    Pitois2001 {
        /// Viscosity η of the liquid, Pa s, at least 0.
        viscosity: f64,
    },
    /// Grohn et al. (2022).
    Grohn2022,
}

/// C of Grohn's factor between two spheres, s/m.
const GROHN_C_PP: f64 = 6.266;
/// C of Grohn's factor between a sphere and a wall, s/m.
const GROHN_C_PW: f64 = 4.424;

impl Dynamic {
    /// The factor for one bridge as a function of speed, with everything else folded in.
    ///
    /// # Errors
    /// [`OutOfRange`] unless the viscosity is finite and not negative.
    pub fn curve(&self, bridge: &Bridge) -> Result<DynamicCurve, OutOfRange> {
        Ok(match *self {
            Self::None => DynamicCurve::One,
            Self::Pitois2001 { viscosity } => {
                OutOfRange::within("viscosity", viscosity, (0.0, f64::MAX))?;
                let per_speed = viscosity / bridge.surface_tension();
                OutOfRange::within("viscosity over surface tension", per_speed, (0.0, f64::MAX))?;
                DynamicCurve::Root { per_speed }
            }
            Self::Grohn2022 => DynamicCurve::TwoThirds {
                per_speed: if bridge.mate().is_wall() { GROHN_C_PW } else { GROHN_C_PP },
            },
        })
    }

    /// The factor for one bridge at one speed. `speed` m/s, finite, at least 0.
    ///
    /// # Errors
    /// [`OutOfRange`] for another speed or where the factor is no finite number, and as [`Dynamic::curve`].
    pub fn factor(&self, bridge: &Bridge, speed: f64) -> Result<f64, OutOfRange> {
        let curve = self.curve(bridge)?;
        OutOfRange::within("relative speed", speed, (0.0, f64::MAX))?;
        let factor = curve.factor(speed);
        OutOfRange::within("dynamic rupture factor", factor, (1.0, f64::MAX))?;
        Ok(factor)
    }
}

/// The dynamic factor of one bridge, ready to be asked at every step.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum DynamicCurve {
    /// Always 1.
    One,
    /// 1 + √(c v).
    Root {
        /// c = η/σ, s/m.
        per_speed: f64,
    },
    /// (1 + c v)^(2/3).
    TwoThirds {
        /// c, s/m.
        per_speed: f64,
    },
}

impl DynamicCurve {
    /// The factor, at least 1. `speed` is the magnitude of the relative velocity, m/s.
    #[must_use]
    pub fn factor(&self, speed: f64) -> f64 {
        debug_assert!(speed >= 0.0, "a speed has no sign: {speed}");
        match *self {
            Self::One => 1.0,
            Self::Root { per_speed } => 1.0 + (per_speed * speed).sqrt(),
            Self::TwoThirds { per_speed } => (1.0 + per_speed * speed).cbrt().powi(2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use pendular_pair::Mate;

    fn bridge(mate: Mate) -> Bridge {
        Bridge::new(4e-3, mate, 5e-10, [0.17, 0.17], 0.021).unwrap()
    }

    #[test]
    fn at_rest_every_factor_is_one() {
        for law in [Dynamic::None, Dynamic::Pitois2001 { viscosity: 0.1 }, Dynamic::Grohn2022] {
            assert_eq!(law.factor(&bridge(Mate::PLANE), 0.0).unwrap(), 1.0);
        }
    }

    /// Pitois' set-up, η = 0.1 Pa s, σ = 21 mN/m: at 2.1 mm/s Ca = 0.01 and the factor is 1.1.
    #[test]
    fn pitois_by_hand() {
        let law = Dynamic::Pitois2001 { viscosity: 0.1 };
        let f = law.factor(&bridge(Mate::Sphere { radius: 4e-3 }), 2.1e-3).unwrap();
        assert_relative_eq!(f, 1.1, max_relative = 1e-14);
    }

    /// Erratum: the quantity under the root is a magnitude, so the direction does not matter.
    #[test]
    fn only_the_magnitude_of_the_velocity_counts() {
        let law = Dynamic::Pitois2001 { viscosity: 0.1 };
        let b = bridge(Mate::PLANE);
        let magnitude = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let factors = [[3.0, 0.0, 4.0], [-5.0, 0.0, 0.0], [0.0, -4.0, -3.0]]
            .map(|v| law.factor(&b, magnitude(v)).unwrap());
        assert!(factors.iter().all(|f| *f == factors[0] && *f > 1.0));
        assert!(law.factor(&b, -5.0).is_err(), "a signed component is no speed");
    }

    #[test]
    fn grohn_tells_a_wall_from_a_sphere() {
        let at = |mate| Dynamic::Grohn2022.factor(&bridge(mate), 1.0).unwrap();
        assert_relative_eq!(at(Mate::PLANE), 5.424f64.powf(2.0 / 3.0), max_relative = 1e-14);
        let pp = at(Mate::Sphere { radius: 1e-3 });
        assert_relative_eq!(pp, 7.266f64.powf(2.0 / 3.0), max_relative = 1e-14);
    }

    #[test]
    fn bad_values_are_typed_errors() {
        let b = bridge(Mate::PLANE);
        assert!(Dynamic::Pitois2001 { viscosity: -1.0 }.curve(&b).is_err());
        assert!(Dynamic::Pitois2001 { viscosity: f64::NAN }.curve(&b).is_err());
        assert!(Dynamic::Grohn2022.factor(&b, f64::NAN).is_err());
    }
}
