//! Where the liquid goes: films, formation of bridges, rupture, transfer ratios.
//!
//! - [`film`]: thickness of a film from its volume and back.
//! - [`formation`]: what each body gives to a new bridge.
//! - [`rupture`] and [`AnyRupture`]: the gap at which a bridge breaks; [`Dynamic`] makes it longer
//!   at speed.
//! - [`split`]: what each body gets back.
//!
//! Nothing here keeps books: these are the numbers that whoever owns the films needs.
//!
//! Lengths are metres, volumes cubic metres, contact angles radians, speeds m/s. Ratios and shares lie
//! in 0 to 1.
//!
//! ```
//! use pendular_transfer::{AnyRupture, Bridge, Mate, Range, RuptureLaw, split};
//! // A POM sphere (40°) on steel (45°), 1 mm³ of water.
//! let angles = [40f64.to_radians(), 45f64.to_radians()];
//! let bridge = Bridge::new(5e-3, Mate::PLANE, 1e-9, angles, 0.07275)?;
//! let exact = AnyRupture::Tabulated.distance(&bridge, Range::Strict)?;
//! let fit = AnyRupture::WillettUnequal.distance(&bridge, Range::Strict)?;
//! assert!((fit / exact - 1.0).abs() < 0.13);
//! let [sphere, plane] = split::exact(&bridge)?.shares(bridge.volume());
//! assert!((sphere + plane - 1e-9).abs() < 1e-24);
//! # Ok::<(), pendular_transfer::OutOfRange>(())
//! ```
//!
//! # Sources
//! Shi & McCarthy (2008), Powder Technol. 184, 64; Elskamp & Kruggel-Emden (2018), Chem. Eng. Res.
//! Des. 136, 593; the laws' own on their pages.

mod any;
mod dynamic;
mod error;
pub mod film;
pub mod formation;
mod law;
mod root;
pub mod rupture;
pub mod split;

pub use any::AnyRupture;
pub use dynamic::{Dynamic, DynamicCurve};
pub use error::{NoSolution, TableFault, TransferError};
pub use law::RuptureLaw;
pub use pendular_pair::{Bridge, Mate, OutOfRange, Range, Validity};
pub use split::Split;

/// The README's program runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
