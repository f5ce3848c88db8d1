//! Where the liquid goes: films, formation of bridges, rupture, transfer ratios.
//!
//! - [`film`]: thickness of a film from its volume and back.
//! - [`formation`]: what each body gives to a new bridge.
//! - [`rupture`] and [`AnyRupture`]: the gap at which a bridge breaks; [`Dynamic`] makes it longer
//!   at speed.
//! - [`split`]: what each body gets back.
//!
//! Nothing here keeps books: these are the numbers that whoever owns the films needs.

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
