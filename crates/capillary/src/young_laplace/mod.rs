//! The exact bridge: the Young-Laplace equation at constant volume, without gravity.
//!
//! The liquid's free surface has constant mean curvature. With y the radius of the meridian, α its
//! slope angle, s its length, Δp the pressure inside minus outside and q = −Δp/σ the scaled suction
//!
//! ```text
//! dα/ds = cos α / y + q,     F/(πσ) = 2 y cos α + q y²  (constant),
//! z = y exp(iα):  dz/ds = i (1 + q z),   z(s) = z₀ e^{iqs} + (e^{iqs} − 1)/q
//! ```
//!
//! so one closed formula covers nodoid, catenoid, unduloid, cylinder and sphere. The ends meet the
//! bodies under their contact angles, and Gauss-Legendre integration (80 points) gives gap and
//! volume. Newton's method finds the half-filling angle, the suction and the length. Continuation
//! in the volume between touching bodies starts from a small torus; pseudo-arc-length continuation
//! in the gap follows the stable branch to its end.
//!
//! # Stability
//! Axisymmetric disturbances at fixed volume and gap. The branch ends in a fold or, between equal
//! bodies under equal angles, in the symmetry-breaking pitchfork where that comes first, which it
//! does above contact angles of about 31° (24° at V* = 0.5). Rupture is the first of the two.
//!
//! # Accuracy
//! 1e-9 or better in force and rupture distance for V* = V/R³ from 1e-9 to 0.5, any two radii up to
//! a ratio of 100 and sphere-plane, contact angles below 90°. Other bridges are solved where a
//! stable one is found, else there is a typed error.
//!
//! ```
//! use pendular_capillary::{Bridge, Mate, young_laplace};
//! let bridge = Bridge::new(1e-3, Mate::Sphere { radius: 1e-3 }, 1e-12, [0.0; 2], 0.07275)?;
//! let contact = young_laplace::solve(&bridge, 0.0)?;
//! // 2πRσ cos θ less a deficit of a few per cent
//! assert!((contact.force / (2.0 * std::f64::consts::PI * 1e-3 * 0.07275) - 0.936).abs() < 1e-3);
//! let rupture = young_laplace::rupture(&bridge)?;
//! assert!(young_laplace::solve(&bridge, 1.01 * rupture.distance).is_err());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # References
//! Orr, Scriven & Rivas (1975), J. Fluid Mech. 67, 723 (profiles); Lian, Thornton & Adams (1993),
//! J. Colloid Interface Sci. 161, 138 (rupture as the fold); Vogel (1989), SIAM J. Appl. Math. 49,
//! 1009 (pitchfork between parallel plates at 31.1°).

mod complex;
mod error;
mod exact;
mod gauss;
mod law;
mod meridian;
mod newton;
mod path;
mod problem;
mod rupture;
mod solution;
#[cfg(test)]
mod tests;

pub use error::SolveError;
pub use exact::ExactBridge;
pub use law::{YoungLaplace, YoungLaplaceCurve};
pub use rupture::{Rupture, RuptureKind};
pub use solution::Solution;

use pendular_pair::Bridge;

/// The exact bridge at one gap.
///
/// For many gaps of one bridge make an [`ExactBridge`] once.
///
/// # Units
/// `gap` S m; overlap (S < 0) reads as S = 0. Everything in the [`Solution`] is SI.
///
/// # Errors
/// [`SolveError`] if the gap is not finite or beyond rupture, or if no stable bridge is found.
pub fn solve(bridge: &Bridge, gap: f64) -> Result<Solution, SolveError> {
    ExactBridge::new(bridge)?.solve(gap)
}

/// Rupture distance S_rup (m), its kind and the liquid's split at the neck of the last stable
/// bridge.
///
/// # Errors
/// [`SolveError`] if no stable bridge is found.
pub fn rupture(bridge: &Bridge) -> Result<Rupture, SolveError> {
    Ok(ExactBridge::new(bridge)?.rupture())
}
