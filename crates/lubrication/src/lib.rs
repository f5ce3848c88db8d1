#![doc = include_str!("../README.md")]

mod adams_perchard_1985;
mod any;
mod gap;
mod goldman_1967;
mod goldman_literal;
mod jeffrey_onishi_1984;
mod law;
mod lian_1998;
mod option;
mod pitois_2000;
mod popov_2010;
mod restitution;

pub use adams_perchard_1985::{AdamsPerchard1985, AdamsPerchard1985Curve};
pub use any::{
    AnyNormalCurve, AnyNormalDrag, AnyTangentialCurve, AnyTangentialDrag, NormalModel,
    TangentialModel, UnknownDrag,
};
pub use gap::{Gap, Overlap, Regularisation};
pub use goldman_1967::{Goldman1967, Goldman1967Curve};
pub use goldman_literal::{GoldmanLiteral, GoldmanLiteralCurve, LiteralLoad};
pub use jeffrey_onishi_1984::{JeffreyOnishi1984, JeffreyOnishi1984Curve};
pub use law::{NormalCurve, NormalDrag, Resistance, TangentialCurve, TangentialDrag};
pub use lian_1998::{Lian1998, Lian1998Curve};
pub use pendular_pair::{Bridge, Mate, OutOfRange, Range, Validity};
pub use pitois_2000::{Pitois2000, Pitois2000Curve};
pub use popov_2010::{Popov2010, Popov2010Curve};
pub use restitution::{critical_stokes_number, stokes_number, wet_restitution};
