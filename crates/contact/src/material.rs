use crate::ContactError;
use crate::error::{positive, within};

/// An isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    youngs_modulus: f64,
    poisson_ratio: f64,
}

impl Elastic {
    /// A material of `youngs_modulus` E (Pa) and `poisson_ratio` ν.
    ///
    /// # Errors
    /// [`ContactError`] unless E is positive and finite and −1 < ν ≤ 0.5.
    pub fn new(youngs_modulus: f64, poisson_ratio: f64) -> Result<Self, ContactError> {
        positive("Young's modulus", youngs_modulus)?;
        within("Poisson ratio", poisson_ratio, ((-1.0_f64).next_up(), 0.5))?;
        Ok(Self { youngs_modulus, poisson_ratio })
    }

    /// E* of a contact with `other`, Pa: 1/E* = (1 − ν_i²)/E_i + (1 − ν_j²)/E_j.
    #[must_use]
    pub fn effective_modulus(&self, other: &Self) -> f64 {
        1.0 / (self.compliance() + other.compliance())
    }

    /// E* against a rigid body, Pa: E/(1 − ν²).
    #[must_use]
    pub fn effective_modulus_on_rigid(&self) -> f64 {
        1.0 / self.compliance()
    }

    /// G* of a contact with `other`, Pa: 1/G* = (2 − ν_i)/G_i + (2 − ν_j)/G_j, G = E/(2 (1 + ν)).
    #[must_use]
    pub fn effective_shear_modulus(&self, other: &Self) -> f64 {
        1.0 / (self.shear_compliance() + other.shear_compliance())
    }

    /// k_t/k_n of a contact with `other`: 4 G*/E*, which is (1 − ν)/(1 − ν/2) for one material.
    #[must_use]
    pub fn tangential_ratio(&self, other: &Self) -> f64 {
        4.0 * self.effective_shear_modulus(other) / self.effective_modulus(other)
    }

    fn compliance(&self) -> f64 {
        (1.0 - self.poisson_ratio * self.poisson_ratio) / self.youngs_modulus
    }

    fn shear_compliance(&self) -> f64 {
        2.0 * (2.0 - self.poisson_ratio) * (1.0 + self.poisson_ratio) / self.youngs_modulus
    }
}

/// k_t/k_n = (1 − ν)/(1 − ν/2) of two bodies of one material (Mindlin 1949).
///
/// # Errors
/// [`ContactError`] unless −1 < ν ≤ 0.5.
pub fn tangential_ratio(poisson_ratio: f64) -> Result<f64, ContactError> {
    within("Poisson ratio", poisson_ratio, ((-1.0_f64).next_up(), 0.5))?;
    Ok((1.0 - poisson_ratio) / (1.0 - 0.5 * poisson_ratio))
}

/// [`tangential_ratio`] of ν = 0.3, the default of every law here.
pub(crate) const DEFAULT_RATIO: f64 = 0.7 / 0.85;

/// Checks a ratio k_t/k_n; 0 leaves out the tangential spring.
pub(crate) fn checked_ratio(ratio: f64) -> Result<f64, ContactError> {
    within("ratio of tangential to normal stiffness", ratio, (0.0, f64::MAX))?;
    Ok(ratio)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_material_gives_mindlins_ratio() {
        for nu in [0.0, 0.2, 0.35, 0.5] {
            let material = Elastic::new(3e9, nu).unwrap();
            let ratio = tangential_ratio(nu).unwrap();
            assert!((material.tangential_ratio(&material) / ratio - 1.0).abs() < 1e-14);
        }
        assert_eq!(DEFAULT_RATIO, tangential_ratio(0.3).unwrap());
        // ν = 0.35: 0.65/0.825
        assert!((tangential_ratio(0.35).unwrap() - 0.787_878_787_878).abs() < 1e-12);
    }

    #[test]
    fn effective_moduli_by_hand() {
        let (pom, steel) =
            (Elastic::new(2.84e9, 0.35).unwrap(), Elastic::new(2.08e11, 0.3).unwrap());
        // 1/(0.8775/2.84e9 + 0.91/2.08e11)
        assert!((pom.effective_modulus(&steel) / 3.191_280_2e9 - 1.0).abs() < 1e-6);
        assert!((pom.effective_modulus_on_rigid() / (2.84e9 / 0.8775) - 1.0).abs() < 1e-14);
        assert_eq!(pom.effective_modulus(&steel), steel.effective_modulus(&pom));
    }

    #[test]
    fn bad_values_are_named() {
        assert_eq!(Elastic::new(0.0, 0.3).unwrap_err().quantity, "Young's modulus");
        assert_eq!(Elastic::new(1e9, 0.51).unwrap_err().quantity, "Poisson ratio");
        assert_eq!(Elastic::new(1e9, -1.0).unwrap_err().quantity, "Poisson ratio");
        assert!(checked_ratio(f64::NAN).is_err() && checked_ratio(-1.0).is_err());
    }
}
