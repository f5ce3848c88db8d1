//! The words that the wet-granular law crates share.
//!
//! A pendular liquid [`Bridge`] hangs between a sphere and its [`Mate`] (another sphere or a wall)
//! and is constant over its life but for the gap. A law says over which bridges it holds with a
//! [`Validity`]; whoever asks for more gets an [`OutOfRange`] or, with [`Range::Extrapolate`], an
//! answer that is known to be extrapolated.
//!
//! All quantities are SI `f64`: metres, cubic metres, newtons per metre, radians. Against a wall the
//! harmonic radius is 2 r, the reduced one r.
//!
//! ```
//! use pendular_pair::{Bridge, Mate};
//! let bridge = Bridge::new(2e-3, Mate::Sphere { radius: 1e-3 }, 1e-11, [0.0, 0.7], 0.07275)?;
//! assert!((bridge.harmonic_radius() - 4e-3 / 3.0).abs() < 1e-18);
//! # Ok::<(), pendular_pair::OutOfRange>(())
//! ```

mod bridge;
mod mate;
mod validity;

pub use bridge::Bridge;
pub use mate::Mate;
pub use validity::{OutOfRange, Range, Validity};

/// The README's program runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
