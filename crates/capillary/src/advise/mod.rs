//! Which law do I need? The cheapest one whose measured error stays under a tolerance.
//!
//! The crate carries the largest relative error of every law against the exact bridge in cells over
//! V*, the two contact angles, the radius ratio and the gap, and what one `force(gap)` costs. The
//! example `make_advice` measures both.
//!
//! ```
//! use pendular_capillary::{AnyCapillary, advise::{self, BridgeRange}};
//! let spheres = BridgeRange {
//!     v_star: (1e-3, 1e-2),
//!     contact_angle: (0.0, 0.3),
//!     radius_ratio: (1.0, 1.0),
//!     gap: (0.0, 0.75),
//!     ..BridgeRange::default()
//! };
//! assert_eq!(advise::advise(&spheres, 1e-3)?.law, AnyCapillary::Tabulated);
//! let rough = advise::advise(&spheres, 0.5)?;
//! assert!(rough.nanoseconds < advise::advise(&spheres, 1e-3)?.nanoseconds);
//! # Ok::<(), advise::AdviseError>(())
//! ```

mod cells;
mod measure;

use std::f64::consts::FRAC_PI_3;
use std::sync::OnceLock;

use pendular_pair::OutOfRange;

use crate::AnyCapillary;
use cells::{ANGLE, Body, GAP, V_STAR};

pub use measure::measure_errors;

/// Errors per cell, laws innermost in the order of [`COSTS`], as codes of [`decode`].
static ERRORS: &[u8] = include_bytes!("errors.bin");

/// One line per law: name, ns per force, ns per curve.
static COSTS: &str = include_str!("costs.csv");

/// The bridges of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default))]
pub struct BridgeRange {
    /// Dimensionless volume V* = V/R³, within 1e-8 to 0.5.
    pub v_star: (f64, f64),
    /// Both contact angles, rad, within 0 to π/3.
    pub contact_angle: (f64, f64),
    /// Greatest difference of a bridge's two contact angles, rad; 0: equal angles.
    pub angle_difference: f64,
    /// Larger over smaller radius, from 1 to 100; an upper end of `f64::INFINITY` includes a plane.
    pub radius_ratio: (f64, f64),
    /// Gap over the rupture distance S/S_rup, within 0 to 0.98.
    pub gap: (f64, f64),
}

impl Default for BridgeRange {
    /// Equal spheres and equal angles, all volumes, angles and gaps.
    fn default() -> Self {
        Self {
            v_star: (V_STAR[0], V_STAR[V_STAR.len() - 1]),
            contact_angle: (0.0, FRAC_PI_3),
            angle_difference: 0.0,
            radius_ratio: (1.0, 1.0),
            gap: (0.0, GAP[GAP.len() - 1]),
        }
    }
}

/// A law and what it does over a range of bridges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Advice {
    /// The law.
    pub law: AnyCapillary,
    /// Its largest relative error of the force over the range, rounded up; infinite where the law
    /// refuses a bridge of the range.
    pub error: f64,
    /// Cost of one `force(gap)` on a prepared curve, ns, on the machine that `costs.csv` names.
    pub nanoseconds: f64,
    /// Cost of making a curve, ns.
    pub curve_nanoseconds: f64,
}

/// Why there is no advice.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AdviseError {
    /// The range leaves what was measured, or the tolerance is not a positive number.
    #[error(transparent)]
    OutOfRange(#[from] OutOfRange),
    /// No law is as good as that over the whole range.
    #[error("no law stays under {tolerance} there; the best is `{}` with {}", best.law, best.error)]
    NoLaw {
        /// Tolerance that was asked for.
        tolerance: f64,
        /// The law with the least error.
        best: Advice,
    },
}

