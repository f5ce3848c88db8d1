//! Viscous drag in liquid bridges, as coefficients that never add energy.

mod adams_perchard_1985;
mod any;
mod gap;
mod law;
mod pitois_2000;
mod popov_2010;

pub use adams_perchard_1985::{AdamsPerchard1985, AdamsPerchard1985Curve};
pub use any::{
    AnyNormalCurve, AnyNormalDrag, AnyTangentialCurve, AnyTangentialDrag, NormalModel,
    TangentialModel, UnknownDrag,
};
pub use gap::{Gap, Overlap, Regularisation};
pub use law::{NormalCurve, NormalDrag, Resistance, TangentialCurve, TangentialDrag};
pub use pendular_pair::{Bridge, Mate, OutOfRange, Range, Validity};
pub use pitois_2000::{Pitois2000, Pitois2000Curve};
pub use popov_2010::{Popov2010, Popov2010Curve};
