use std::f64::consts::PI;

use crate::error::positive;
use crate::material::{DEFAULT_RATIO, checked_ratio};
use crate::{ContactError, NormalContact};

/// Hertz' contact that yields: elastic to the yield point, elastic-plastic above, elastic on
/// unloading, with a permanent deformation.
///
/// ```text
/// loading,   s ≤ s_y:  F = 4/3 E* √(R* s³)                                              (7)
///            s > s_y:  F = κ (3 κ − 1) π R* s p_y,   κ = 1 − (s_y/s)^(1/3)/3            (11), (12)
/// yield:     s_y = π²/4 (p_y/E*)² R*,   F_y = π³/6 p_y³ (R*/E*)²                        (9), (10)
/// unloading, reloading below s_max:  F = F_max ((s − s_pl)/(s_max − s_pl))^(3/2)        (15)
///            s_pl = s_max − 5/2 E_el/F_max                                              (16)-(18)
/// ```
///
/// s is the overlap δ and E_el the elastic part of the work of loading. Force and stiffness are
/// continuous at yield. For s ≫ s_y the force tends to the fully plastic
/// [`plastic_force`](Self::plastic_force) 2 π R* s p_y (13). There is no dashpot: only plastic flow
/// takes energy. The tangential stiffness is `ratio` 2 E* a with the contact radius
/// a = √((3 κ − 1) R* s), Mindlin's below yield.
///
/// Far above yield the rebound falls like v^(−1/6), because this E_el grows like s^(5/3); Johnson's
/// flattened contact gives v^(−1/4).
///
/// # Units
/// Overlap m, moduli and yield pressure Pa, R* m → N.
///
/// # Range
/// s ≪ R*. The memory belongs to one contact: a later contact of the same bodies is a virgin one.
///
/// # Example
/// ```
/// use pendular_contact::{ElasticPlastic, NormalContact, PlasticMemory};
/// // a lactose sphere of 0.2 mm on a rigid plane: E* = 2.5 GPa/(1 − 0.2²), R* = 0.1 mm
/// let law = ElasticPlastic::new(2.5e9 / 0.96, 1e-4, 27e6)?;
/// assert!((law.yield_overlap() - 26.52e-9).abs() < 1e-11); // π²/4 · (27e6/2.6042e9)² · 1e-4
/// let mut memory = PlasticMemory::default();
/// let pushed = law.force(1e-6, 0.0, &mut memory);
/// assert!(law.force(0.9e-6, 0.0, &mut memory) < 0.9 * pushed);
/// assert_eq!(law.force(0.5 * memory.plastic_overlap, 0.0, &mut memory), 0.0);
/// # Ok::<(), pendular_contact::ContactError>(())
/// ```
///
/// # References
/// Krull, Strohner & Antonyuk (2025), KONA, section 2.2, whose equation numbers stand above;
/// yield point after Thornton & Ning (1998), Powder Technol. 99, 154; κ after Tomas (2007).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticPlastic {
    /// 4/3 E* √R*.
    hertz: f64,
    pub(crate) yield_overlap: f64,
    /// π R* p_y.
    pub(crate) plastic: f64,
    /// 2 E* √R* k_t/k_n.
    tangential: f64,
}

/// What an [`ElasticPlastic`] contact remembers. All 0 until it yields.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PlasticMemory {
    /// Largest overlap s_max so far, m; 0 below yield.
    pub max_overlap: f64,
    /// Permanent deformation s_pl, m: the overlap at which the force has vanished.
    pub plastic_overlap: f64,
}

impl ElasticPlastic {
    /// A contact from E* (Pa), R* (m) and the yield pressure p_y (Pa).
    ///
    /// # Errors
    /// [`ContactError`] unless all are positive and finite, and where the yield point is too small
    /// or too large a number.
    pub fn new(
        effective_modulus: f64,
        reduced_radius: f64,
        yield_pressure: f64,
    ) -> Result<Self, ContactError> {
        positive("effective modulus", effective_modulus)?;
        positive("reduced radius", reduced_radius)?;
        positive("yield pressure", yield_pressure)?;
        let strain = yield_pressure / effective_modulus;
        let law = Self {
            hertz: 4.0 / 3.0 * effective_modulus * reduced_radius.sqrt(),
            yield_overlap: 0.25 * PI * PI * strain * strain * reduced_radius,
            plastic: PI * reduced_radius * yield_pressure,
            tangential: DEFAULT_RATIO * 2.0 * effective_modulus * reduced_radius.sqrt(),
        };
        positive("yield overlap", law.yield_overlap)?;
        positive("force at yield", law.yield_force())?;
        positive("effective modulus times root of radius", law.hertz)?;
        Ok(law)
    }