/// The cheapest law whose largest relative error over a range of bridges stays under `tolerance`.
///
/// Errors are measured at the ends and in the middle of each cell that the range touches, so that
/// the answer may be a little too careful. Laws are taken in their own range of validity.
///
/// # Errors
/// [`AdviseError::OutOfRange`] if the range is not within what was measured;
/// [`AdviseError::NoLaw`], with the best law, if none meets the tolerance.
pub fn advise(range: &BridgeRange, tolerance: f64) -> Result<Advice, AdviseError> {
    OutOfRange::positive("tolerance", tolerance)?;
    let all = errors(range)?;
    let cheaper = |a: &&Advice, b: &&Advice| a.nanoseconds.total_cmp(&b.nanoseconds);
    if let Some(advice) = all.iter().filter(|a| a.error <= tolerance).min_by(cheaper) {
        return Ok(*advice);
    }
    let better = |a: &&Advice, b: &&Advice| a.error.total_cmp(&b.error);
    let nothing = OutOfRange { quantity: "laws measured", value: 0.0, allowed: (1.0, 100.0) };
    let best = *all.iter().min_by(better).ok_or(nothing)?;
    Err(AdviseError::NoLaw { tolerance, best })
}

/// Error and cost of every law over a range of bridges.
///
/// # Errors
/// [`OutOfRange`] if the range is not within what was measured.
pub fn errors(range: &BridgeRange) -> Result<Vec<Advice>, OutOfRange> {
    range.check()?;
    let mut advice = laws().to_vec();
    for body in range.bodies() {
        for volume in cells::touched(&V_STAR, range.v_star) {
            for gap in cells::touched(&GAP, range.gap) {
                let start = cells::offset(body, volume, gap, advice.len());
                for (law, code) in advice.iter_mut().zip(ERRORS.get(start..).unwrap_or_default()) {
                    law.error = law.error.max(decode(*code));
                }
            }
        }
    }
    Ok(advice)
}

impl BridgeRange {
    fn check(&self) -> Result<(), OutOfRange> {
        let within = |quantity, range: (f64, f64), allowed: (f64, f64)| {
            OutOfRange::within(quantity, range.0, (allowed.0, range.1.min(allowed.1)))?;
            OutOfRange::within(quantity, range.1, allowed)
        };
        within("dimensionless volume V/R^3", self.v_star, (V_STAR[0], V_STAR[V_STAR.len() - 1]))?;
        within("contact angle", self.contact_angle, (0.0, FRAC_PI_3))?;
        OutOfRange::within("angle difference", self.angle_difference, (0.0, FRAC_PI_3))?;
        within("radius ratio", self.radius_ratio, (1.0, f64::INFINITY))?;
        within("gap over rupture distance", self.gap, (0.0, GAP[GAP.len() - 1]))
    }

    fn bodies(&self) -> impl Iterator<Item = Body> {
        let degrees = (self.contact_angle.0.to_degrees(), self.contact_angle.1.to_degrees());
        let greatest = self.angle_difference.to_degrees().min(degrees.1 - degrees.0);
        let ratio = self.radius_ratio;
        cells::touched(&ANGLE, degrees).flat_map(move |angle| {
            cells::touched_differences(greatest).flat_map(move |difference| {
                cells::touched_ratios(ratio).map(move |ratio| Body { angle, difference, ratio })
            })
        })
    }
}

/// The laws that were measured, with their costs and no error yet.
fn laws() -> &'static [Advice] {
    static LAWS: OnceLock<Vec<Advice>> = OnceLock::new();
    LAWS.get_or_init(|| {
        let line = |line: &str| {
            let mut words = line.split(',');
            let law = words.next()?.parse().ok()?;
            let nanoseconds = words.next()?.parse().ok()?;
            let curve_nanoseconds = words.next()?.parse().ok()?;
            Some(Advice { law, error: 0.0, nanoseconds, curve_nanoseconds })
        };
        COSTS.lines().filter_map(line).collect()
    })
}

/// Steps of the code per decade of error.
const STEPS: f64 = 24.0;

/// Smallest error that is told from none: the exact bridge's own.
const LEAST: f64 = 1e-9;

/// A code as an error: 0 is 1e-9, 24 a decade, 255 no answer.
fn decode(code: u8) -> f64 {
    if code == u8::MAX { f64::INFINITY } else { LEAST * 10_f64.powf(f64::from(code) / STEPS) }
}

/// An error as a code, rounded up.
fn encode(error: f64) -> u8 {
    if error <= LEAST {
        return 0;
    }
    let code = (STEPS * (error / LEAST).log10()).ceil();
    // NaN and whatever is too large become `u8::MAX`.
    if code < f64::from(u8::MAX) { code as u8 } else { u8::MAX }
}

#[cfg(test)]
mod tests;
