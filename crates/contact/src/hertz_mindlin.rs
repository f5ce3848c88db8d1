use crate::damping::damping_ratio;
use crate::error::{positive, within};
use crate::material::{DEFAULT_RATIO, checked_ratio};
use crate::{ContactError, Dashpot, NormalContact};

/// Hertz' elastic contact with Mindlin's tangential stiffness and a dashpot of constant
/// restitution.
///
/// ```text
/// F   = 4/3 E* √(R* δ³) + γ(δ) dδ/dt,   γ = α √(m* 4/3 E* √R*) δ^(1/4),   α = √5 ζ(e)
/// k_n = 2 E* √(R* δ),   k_t = 8 G* √(R* δ) = ratio k_n,   ratio = 4 G*/E*
/// ```
///
/// ζ(e) is [`crate::damping_ratio`]: the rebound is e at every speed, exactly. With a dashpot that
/// may pull, α = −√5 ln e/√(π² + ln² e) (Antypov & Elliott's closed form of Tsuji's α).
///
/// # Units
/// Overlap δ m, moduli Pa, R* m, m* kg → N.
///
/// # Range
/// δ ≪ R*.
///
/// # Example
/// ```
/// use pendular_contact::{Elastic, HertzMindlin, NormalContact};
/// let glass = Elastic::new(5e10, 0.2)?;
/// let modulus = glass.effective_modulus(&glass);
/// let law = HertzMindlin::from_restitution(modulus, 1e-3, 0.78, 1e-5)?
///     .with_tangential_ratio(glass.tangential_ratio(&glass))?;
/// // by hand: 4/3 · 2.6041667e10 · √(1e-3 · 1e-18)
/// assert!((law.force(1e-6, 0.0, &mut ()) - 1.0980131).abs() < 1e-6);
/// # Ok::<(), pendular_contact::ContactError>(())
/// ```
///
/// # References
/// Hertz (1882); Mindlin (1949), J. Appl. Mech. 16, 259; Tsuji, Tanaka & Ishida (1992), Powder
/// Technol. 71, 239; Antypov & Elliott (2011), EPL 94, 50004. Krull, Strohner & Antonyuk (2025),
/// eqs. (7), (8): in (8) the printed E* √(R* s) must be 2 E* √(R* s), the derivative of (7).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzMindlin {
    /// 2 E* √R*, so that k_n = this √δ.
    slope: f64,
    /// α √(m* 4/3 E* √R*).
    damping: f64,
    tangential_ratio: f64,
    dashpot: Dashpot,
}

impl HertzMindlin {
    /// An elastic contact without dashpot, from E* (Pa) and R* (m).
    ///
    /// # Errors
    /// [`ContactError`] unless both are positive and finite.
    pub fn elastic(effective_modulus: f64, reduced_radius: f64) -> Result<Self, ContactError> {
        positive("effective modulus", effective_modulus)?;
        positive("reduced radius", reduced_radius)?;
        let slope = 2.0 * effective_modulus * reduced_radius.sqrt();
        positive("effective modulus times root of radius", slope)?;
        let dashpot = Dashpot::PushesOnly;
        Ok(Self { slope, damping: 0.0, tangential_ratio: DEFAULT_RATIO, dashpot })
    }

    /// A contact that pushes only and rebounds with `restitution` e at every speed, for bodies of
    /// `reduced_mass` m* (kg).
    ///
    /// # Errors
    /// [`ContactError`] unless moduli, radius and mass are positive and finite and 0 < e ≤ 1.
    pub fn from_restitution(
        effective_modulus: f64,
        reduced_radius: f64,
        restitution: f64,
        reduced_mass: f64,
    ) -> Result<Self, ContactError> {
        Self::elastic(effective_modulus, reduced_radius)?.with_restitution(
            restitution,
            reduced_mass,
            Dashpot::PushesOnly,
        )
    }

