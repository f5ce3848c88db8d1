//! What acts in one bridge, force by force: for budgets and reports, not for the step.

use glam::DVec3;
use pendular_capillary::{CapillaryLaw, ForceCurve};
use pendular_dem_core::{Pair, StabilityLoad};
use pendular_lubrication::{NormalCurve, NormalDrag, TangentialCurve, TangentialDrag};
use pendular_pair::OutOfRange;
use pendular_transfer::RuptureLaw;

use super::{LiveBridge, Wet};

/// The forces of one bridge.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BridgeForces {
    /// Capillary tension, N.
    pub capillary: f64,
    /// Viscous force along the line of centres, N, positive as tension.
    pub viscous_normal: f64,
    /// Viscous force on the first body across it, N.
    pub viscous_tangential: DVec3,
    /// Viscous torque on the first body beside that of the force, N m.
    pub couple: DVec3,
    /// Power that the viscous force along the line of centres takes, W.
    pub normal_power: f64,
    /// Power that the viscous force and torque across it take, W.
    pub tangential_power: f64,
    /// Whether the gap is beyond the static rupture distance: speed alone keeps the bridge.
    pub stretched: bool,
}

impl<C, N, S> Wet<C, N, S>
where
    C: CapillaryLaw,
    N: NormalDrag,
    S: TangentialDrag,
{
    /// The live bridge of an account.
    #[must_use]
    pub fn live(&self, bridge: u32) -> Option<&LiveBridge> {
        self.live.get(bridge as usize)?.as_ref().map(|seated| &seated.live)
    }

    /// What acts in a live bridge, by the same laws as the step.
    ///
    /// # Errors
    /// [`OutOfRange`] as when the bridge formed; it has formed, so that does not happen.
    pub fn forces(&self, live: &LiveBridge, pair: &Pair) -> Result<BridgeForces, OutOfRange> {
        let (laws, gap) = (self.laws(live.second), pair.encounter.gap);
        let viscosity = self.liquid.viscosity;
        let capillary = laws.capillary.curve(&live.bridge, self.range)?.force(gap);
        let drag = laws.normal.curve(&live.bridge, viscosity)?.coefficient(gap);
        let resistance = laws.tangential.curve(&live.bridge, viscosity)?.resistance(gap);
        let reduced = live.bridge.reduced_radius();
        let turning = reduced * pair.spin.cross(pair.half_step_normal);
        let shear = -(resistance.slip * pair.slip + resistance.coupling * turning);
        let rolling = -(resistance.coupling * pair.slip + resistance.rolling * turning);
        let speed = pair.separation_speed;
        Ok(BridgeForces {
            capillary,
            viscous_normal: drag * speed,
            viscous_tangential: shear,
            couple: reduced * pair.normal.cross(rolling),
            normal_power: drag * speed * speed,
            tangential_power: -(shear.dot(pair.slip) + rolling.dot(turning)),
            stretched: gap > laws.rupture.distance(&live.bridge, self.range)?,
        })
    }

    /// Drag coefficients of a live bridge, as they enter the stability limit.
    pub(super) fn drag_on_limit(&self, bridge: u32, gap: f64) -> StabilityLoad {
        let coefficients = || {
            let live = self.live(bridge)?;
            let (laws, viscosity) = (self.laws(live.second), self.liquid.viscosity);
            let normal = laws.normal.curve(&live.bridge, viscosity).ok()?;
            let tangential = laws.tangential.curve(&live.bridge, viscosity).ok()?;
            Some((normal.coefficient(gap), tangential.resistance(gap).slip))
        };
        let (normal_drag, tangential_drag) = coefficients().unwrap_or_default();
        StabilityLoad { normal_drag, tangential_drag, ..StabilityLoad::default() }
    }
}