    /// The same contact with k_t = `ratio` 2 E* a; 0 for none.
    ///
    /// # Errors
    /// [`ContactError`] unless the ratio is finite and not negative.
    pub fn with_tangential_ratio(self, ratio: f64) -> Result<Self, ContactError> {
        Ok(Self { tangential: checked_ratio(ratio)? * 1.5 * self.hertz, ..self })
    }

    /// Overlap s_y at which the contact yields, m (eq. 10).
    #[must_use]
    pub fn yield_overlap(&self) -> f64 {
        self.yield_overlap
    }

    /// Force F_y at which the contact yields, N (eq. 9), which is 2/3 π R* s_y p_y.
    #[must_use]
    pub fn yield_force(&self) -> f64 {
        2.0 / 3.0 * self.plastic * self.yield_overlap
    }

    /// Slowest impact that yields, m/s, for bodies of `reduced_mass` m* (kg): m* v²/2 = 2/5 F_y s_y.
    #[must_use]
    pub fn yield_speed(&self, reduced_mass: f64) -> f64 {
        (0.8 * self.yield_force() * self.yield_overlap / reduced_mass).sqrt()
    }

    /// Force of a first loading to `overlap` (m), N (eqs. 7, 12).
    #[must_use]
    #[inline]
    pub fn loading_force(&self, overlap: f64) -> f64 {
        if overlap <= self.yield_overlap {
            return self.hertz * overlap * overlap.max(0.0).sqrt();
        }
        let c = self.root(overlap);
        (1.0 - c / 3.0) * (2.0 - c) * self.plastic * overlap
    }

    /// Fully plastic force 2 π R* s p_y at `overlap` s (m), N (eq. 13): the limit for s ≫ s_y.
    #[must_use]
    pub fn plastic_force(&self, overlap: f64) -> f64 {
        2.0 * self.plastic * overlap
    }

    /// (s_y/s)^(1/3).
    #[inline]
    pub(crate) fn root(&self, overlap: f64) -> f64 {
        (self.yield_overlap / overlap).cbrt()
    }

    #[inline]
    pub(crate) fn unloading_force(&self, overlap: f64, memory: &PlasticMemory) -> f64 {
        let PlasticMemory { max_overlap, plastic_overlap } = *memory;
        let share = ((overlap - plastic_overlap) / (max_overlap - plastic_overlap)).max(0.0);
        self.loading_force(max_overlap) * share * share.sqrt()
    }
}

impl NormalContact for ElasticPlastic {
    type Memory = PlasticMemory;

    #[inline]
    fn force(&self, overlap: f64, _: f64, memory: &mut PlasticMemory) -> f64 {
        if overlap < memory.max_overlap {
            return self.unloading_force(overlap, memory);
        }
        if overlap > self.yield_overlap {
            let plastic_overlap = self.plastic_overlap(overlap);
            *memory = PlasticMemory { max_overlap: overlap, plastic_overlap };
        }
        self.loading_force(overlap)
    }

    #[inline]
    fn stiffness(&self, overlap: f64) -> f64 {
        if overlap <= self.yield_overlap {
            return 1.5 * self.hertz * overlap.max(0.0).sqrt();
        }
        // the start of unloading, at least as steep as loading
        1.5 * self.loading_force(overlap) / (overlap - self.plastic_overlap(overlap))
    }

    #[inline]
    fn tangential_stiffness(&self, overlap: f64) -> f64 {
        // a² = (3 κ − 1) R* s = (2 − c) R* s, R* s up to yield
        let widening = if overlap > self.yield_overlap { 2.0 - self.root(overlap) } else { 1.0 };
        self.tangential * (widening * overlap.max(0.0)).sqrt()
    }

    #[inline]
    fn damping(&self, _: f64) -> f64 {
        0.0
    }
}
