//! Wet granular flow: liquid bridges composed with a discrete element core.
//!
//! The law crates know bridges, the core knows particles; this crate puts liquid between them and
//! is the only place where liquid changes hands. [`Wet`] is the pair term of the bridges, [`Ledger`]
//! the account of all liquid, [`MeshWalls`] the walls of `pendular-walls` as the core wants them.
//!
//! Every other crate of the workspace is re-exported under its short name.

mod adapters;
mod laws;
mod ledger;
mod split;
mod wet;

pub use adapters::MeshWalls;
pub use laws::{Liquid, NoDrag, PairLaws};
pub use ledger::{Account, Ledger, LedgerParts, Move};
pub use pendular_capillary as capillary;
pub use pendular_contact as contact;
pub use pendular_dem_core as dem;
pub use pendular_lubrication as lubrication;
pub use pendular_pair as pair;
pub use pendular_transfer as transfer;
pub use pendular_walls as walls;
pub use split::SplitMethod;
pub use wet::{
    Bodies, Column, Counts, Hold, LiveBridge, LiveState, WallElement, Wet, WetError, WetState,
};
