use crate::Bridge;

/// A value that a law, or the physics, does not allow.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{quantity} = {value:?} is outside the allowed range {:?} to {:?}", allowed.0, allowed.1)]
pub struct OutOfRange {
    /// What was out of range, in words.
    pub quantity: &'static str,
    /// Its value (SI, radians).
    pub value: f64,
    /// The allowed range, lower and upper end.
    pub allowed: (f64, f64),
}

impl OutOfRange {
    /// Checks that `value` is positive and finite.
    ///
    /// # Errors
    /// [`OutOfRange`] naming `quantity` otherwise.
    pub fn positive(quantity: &'static str, value: f64) -> Result<(), Self> {
        if value > 0.0 && value < f64::INFINITY {
            return Ok(());
        }
        Err(Self { quantity, value, allowed: (0.0, f64::INFINITY) })
    }

    /// Checks that `value` lies in the closed range `allowed`; NaN never does.
    ///
    /// # Errors
    /// [`OutOfRange`] naming `quantity` otherwise.
    pub fn within(quantity: &'static str, value: f64, allowed: (f64, f64)) -> Result<(), Self> {
        if allowed.0 <= value && value <= allowed.1 {
            return Ok(());
        }
        Err(Self { quantity, value, allowed })
    }
}

/// What to do with a bridge outside a law's [`Validity`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Range {
    /// Refuse it with an [`OutOfRange`].
    #[default]
    Strict,
    /// Evaluate the law all the same, wherever its formula has a value.
    Extrapolate,
}

/// The bridges over which a law holds, as data. Ends are inclusive.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Validity {
    /// Dimensionless volume V* = V/R³, R the harmonic radius.
    pub v_star: (f64, f64),
    /// Each contact angle, rad.
    pub contact_angle: (f64, f64),
    /// Greatest difference of the two contact angles, rad.
    pub angle_difference: f64,
    /// Larger over smaller radius; an upper end of `f64::INFINITY` includes a wall.
    pub radius_ratio: (f64, f64),
}

impl Validity {
    /// Every bridge there is.
    pub const ALL: Self = Self {
        v_star: (0.0, f64::INFINITY),
        contact_angle: (0.0, std::f64::consts::PI),
        angle_difference: std::f64::consts::PI,
        radius_ratio: (1.0, f64::INFINITY),
    };

    /// Checks a bridge against all ranges.
    ///
    /// # Errors
    /// [`OutOfRange`] with the first quantity that lies outside.
    pub fn check(&self, bridge: &Bridge) -> Result<(), OutOfRange> {
        let [first, second] = bridge.contact_angles();
        OutOfRange::within("dimensionless volume V/R^3", bridge.v_star(), self.v_star)?;
        OutOfRange::within("contact angle", first, self.contact_angle)?;
        OutOfRange::within("contact angle", second, self.contact_angle)?;
        let difference = (first - second).abs();
        let allowed = (0.0, self.angle_difference);
        OutOfRange::within("difference of contact angles", difference, allowed)?;
        OutOfRange::within("radius ratio", bridge.radius_ratio(), self.radius_ratio)
    }

    /// [`Validity::check`] where `range` is strict, nothing where it extrapolates.
    ///
    /// # Errors
    /// [`OutOfRange`] as [`Validity::check`].
    pub fn admit(&self, bridge: &Bridge, range: Range) -> Result<(), OutOfRange> {
        match range {
            Range::Strict => self.check(bridge),
            Range::Extrapolate => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mate;

    #[test]
    fn both_ends_and_nan() {
        assert!(OutOfRange::within("x", 1.0, (1.0, 2.0)).is_ok());
        assert!(OutOfRange::within("x", 2.0, (1.0, 2.0)).is_ok());
        assert!(OutOfRange::within("x", f64::NAN, (1.0, 2.0)).is_err());
        assert!(OutOfRange::positive("x", f64::NAN).is_err());
    }

    #[test]
    fn the_message_says_what_and_where() {
        let v = Validity { v_star: (1e-4, 0.3), ..Validity::ALL };
        let bridge = Bridge::new(1.0, Mate::Sphere { radius: 1.0 }, 1e-6, [0.0; 2], 1.0).unwrap();
        let said = v.check(&bridge).unwrap_err().to_string();
        assert!(said.contains("V/R^3") && said.contains("0.0001") && said.contains("0.3"));
        assert!(v.admit(&bridge, Range::Extrapolate).is_ok());
    }

    /// Volumes are some 1e-12 m³, and where any finite number is allowed the end is the largest of f64.
    #[test]
    fn the_message_has_no_rows_of_zeros() {
        let bad = OutOfRange::within("film volume", -2e-12, (0.0, f64::MAX)).unwrap_err();
        let said = bad.to_string();
        assert!(said.contains("-2e-12") && said.len() < 90, "{said}");
    }
}
