use std::f64::consts::PI;

use pendular_pair::Bridge;

use super::chebyshev;
use crate::young_laplace::{ExactBridge, SolveError};

/// Terms of the polynomial in τ.
pub(super) const TERMS: usize = 10;

/// Numbers per tabulated bridge: the terms, the rupture distance and the share.
pub(super) const OUTPUTS: usize = TERMS + 2;

/// Gaps at which the exact force is sampled.
const SAMPLES: usize = 17;

/// An exact bridge folded into a few dimensionless numbers.
///
/// ```text
/// F = π σ R (1 − S/H) Pₙ(τ),   H = √(S² + a²),   a² = 2V/(πR),   τ = √(1 − S/S_rup)
/// ```
///
/// 1 − S/H is the small-bridge (Lambert) dependence on the gap; what is left is smooth in τ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Folded {
    /// Shifted Chebyshev coefficients of Pₙ.
    pub(super) terms: [f64; TERMS],
    /// S_rup/(R V*^(1/3))
    pub(super) end: f64,
    /// Share of the liquid on the first body's side of the neck at rupture.
    pub(super) share: f64,
}

impl Folded {
    /// Folds a bridge with the exact solver.
    pub(super) fn exact(bridge: &Bridge) -> Result<Self, SolveError> {
        let exact = ExactBridge::coarse(bridge)?;
        let rupture = exact.rupture();
        let scale = bridge.harmonic_radius();
        let a2 = 2.0 * bridge.volume() / (PI * scale);
        let strength = PI * bridge.surface_tension() * scale;
        let mut values = [0.0; SAMPLES];
        for (k, value) in values.iter_mut().enumerate() {
            let tau = chebyshev::node(k, SAMPLES);
            let gap = rupture.distance * (1.0 - tau * tau);
            let height = (gap * gap + a2).sqrt();
            *value = exact.force(gap)? * height * (height + gap) / (strength * a2);
        }
        let mut terms = [0.0; TERMS];
        terms.copy_from_slice(&chebyshev::coefficients(&values)[..TERMS]);
        let end = rupture.distance / (scale * bridge.v_star().cbrt());
        Ok(Self { terms, end, share: rupture.share })
    }

    pub(super) fn to_array(self) -> [f64; OUTPUTS] {
        let mut array = [0.0; OUTPUTS];
        array[..TERMS].copy_from_slice(&self.terms);
        array[TERMS] = self.end;
        array[TERMS + 1] = self.share;
        array
    }

    pub(super) fn from_array(array: [f64; OUTPUTS]) -> Self {
        let mut terms = [0.0; TERMS];
        terms.copy_from_slice(&array[..TERMS]);
        Self { terms, end: array[TERMS], share: array[TERMS + 1] }
    }

    /// Rupture distance of `bridge`, m.
    pub(super) fn rupture_distance(&self, bridge: &Bridge) -> f64 {
        self.end * bridge.harmonic_radius() * bridge.v_star().cbrt()
    }
}
