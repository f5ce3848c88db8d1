use pendular_pair::{Bridge, OutOfRange, Range, Validity};

use super::curve::TabulatedCurve;
use super::folded::Folded;
use super::grid::{ANGLE, V_STAR, look_up};
use super::pairs::Pair;
use crate::CapillaryLaw;

/// Radii and angles that agree to this are taken as equal.
const EQUAL: f64 = 1e-12;

/// How far, relative, the table is read beyond its ends.
const EDGE: f64 = 1e-9;

/// Smallest V* that is folded: below, powers of V* eat the digits of the coefficients.
const SMALLEST: f64 = 1e-12;

/// The exact bridge's force from a table.
///
/// ```text
/// F = (1 − S/H) (c₀ + c₁ τ + … + c₉ τ⁹),   H = √(S² + 2V/(πR)),   τ = √(1 − S/S_rup)
/// ```
///
/// # Units
/// gap m, volume m³, contact angle rad, surface tension N/m → force N, tension positive.
/// # Range
/// V* from 1e-9 to 0.5, contact angles to 60°, any two spheres and sphere-plane; below 1e-6, and
/// with `Range::Extrapolate` anywhere above 1e-12, the exact solver folds the bridge where it finds
/// a stable one.
/// # Limits
/// gap → 0: the exact contact force. Beyond rupture the force fades like 1 − S/H.
/// # References
/// See the [module](crate::tabulated) for representation, accuracy and cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tabulated;

const VALIDITY: Validity =
    Validity { v_star: (1e-9, V_STAR.1), contact_angle: (0.0, ANGLE), ..Validity::ALL };

impl CapillaryLaw for Tabulated {
    type Curve = TabulatedCurve;

    fn validity(&self) -> Validity {
        VALIDITY
    }

    fn curve(&self, bridge: &Bridge, range: Range) -> Result<Self::Curve, OutOfRange> {
        VALIDITY.admit(bridge, range)?;
        TabulatedCurve::new(bridge, &fold(bridge)?)
    }
}

/// Exact rupture distance S_rup from the table, m.
///
/// # Errors
/// [`OutOfRange`] where neither the table nor the exact solver has a stable bridge.
pub fn rupture_distance(bridge: &Bridge) -> Result<f64, OutOfRange> {
    Ok(fold(bridge)?.rupture_distance(bridge))
}

/// Exact share of the liquid that goes to the first body at rupture, from the table.
///
/// It is the liquid on the first body's side of the neck of the last stable bridge.
///
/// # Errors
/// [`OutOfRange`] where neither the table nor the exact solver has a stable bridge.
pub fn transfer_ratio(bridge: &Bridge) -> Result<f64, OutOfRange> {
    Ok(fold(bridge)?.share)
}

/// The folded bridge, its share that of the first body.
fn fold(bridge: &Bridge) -> Result<Folded, OutOfRange> {
    let [first, second] = bridge.contact_angles();
    // The table's ends include their rounding.
    let volumes = V_STAR.0 * (1.0 - EDGE)..=V_STAR.1 * (1.0 + EDGE);
    let inside = volumes.contains(&bridge.v_star()) && first.max(second) <= ANGLE * (1.0 + EDGE);
    if !inside {
        return exact(bridge);
    }
    let mate = bridge.mate().radius();
    let even = (bridge.radius() / mate - 1.0).abs() < EQUAL;
    let same = (first - second).abs() < EQUAL;
    let swapped = if even { first > second } else { bridge.radius() > mate };
    let folded = if same {
        look_up(bridge)
    } else {
        let angles = if swapped { [second, first] } else { [first, second] };
        let ratio = if even { 1.0 } else { 1.0 / bridge.radius_ratio() };
        match (Pair { angles, ratio }).look_up(bridge.v_star()) {
            Some(folded) => folded,
            None => return exact(bridge),
        }
    };
    let share = if even && same { 0.5 } else { folded.share.clamp(0.0, 1.0) };
    Ok(Folded { share: if swapped { 1.0 - share } else { share }, ..folded })
}

/// The exact solver's fold, for bridges outside the table.
fn exact(bridge: &Bridge) -> Result<Folded, OutOfRange> {
    let none = OutOfRange {
        quantity: "dimensionless volume V/R^3 of a stable bridge",
        value: bridge.v_star(),
        allowed: VALIDITY.v_star,
    };
    if bridge.v_star() < SMALLEST {
        return Err(none);
    }
    Folded::exact(bridge).map_err(|_| none)
}
