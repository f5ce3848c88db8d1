//! Wet granular flow: liquid bridges composed with a discrete element core.
//!
//! The law crates know bridges, the core knows particles; this crate puts liquid between them and
//! is the only place where liquid changes hands. [`Wet`] is the pair term of the bridges, [`Ledger`]
//! the account of all liquid, [`MeshWalls`] the walls of `pendular-walls` as the core wants them.
//!
//! Every other crate of the workspace is re-exported under its short name. All quantities are SI
//! `f64`, angles in radians.
//!
//! ```
//! use pendular::{Account, Ledger, Move};
//! // Two films of 1 and 2 mm³; a bridge asks the first for more than it has.
//! let mut ledger = Ledger::new(vec![1e-9, 2e-9], 0);
//! let bridge = Account::Bridge(ledger.open_bridge());
//! let from = |film, volume| Move { from: Account::Film(film), to: bridge, volume };
//! ledger.book(&mut [from(0, 4e-9), from(1, 0.5e-9)]);
//! assert_eq!(ledger.volume(Account::Film(0)), 0.0);
//! assert!((ledger.volume(bridge) / 1.5e-9 - 1.0).abs() < 1e-15);
//! assert!(ledger.imbalance().abs() < 1e-15);
//! ```
//!
//! A whole simulation is in the crate's README.
//!
//! # Sources
//! Formation, rupture and the order of booking: Elskamp & Kruggel-Emden (2018), Chem. Eng. Res. Des.
//! 136, 593; Shi & McCarthy (2008), Powder Technol. 184, 64. Where claims exceed a film the sources
//! say nothing; here they are scaled down in proportion.

mod adapters;
mod budget;
mod laws;
mod ledger;
mod room;
mod split;
mod wet;

pub use adapters::MeshWalls;
pub use budget::{Acting, Against, Budget, Share};
pub use laws::{Liquid, NoDrag, PairLaws};
pub use ledger::{Account, BadMove, Ledger, LedgerParts, Move};
pub use pendular_capillary as capillary;
pub use pendular_contact as contact;
pub use pendular_dem_core as dem;
pub use pendular_lubrication as lubrication;
pub use pendular_pair as pair;
pub use pendular_transfer as transfer;
pub use pendular_walls as walls;
pub use split::SplitMethod;
pub use wet::{
    Bodies, BridgeForces, Counts, Hold, LiveBridge, LiveState, WallElement, Wet, WetError, WetState,
};

/// The README's program runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
