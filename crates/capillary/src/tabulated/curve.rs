use std::f64::consts::PI;

use pendular_pair::{Bridge, OutOfRange};

use super::chebyshev;
use super::folded::{Folded, TERMS};
use crate::ForceCurve;
use crate::checked::{finite, positive};

/// The tabulated force over the gap of one bridge.
///
/// ```text
/// F = (1 − S/H) (c₀ + c₁ τ + … + c₉ τ⁹),   H = √(S² + a²),   τ = √(1 − S/S_rup)
/// ```
///
/// Beyond rupture τ = 0, and the force fades like 1 − S/H.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TabulatedCurve {
    a2: f64,
    inverse_end: f64,
    terms: [f64; TERMS],
}

/// Longest gap that is told from shorter ones, m; keeps the squares finite.
const FAR: f64 = 1e150;

impl TabulatedCurve {
    pub(super) fn new(bridge: &Bridge, folded: &Folded) -> Result<Self, OutOfRange> {
        let scale = bridge.harmonic_radius();
        let strength = PI * bridge.surface_tension() * scale;
        let terms = chebyshev::to_monomials(&folded.terms).map(|c| c * strength);
        finite("force of the bridge", terms.iter().map(|c| c.abs()).sum())?;
        let end = folded.rupture_distance(bridge);
        Ok(Self {
            a2: positive("2V/(πR)", 2.0 * bridge.volume() / (PI * scale))?,
            inverse_end: positive("inverse of the rupture distance", 1.0 / end)?,
            terms,
        })
    }
}

impl ForceCurve for TabulatedCurve {
    #[inline]
    fn force(&self, gap: f64) -> f64 {
        let gap = gap.clamp(0.0, FAR);
        let square = gap * gap;
        let small = 1.0 - (square / (square + self.a2)).sqrt();
        let x = (1.0 - gap * self.inverse_end).max(0.0);
        let tau = x.sqrt();
        let x2 = x * x;
        // Pairs in parallel, not one chain: shorter to wait for.
        let c = &self.terms;
        let low = (c[0] + c[1] * tau) + (c[2] + c[3] * tau) * x;
        let high = (c[4] + c[5] * tau) + (c[6] + c[7] * tau) * x + (c[8] + c[9] * tau) * x2;
        small * (low + high * x2)
    }
}
