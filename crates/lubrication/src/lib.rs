//! Viscous drag in liquid bridges, as coefficients that never add energy.

mod law;

pub use law::{NormalCurve, NormalDrag, Resistance, TangentialCurve, TangentialDrag};
pub use pendular_pair::{Bridge, Mate, OutOfRange, Range, Validity};
