//! Walls for spheres: where a sphere touches them, how they move, where their liquid sits.

mod bounds;
pub mod build;
mod cylinder;
mod error;
mod mesh;
mod motion;
mod part;
mod plane;
mod shape;
mod sieve;
mod stl;
mod touch;
mod triangle;
mod walls;

pub use cylinder::{Frame, Wire};
pub use error::{Origin, WallError};
pub use glam;
pub use mesh::Mesh;
pub use motion::{Harmonic, Motion};
pub use part::Part;
pub use plane::Plane;
pub use shape::{Shape, Tessellation};
pub use sieve::{FrameKind, Sieve, Wires};
pub use touch::Touch;
pub use walls::Walls;
