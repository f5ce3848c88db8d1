//! Where the liquid goes: films, formation of bridges, rupture, transfer ratios.

mod law;

pub use law::RuptureLaw;
pub use pendular_pair::{Bridge, Mate, OutOfRange, Range, Validity};