    /// The same spring with a dashpot that gives the rebound e under either treatment of
    /// separation.
    ///
    /// # Errors
    /// [`ContactError`] unless the mass is positive and finite and 0 < e ≤ 1.
    pub fn with_restitution(
        self,
        restitution: f64,
        reduced_mass: f64,
        dashpot: Dashpot,
    ) -> Result<Self, ContactError> {
        positive("reduced mass", reduced_mass)?;
        let alpha = 5.0_f64.sqrt() * damping_ratio(restitution, dashpot)?;
        let damping = alpha * reduced_mass.sqrt() * (self.slope / 1.5).sqrt();
        within("damping", damping, (0.0, f64::MAX))?;
        Ok(Self { damping, dashpot, ..self })
    }

    /// The same contact with k_t = `ratio` k_n; 0 for none.
    ///
    /// # Errors
    /// [`ContactError`] unless the ratio is finite and not negative.
    pub fn with_tangential_ratio(self, ratio: f64) -> Result<Self, ContactError> {
        Ok(Self { tangential_ratio: checked_ratio(ratio)?, ..self })
    }
}

impl NormalContact for HertzMindlin {
    type Memory = ();

    #[inline]
    fn force(&self, overlap: f64, approach_speed: f64, (): &mut ()) -> f64 {
        let root = overlap.max(0.0).sqrt();
        let force = self.slope / 1.5 * overlap * root + self.damping * root.sqrt() * approach_speed;
        if self.dashpot == Dashpot::PushesOnly { force.max(0.0) } else { force }
    }

    #[inline]
    fn stiffness(&self, overlap: f64) -> f64 {
        self.slope * overlap.max(0.0).sqrt()
    }

    #[inline]
    fn tangential_stiffness(&self, overlap: f64) -> f64 {
        self.tangential_ratio * self.stiffness(overlap)
    }

    #[inline]
    fn damping(&self, overlap: f64) -> f64 {
        self.damping * overlap.max(0.0).sqrt().sqrt()
    }

    #[inline]
    fn may_pull(&self) -> bool {
        self.dashpot == Dashpot::MayPull
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Elastic;

    #[test]
    fn eq_8_of_krull_needs_a_factor_two() {
        let law = HertzMindlin::elastic(3e9, 2e-3).unwrap();
        let force = |s: f64| law.force(s, 0.0, &mut ());
        let (s, h) = (1e-6_f64, 1e-10);
        let slope = (force(s + h) - force(s - h)) / (2.0 * h);
        assert!((slope / (2.0 * 3e9 * (2e-3 * s).sqrt()) - 1.0).abs() < 1e-8);
        assert!((slope / (3e9 * (2e-3 * s).sqrt()) - 2.0).abs() < 1e-7); // as printed: half
        assert!((law.stiffness(s) / slope - 1.0).abs() < 1e-8);
    }

    #[test]
    fn mindlins_stiffness() {
        let steel = Elastic::new(2.08e11, 0.3).unwrap();
        let law = HertzMindlin::elastic(steel.effective_modulus(&steel), 5e-3)
            .and_then(|law| law.with_tangential_ratio(steel.tangential_ratio(&steel)))
            .unwrap();
        // 8 G* a, G* = G/(2 (2 − ν)), G = 8e10 Pa, a = √(5e-3 · 2e-6) = 1e-4 m
        assert!((law.tangential_stiffness(2e-6) / (8.0 * 8e10 / 3.4 * 1e-4) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn bad_parameters_are_named() {
        let bad = |e, r, c, m| HertzMindlin::from_restitution(e, r, c, m).unwrap_err().quantity;
        assert_eq!(bad(-1.0, 1.0, 0.5, 1.0), "effective modulus");
        assert_eq!(bad(1.0, 0.0, 0.5, 1.0), "reduced radius");
        assert_eq!(bad(1.0, 1.0, 0.0, 1.0), "restitution");
        assert_eq!(bad(1.0, 1.0, 0.5, f64::NAN), "reduced mass");
    }
}
