//! A thin, fast, deterministic discrete element core for spheres.
//!
//! The core moves particles and finds the pairs of bodies that may touch; what happens within a
//! pair is the business of its [`PairTerm`]s: the dry [`Contact`] of this crate, or any other.
//! It knows no liquid and no screen. A term that is not there costs nothing.
//!
//! One step has two halves. *Read*: every pair is loaded from one snapshot of the particles.
//! *Write*: terms settle what pairs share, particles move. The particles are sorted along a space-
//! filling curve and cut into chunks of fixed size that own their pair lists, so the order of every
//! sum is fixed and results are the same to the bit on any number of threads and with any skin.
//!
//! Lengths are metres, masses kilograms, times seconds, spins radians per second.

mod boundary;
mod chunk;
mod contact;
mod error;
mod grid;
mod integrate;
mod lane;
mod limit;
mod lists;
mod order;
mod pair;
mod pairs;
mod particles;
mod pass;
mod profile;
mod simulation;
mod term;
mod wall_pass;

pub use boundary::{Boundary, NoWalls, Touch};
pub use contact::{Contact, PairContact, Spring};
pub use error::{ParticleError, SimulationError};
pub use glam;
pub use glam::DVec3;
pub use lane::{Four, Lane, Vector};
pub use limit::{Limit, Load as StabilityLoad};
pub use pair::{Encounter, Load, Pair, Partner};
pub use pairs::{Columns, Geometry, Loads, Pairs};
pub use particles::{Class, Particle, Particles};
pub use profile::Profile;
pub use simulation::{Departure, RollState, Settings, Simulation, Snapshot, WallMemory};
pub use term::{PairTerm, TermError, Visit};
