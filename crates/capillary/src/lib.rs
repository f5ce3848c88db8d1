//! Capillary forces of pendular liquid bridges.
//!
//! Every law is a small value that turns a [`Bridge`] into a *curve*, the force over the gap, with
//! everything that is constant over the bridge's life folded once.

mod law;
pub mod young_laplace;

pub use law::{CapillaryLaw, ForceCurve};
pub use pendular_pair::{Bridge, Mate, OutOfRange, Range, Validity};
