use crate::damping::{cut_duration, damping_ratio, restitution};
use crate::error::{positive, within};
use crate::material::{DEFAULT_RATIO, checked_ratio};
use crate::{ContactError, Dashpot, NormalContact};

/// Linear spring and dashpot.
///
/// ```text
/// F = k_n δ + γ dδ/dt          at least 0 unless the dashpot may pull
/// k_t = ratio k_n              ratio (1 − ν)/(1 − ν/2), by default for ν = 0.3
/// ```
///
/// # Units
/// Overlap δ m, stiffness N/m, dashpot N s/m → N.
///
/// # Example
/// ```
/// use pendular_contact::{Linear, NormalContact};
/// let law = Linear::from_restitution(1e5, 0.8, 1e-4)?;
/// assert!((law.force(1e-6, 0.0, &mut ()) - 0.1).abs() < 1e-15); // 1e5 N/m · 1 µm
/// assert!((law.restitution(1e-4)? - 0.8).abs() < 1e-12);
/// # Ok::<(), pendular_contact::ContactError>(())
/// ```
///
/// # References
/// Cundall & Strack (1979), Géotechnique 29, 47; for the end of the contact Schwager & Pöschel
/// (2007), Granul. Matter 9, 465.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linear {
    stiffness: f64,
    damping: f64,
    tangential_stiffness: f64,
    dashpot: Dashpot,
}

impl Linear {
    /// A contact that pushes only, from `stiffness` k_n (N/m) and `damping` γ (N s/m).
    ///
    /// # Errors
    /// [`ContactError`] unless the stiffness is positive and finite and the dashpot finite and not
    /// negative.
    pub fn new(stiffness: f64, damping: f64) -> Result<Self, ContactError> {
        positive("stiffness", stiffness)?;
        within("damping", damping, (0.0, f64::MAX))?;
        let tangential_stiffness = DEFAULT_RATIO * stiffness;
        Ok(Self { stiffness, damping, tangential_stiffness, dashpot: Dashpot::PushesOnly })
    }

    /// A contact that pushes only and rebounds with `restitution` e at every speed, for bodies of
    /// `reduced_mass` m* (kg; the particle's own mass against a wall).
    ///
    /// # Errors
    /// [`ContactError`] unless stiffness and mass are positive and finite and 0 < e ≤ 1: no finite
    /// dashpot gives e = 0.
    pub fn from_restitution(
        stiffness: f64,
        restitution: f64,
        reduced_mass: f64,
    ) -> Result<Self, ContactError> {
        Self::from_restitution_with(stiffness, restitution, reduced_mass, Dashpot::PushesOnly)
    }

    /// [`Self::from_restitution`] with the treatment of separation.
    ///
    /// The dashpot is chosen so that the rebound is e either way. For [`Dashpot::MayPull`] it is
    /// [`crate::dashpot`].
    ///
    /// # Errors
    /// As [`Self::from_restitution`].
    pub fn from_restitution_with(
        stiffness: f64,
        restitution: f64,
        reduced_mass: f64,
        dashpot: Dashpot,
    ) -> Result<Self, ContactError> {
        positive("stiffness", stiffness)?;
        positive("reduced mass", reduced_mass)?;
        let zeta = damping_ratio(restitution, dashpot)?;
        let damping = 2.0 * zeta * stiffness.sqrt() * reduced_mass.sqrt();
        Ok(Self { dashpot, ..Self::new(stiffness, damping)? })
    }

    /// The same contact with k_t = `ratio` k_n; 0 for none.
    ///
    /// # Errors
    /// [`ContactError`] unless the ratio is finite and not negative.
    pub fn with_tangential_ratio(self, ratio: f64) -> Result<Self, ContactError> {
        Ok(Self { tangential_stiffness: checked_ratio(ratio)? * self.stiffness, ..self })
    }

    /// The same spring and dashpot with another treatment of separation; the rebound changes.
    #[must_use]
    pub fn with_dashpot(self, dashpot: Dashpot) -> Self {
        Self { dashpot, ..self }
    }

    /// The restitution of bodies of `reduced_mass` m* (kg), from the exact solution.
    ///
    /// # Errors
    /// [`ContactError`] unless the mass is positive and finite.
    pub fn restitution(&self, reduced_mass: f64) -> Result<f64, ContactError> {
        restitution(self.damping_ratio(reduced_mass)?, self.dashpot)
    }

