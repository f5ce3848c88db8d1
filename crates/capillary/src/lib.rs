//! Capillary forces of pendular liquid bridges.
//!
//! Every law is a small value that turns a [`Bridge`] into a *curve*, the force over the gap, with
//! everything that is constant over the bridge's life folded once. [`AnyCapillary`] chooses among the
//! laws by name. The exact bridge is in [`young_laplace`], a fast table of it in [`tabulated`], and
//! [`mod@advise`] says which law is good enough for given bridges.
//!
//! Gaps are metres, volumes cubic metres, contact angles radians, surface tensions N/m; forces are N,
//! tension (attraction) positive. An overlap reads as gap 0.
//!
//! ```
//! use pendular_capillary::{AnyCapillary, Bridge, CapillaryLaw, ForceCurve, Mate, Range};
//! let bridge = Bridge::new(1e-3, Mate::Sphere { radius: 2e-3 }, 1e-11, [0.2; 2], 0.07275)?;
//! let exact = AnyCapillary::YoungLaplace.curve(&bridge, Range::Strict)?;
//! let fit = AnyCapillary::WillettFull.curve(&bridge, Range::Strict)?;
//! assert!((fit.force(5e-5) / exact.force(5e-5) - 1.0).abs() < 0.04);
//! # Ok::<(), pendular_capillary::OutOfRange>(())
//! ```
//!
//! Sources and ranges stand on the page of each law.
//!
//! # Not here
//! The force of Mikami, Kamiya & Horio (1998), Chem. Eng. Sci. 53, 1927, is not here: its
//! coefficients could not be confirmed. Two public codes disagree. One has those of
//! [`Soulie2006`]; those of the other meet the exact bridge within 12 % up to 0.9 of the rupture gap
//! for θ = 0 and V* from 1e-3 to 0.03, but let the force of small bridges grow with the angle.

pub mod advise;
mod any;
mod bagheri_2024;
mod checked;
mod lambert_2008;
mod law;
mod rabinovich_2005;
mod rabinovich_plane;
mod soulie_2006;
pub mod tabulated;
mod weigert_1999;
mod willett_2000_full;
mod willett_2000_reduced;
pub mod young_laplace;

pub use any::{AnyCapillary, AnyCurve, LawInfo, LawKind, UnknownLaw};
pub use bagheri_2024::{Bagheri2024, Bagheri2024Curve};
pub use lambert_2008::{Lambert2008, Lambert2008Curve};
pub use law::{CapillaryLaw, ForceCurve};
pub use pendular_pair::{Bridge, Mate, OutOfRange, Range, Validity};
pub use rabinovich_2005::{Rabinovich2005, Rabinovich2005Curve};
pub use rabinovich_plane::{
    RabinovichPlane, RabinovichPlaneSmallGap, RabinovichPlaneSmallGapCurve,
};
pub use soulie_2006::{Soulie2006, Soulie2006Curve};
pub use weigert_1999::{Weigert1999, Weigert1999Curve};
pub use willett_2000_full::{Willett2000Full, Willett2000FullCurve};
pub use willett_2000_reduced::{Willett2000Reduced, Willett2000ReducedCurve};

/// The particle-particle force of Israelachvili (2011), Intermolecular and Surface Forces, 3rd ed.,
/// as in Krull, Strohner & Antonyuk (2025), eq. (25): [`Lambert2008`] written with R* = R/2.
///
/// Their particle-wall formula, eq. (26), is [`RabinovichPlane`] once its factor 8 is read as 4.
pub use lambert_2008::Lambert2008 as Israelachvili2011;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
