//! What acts in one bridge, force by force: for budgets and reports, not for the step.

use glam::DVec3;
use pendular_capillary::{CapillaryLaw, ForceCurve};
use pendular_dem_core::{Pair, StabilityLoad};
use pendular_lubrication::{NormalCurve, NormalDrag, TangentialCurve, TangentialDrag};

use super::shelf::Far;
use super::{LiveBridge, Seated, Wet};
use crate::Account;

/// What is kept of a bridge with these laws.
pub(super) type FarOf<C, N, S> =
    Far<<C as CapillaryLaw>::Curve, <N as NormalDrag>::Curve, <S as TangentialDrag>::Curve>;

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
    pub fn live(&self, bridge: u32) -> Option<LiveBridge> {
        let Seated { split, first, second, .. } = *self.live.get(bridge as usize)?.as_ref()?;
        let volume = self.ledger.volume(Account::Bridge(bridge));
        // It was made so when it formed.
        let bridge = self.bridge(first, second, volume).ok()?;
        Some(LiveBridge { bridge, split, first, second })
    }

    /// A live bridge with what acts in it.
    pub(super) fn seated(&self, bridge: u32) -> Option<(LiveBridge, FarOf<C, N, S>)> {
        let seated = self.live.get(bridge as usize)?.as_ref()?;
        Some((self.live(bridge)?, self.shelf.far(seated.seat)?))
    }

    /// What acts in the live bridge of an account, by the same laws as the step; `None` if there is
    /// no such bridge.
    #[must_use]
    pub fn forces(&self, bridge: u32, pair: &Pair) -> Option<BridgeForces> {
        let (live, far) = self.seated(bridge)?;
        let gap = pair.encounter.gap;
        let (capillary, normal, tangential) = &far.curves;
        let (drag, resistance) = (normal.coefficient(gap), tangential.resistance(gap));
        let reduced = live.bridge.reduced_radius();
        let turning = reduced * pair.spin.cross(pair.half_step_normal);
        let shear = -(resistance.slip * pair.slip + resistance.coupling * turning);
        let rolling = -(resistance.coupling * pair.slip + resistance.rolling * turning);
        let speed = pair.separation_speed;
        Some(BridgeForces {
            capillary: capillary.force(gap),
            viscous_normal: drag * speed,
            viscous_tangential: shear,
            couple: reduced * pair.normal.cross(rolling),
            normal_power: drag * speed * speed,
            tangential_power: -(shear.dot(pair.slip) + rolling.dot(turning)),
            stretched: gap > far.rupture,
        })
    }

    /// Drag coefficients of a live bridge, as they enter the stability limit.
    pub(super) fn drag_on_limit(&self, bridge: u32, gap: f64) -> StabilityLoad {
        let coefficients = |(_, far): (_, FarOf<C, N, S>)| {
            (far.curves.1.coefficient(gap), far.curves.2.resistance(gap).slip)
        };
        let both = self.seated(bridge).map(coefficients);
        let (normal_drag, tangential_drag) = both.unwrap_or_default();
        StabilityLoad { normal_drag, tangential_drag, ..StabilityLoad::default() }
    }
}