    /// Duration of a collision of bodies of `reduced_mass` m* (kg), s.
    ///
    /// ```text
    /// may pull:  π/√(k_n/m* − (γ/2 m*)²), infinite if overdamped;  pushes only: until F = 0
    /// ```
    ///
    /// # Errors
    /// [`ContactError`] unless the mass is positive and finite.
    pub fn contact_time(&self, reduced_mass: f64) -> Result<f64, ContactError> {
        let zeta = self.damping_ratio(reduced_mass)?;
        let phase = match self.dashpot {
            Dashpot::PushesOnly => cut_duration(zeta),
            Dashpot::MayPull if zeta >= 1.0 => f64::INFINITY,
            Dashpot::MayPull => std::f64::consts::PI / ((1.0 - zeta) * (1.0 + zeta)).sqrt(),
        };
        Ok(phase * (reduced_mass / self.stiffness).sqrt())
    }

    fn damping_ratio(&self, reduced_mass: f64) -> Result<f64, ContactError> {
        positive("reduced mass", reduced_mass)?;
        Ok(0.5 * self.damping / (self.stiffness.sqrt() * reduced_mass.sqrt()))
    }
}

impl NormalContact for Linear {
    type Memory = ();

    #[inline]
    fn force(&self, overlap: f64, approach_speed: f64, (): &mut ()) -> f64 {
        let force = self.stiffness * overlap + self.damping * approach_speed;
        if self.dashpot == Dashpot::PushesOnly { force.max(0.0) } else { force }
    }

    #[inline]
    fn stiffness(&self, _: f64) -> f64 {
        self.stiffness
    }

    #[inline]
    fn tangential_stiffness(&self, _: f64) -> f64 {
        self.tangential_stiffness
    }

    #[inline]
    fn damping(&self, _: f64) -> f64 {
        self.damping
    }

    #[inline]
    fn may_pull(&self) -> bool {
        self.dashpot == Dashpot::MayPull
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pulls_only_when_allowed() {
        let law = Linear::new(1e4, 2.0).unwrap();
        // 1e4 · 1e-5 − 2 · 0.1 = −0.1 N
        assert_eq!(law.force(1e-5, -0.1, &mut ()), 0.0);
        let pulling = law.with_dashpot(Dashpot::MayPull).force(1e-5, -0.1, &mut ());
        assert!((pulling + 0.1).abs() < 1e-15);
    }

    #[test]
    fn the_shear_cell_of_gladkyy_and_schwarze() {
        // r = 2.381 mm, ρ = 150 kg/m³, e = 0.83: k_n = 144.03 N/m, c_n = 2.92e-3 N s/m,
        // t_c = 5.4e-4 s (Gladkyy & Schwarze 2014, section 4.1)
        let mass = 4.0 / 3.0 * std::f64::consts::PI * 2.381e-3_f64.powi(3) * 150.0;
        let may_pull = Dashpot::MayPull;
        let law = Linear::from_restitution_with(144.03, 0.83, 0.5 * mass, may_pull).unwrap();
        assert!((law.contact_time(0.5 * mass).unwrap() / 5.4e-4 - 1.0).abs() < 1e-4);
        assert!((law.damping(0.0) / 2.92e-3 - 1.0).abs() < 5e-3);
    }

    #[test]
    fn tangential_stiffness_is_a_share_of_the_normal_one() {
        let law = Linear::new(1e5, 0.0).unwrap();
        // ν = 0.3: 0.7/0.85
        assert!((law.tangential_stiffness(1.0) / 1e5 - 0.823_529_411_76).abs() < 1e-10);
        let sheared = law.with_tangential_ratio(2.0 / 7.0).unwrap();
        assert!((sheared.tangential_stiffness(1.0) - 2e5 / 7.0).abs() < 1e-9);
    }

    #[test]
    fn elastic_contact_time() {
        let law = Linear::from_restitution(1e5, 1.0, 4e-5).unwrap();
        let half_period = std::f64::consts::PI * (4e-5_f64 / 1e5).sqrt();
        assert!((law.contact_time(4e-5).unwrap() / half_period - 1.0).abs() < 1e-12);
        assert!(law.damping(0.0) < 1e-12);
    }

    #[test]
    fn bad_parameters_are_named() {
        let bad = |k, e, m| Linear::from_restitution(k, e, m).unwrap_err().quantity;
        assert_eq!(bad(0.0, 0.5, 1.0), "stiffness");
        assert_eq!(bad(f64::NAN, 0.5, 1.0), "stiffness");
        assert_eq!(bad(1.0, 0.0, 1.0), "restitution");
        assert_eq!(bad(1.0, 1.5, 1.0), "restitution");
        assert_eq!(bad(1.0, 0.5, f64::INFINITY), "reduced mass");
        assert!(Linear::new(1.0, 1.0).unwrap().with_tangential_ratio(-1.0).is_err());
        assert_eq!(Linear::new(1.0, -1.0).unwrap_err().quantity, "damping");
    }
}
