//! Energy of bridges.

use pendular_capillary::{CapillaryLaw, ForceCurve};
use pendular_lubrication::{NormalDrag, TangentialDrag};
use pendular_pair::OutOfRange;
use pendular_transfer::RuptureLaw;

use super::{LiveBridge, Wet};

/// Intervals of Simpson's rule; the error is far below that of the force laws.
const INTERVALS: u32 = 64;

impl<C, N, S> Wet<C, N, S>
where
    C: CapillaryLaw,
    N: NormalDrag,
    S: TangentialDrag,
{
    /// Capillary energy of a live bridge at `gap` m, J.
    ///
    /// ```text
    /// E_cap(S) = −∫_S^S_rup F dS
    /// ```
    ///
    /// It is 0 at the static rupture distance, so that rupture there changes no energy although the
    /// force is not 0; formation at a gap S_f releases −E_cap(S_f) without doing work.
    ///
    /// # Errors
    /// [`OutOfRange`] as when the bridge formed; it has formed, so that does not happen.
    pub fn capillary_energy(&self, live: &LiveBridge, gap: f64) -> Result<f64, OutOfRange> {
        let laws = self.laws(live.second);
        let curve = laws.capillary.curve(&live.bridge, self.range)?;
        Ok(energy(&curve, gap, laws.rupture.distance(&live.bridge, self.range)?))
    }

    /// The same of the live bridge of an account, without folding its laws again; `None` if there
    /// is no such bridge.
    #[must_use]
    pub fn energy_of(&self, bridge: u32, gap: f64) -> Option<f64> {
        let (_, far) = self.seated(bridge)?;
        Some(energy(&far.curves.0, gap, far.rupture))
    }

    /// Capillary energy that was lost so far, J: what formation released and what was left at
    /// rupture. With the energy of the live bridges it closes the account of capillary work.
    #[must_use]
    pub fn capillary_loss(&self) -> f64 {
        self.capillary_loss
    }

    /// Books the energy of a bridge at `gap` that ends (`sign` 1) or has formed (−1).
    pub(super) fn lose(&mut self, bridge: u32, gap: f64, sign: f64) {
        self.capillary_loss += sign * self.energy_of(bridge, gap).unwrap_or(0.0);
    }
}

/// In overlap the force is that at contact.
fn energy(curve: &impl ForceCurve, gap: f64, rupture: f64) -> f64 {
    let apart = gap.max(0.0);
    curve.force(0.0) * (gap - apart) - integral(curve, apart, rupture)
}

/// ∫ F dS from `from` to `to`, both at least 0; √S is the variable because forces start with a
/// steep fall at contact.
fn integral(curve: &impl ForceCurve, from: f64, to: f64) -> f64 {
    let (a, b) = (from.sqrt(), to.sqrt());
    let width = (b - a) / f64::from(INTERVALS);
    let at = |k: u32| {
        let x = a + f64::from(k) * width;
        2.0 * x * curve.force(x * x)
    };
    let inner: f64 = (1..INTERVALS).map(|k| at(k) * if k % 2 == 1 { 4.0 } else { 2.0 }).sum();
    width / 3.0 * (at(0) + inner + at(INTERVALS))
}
