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
//!
//! ```
//! use pendular_dem_core::{Class, DVec3, NoWalls, Particles, Settings, Simulation};
//! // A free fall of 0.1 s without any term: g t²/2.
//! let mut particles = Particles::new(vec![Class::new(1e-3, 2500.0, 0)?])?;
//! particles.push(0, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO)?;
//! let mut simulation = Simulation::new(particles, (), NoWalls, Settings::new(1e-4))?;
//! simulation.advance(1_000)?;
//! let fallen = simulation.particles().iter().next().map_or(0.0, |p| -p.position.z);
//! assert!((fallen - 0.5 * 9.81 * 0.01).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Sources
//! Contact forces: see `pendular-contact`. Half-step normal: Vyas et al. (2025), Comput. Phys. Commun.
//! 310, 109524. Limits of the step in packings: O'Sullivan & Bray (2004), Eng. Comput. 21, 278;
//! Otsubo, O'Sullivan & Shire (2017), Comput. Geotech. 86, 67.

mod block;
mod boundary;
mod chunk;
mod compose;
mod contact;
mod error;
mod grid;
mod held;
mod implicit;
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
mod view;
mod visits;
mod wall_pass;

pub use boundary::{Boundary, NoWalls, Touch};
pub use contact::{Contact, ContactForces, PairContact, Spring};
pub use error::{ParticleError, SimulationError};
pub use glam;
pub use glam::DVec3;
pub use implicit::{Implicit, Impulse, Passes, Resist};
pub use lane::{Four, Lane, Vector};
pub use limit::{Limit, Load as StabilityLoad};
pub use pair::{Encounter, Load, Pair, Partner};
pub use pairs::{Columns, Geometry, Loads, Pairs};
pub use particles::{Class, Particle, Particles};
pub use profile::Profile;
pub use simulation::{
    Departure, MOST_THREADS, RollState, Settings, Simulation, Snapshot, WallMemory,
};
pub use term::{EachColumn, PairTerm, TermError};
pub use visits::{Visit, Visits};

/// The README's program runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
