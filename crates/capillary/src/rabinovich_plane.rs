use std::f64::consts::PI;

use pendular_pair::{Bridge, OutOfRange, Range, Validity};

use crate::checked::{finite, positive};
use crate::{CapillaryLaw, ForceCurve, Lambert2008Curve};

/// The bridges of both sphere-plane laws.
const PLANES: Validity = Validity {
    v_star: (0.0, 0.1),
    contact_angle: (0.0, 50f64.to_radians()),
    angle_difference: 40f64.to_radians(),
    radius_ratio: (f64::INFINITY, f64::INFINITY),
};

/// Refuses a sphere as second body, whatever the range: these formulas have no second radius.
fn require_plane(bridge: &Bridge) -> Result<(), OutOfRange> {
    OutOfRange::within("radius ratio", bridge.radius_ratio(), PLANES.radius_ratio)
}

/// Rabinovich's sphere-plane force: a sphere on a plane wall.
///
/// ```text
/// F = 2 π σ rᵢ (cos θᵢ + cos θ_w) / (1 + S/d),   d = −S + √(S² + V/(π rᵢ))
/// ```
///
/// The same number as [`Lambert2008`](crate::Lambert2008) with R = 2 rᵢ, and the same curve.
/// A second term `2 π σ rᵢ sin φ sin(θ + φ)`, as in Elskamp & Kruggel-Emden (2018), eq. (15), would
/// count the contact line twice and is left out.
///
/// # Units
/// Gap m, volume m³, contact angle rad, surface tension N/m; force N, tension positive.
///
/// # Range
/// A wall only: a sphere as mate is an error in either range. V* = V/(2 rᵢ)³ ≤ 0.1, angles up to
/// 50°, at most 40° apart. Too large at contact, by 8 % at V* = 1e-3 and 36 % at 0.1 for θ = 0 (11
/// and 56 % for 40°); too small from mid-gap on, by up to 24 % for θ = 0 and 50 % for 40°.
///
/// # Limits
/// Gap → 0: `2 π rᵢ σ (cos θᵢ + cos θ_w)`. Never increases with the gap.
///
/// # Example
/// ```
/// use pendular_capillary::{Bridge, CapillaryLaw, Mate, RabinovichPlane, Range};
/// let bridge = Bridge::new(12e-6, Mate::PLANE, 7e-19, [0.0; 2], 26e-3)?;
/// let contact = RabinovichPlane.force(&bridge, 0.0, Range::Strict)?;
/// // By hand: 4 π r σ.
/// assert!((contact / (4.0 * std::f64::consts::PI * 12e-6 * 26e-3) - 1.0).abs() < 1e-14);
/// # Ok::<(), pendular_capillary::OutOfRange>(())
/// ```
///
/// # References
/// Rabinovich, Esayanur, Moudgil (2005), Langmuir 21, 10992.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct RabinovichPlane;

impl CapillaryLaw for RabinovichPlane {
    type Curve = Lambert2008Curve;

    fn validity(&self) -> Validity {
        PLANES
    }

    fn curve(&self, bridge: &Bridge, range: Range) -> Result<Lambert2008Curve, OutOfRange> {
        self.validity().admit(bridge, range)?;
        require_plane(bridge)?;
        Lambert2008Curve::new(bridge)
    }
}

/// The small-gap form of [`RabinovichPlane`] that Elskamp & Kruggel-Emden use.
///
/// ```text
/// F = 2 π σ rᵢ (cos θᵢ + cos θ_w) / (1 + S √(π rᵢ/V))
/// ```
///
/// # Units
/// Gap m, volume m³, contact angle rad, surface tension N/m; force N, tension positive.
///
/// # Range
/// As [`RabinovichPlane`], and small gaps, S ≪ √(V/(π rᵢ)): it falls as 1/S instead of 1/S² and is
/// up to ten times too large near rupture (V* = 1e-4: 2.5 times at a third of the rupture gap).
///
/// # Limits
/// Gap → 0: value and slope of [`RabinovichPlane`]. Never increases with the gap.
///
/// # Example
/// ```
/// use pendular_capillary::{Bridge, CapillaryLaw, Mate, RabinovichPlaneSmallGap, Range};
/// let bridge = Bridge::new(12e-6, Mate::PLANE, 7e-19, [0.0; 2], 26e-3)?;
/// let gap = (7e-19 / (std::f64::consts::PI * 12e-6_f64)).sqrt();
/// let force = RabinovichPlaneSmallGap.force(&bridge, gap, Range::Strict)?;
/// // By hand: at S = √(V/(π r)) half the contact force.
/// assert!((force / (2.0 * std::f64::consts::PI * 12e-6 * 26e-3) - 1.0).abs() < 1e-14);
/// # Ok::<(), pendular_capillary::OutOfRange>(())
/// ```
///
/// # References
/// Elskamp & Kruggel-Emden (2018), Chem. Eng. Res. Des. 136, 593, eq. (15), without its second term.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct RabinovichPlaneSmallGap;

/// The force of [`RabinovichPlaneSmallGap`] over the gap: one division per call.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RabinovichPlaneSmallGapCurve {
    /// 2 π σ r_i (cos θ_i + cos θ_w), N.
    contact: f64,
    /// √(π r_i/V), 1/m.
    scale: f64,
}

impl CapillaryLaw for RabinovichPlaneSmallGap {
    type Curve = RabinovichPlaneSmallGapCurve;

    fn validity(&self) -> Validity {
        PLANES
    }

    fn curve(&self, bridge: &Bridge, range: Range) -> Result<Self::Curve, OutOfRange> {
        self.validity().admit(bridge, range)?;
        require_plane(bridge)?;
        let radius = bridge.radius();
        let contact = 2.0 * PI * bridge.surface_tension() * radius * bridge.cosine_sum();
        let scale = (PI * radius / bridge.volume()).sqrt();
        Ok(RabinovichPlaneSmallGapCurve {
            contact: finite("contact force", contact)?,
            scale: positive("inverse bridge length sqrt(pi r/V)", scale)?,
        })
    }
}

impl ForceCurve for RabinovichPlaneSmallGapCurve {
    #[inline]
    fn force(&self, gap: f64) -> f64 {
        self.contact / (1.0 + gap.max(0.0) * self.scale)
    }
}

#[cfg(test)]
#[path = "rabinovich_plane_tests.rs"]
mod tests;
