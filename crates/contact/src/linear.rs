use pendular_lane::Lane;

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
#[repr(C)] // the first four are read at once
pub struct Linear {
    stiffness: f64,
    damping: f64,
    tangential_stiffness: f64,
    /// The least force, N: 0 or no limit.
    least: f64,
    tangential_softness: f64,
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
        let (tangential_stiffness, tangential_softness) = (0.0, 0.0);
        let law =
            Self { stiffness, damping, tangential_stiffness, least: 0.0, tangential_softness };
        law.with_tangential_ratio(DEFAULT_RATIO)
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
        Ok(Self::new(stiffness, damping)?.with_dashpot(dashpot))
    }

    /// The same contact with k_t = `ratio` k_n; 0 for none.
    ///
    /// # Errors
    /// [`ContactError`] unless the ratio is finite and not negative.
    pub fn with_tangential_ratio(self, ratio: f64) -> Result<Self, ContactError> {
        let tangential_stiffness = checked_ratio(ratio)? * self.stiffness;
        let tangential_softness =
            if tangential_stiffness > 0.0 { 1.0 / tangential_stiffness } else { 0.0 };
        Ok(Self { tangential_stiffness, tangential_softness, ..self })
    }

    /// The same spring and dashpot with another treatment of separation; the rebound changes.
    #[must_use]
    pub fn with_dashpot(self, dashpot: Dashpot) -> Self {
        let least = match dashpot {
            Dashpot::PushesOnly => 0.0,
            Dashpot::MayPull => f64::NEG_INFINITY,
        };
        Self { least, ..self }
    }

    fn dashpot(&self) -> Dashpot {
        if self.least == 0.0 { Dashpot::PushesOnly } else { Dashpot::MayPull }
    }

    /// The restitution of bodies of `reduced_mass` m* (kg), from the exact solution.
    ///
    /// # Errors
    /// [`ContactError`] unless the mass is positive and finite.
    pub fn restitution(&self, reduced_mass: f64) -> Result<f64, ContactError> {
        restitution(self.damping_ratio(reduced_mass)?, self.dashpot())
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
        let phase = match self.dashpot() {
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

    #[inline(always)]
    fn force(&self, overlap: f64, approach_speed: f64, (): &mut ()) -> f64 {
        Self::side_by_side::<f64>(&[self], overlap, approach_speed, &mut [()])[0]
    }

    #[inline]
    fn stiffness(&self, _: f64) -> f64 {
        self.stiffness
    }

    #[inline]
    fn tangential_stiffness(&self, _: f64) -> f64 {
        self.tangential_stiffness
    }

    #[inline(always)]
    fn tangential_softness(&self, _: f64) -> f64 {
        self.tangential_softness
    }

    #[inline(always)]
    fn side_by_side<L: Lane>(
        laws: &L::Each<&Self>,
        overlap: L,
        approach_speed: L,
        _: &mut L::Each<()>,
    ) -> [L; 3] {
        let permit = overlap.permit();
        let [stiffness, damping, tangential, least] = L::rows(permit, laws, |law| {
            [law.stiffness, law.damping, law.tangential_stiffness, law.least]
        });
        let softness = L::pack(permit, laws, |law| law.tangential_softness);
        let force = (stiffness * overlap + damping * approach_speed).most(least);
        [force, tangential, softness]
    }

    #[inline]
    fn damping(&self, _: f64) -> f64 {
        self.damping
    }

    #[inline]
    fn may_pull(&self) -> bool {
        self.dashpot() == Dashpot::MayPull
    }
}

#[cfg(test)]
#[path = "linear_tests.rs"]
mod tests;
