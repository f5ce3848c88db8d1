//! Walls for spheres: where a sphere touches them, how they move, where their liquid sits.
//!
//! [`Walls`] are made of [`Part`]s. A part is a surface ([`Shape`]: a triangle [`Mesh`], a
//! [`Plane`], a [`Wire`], a [`Frame`]) with a [`Motion`], a material and a time until which it is
//! there. A [`Sieve`] makes the parts of a round screen of crossed wires; [`mod@build`] makes
//! boxes, plates and prisms; [`Mesh::from_stl`] reads the rest.
//!
//! A query answers with a [`Touch`]: the gap between the surfaces, the direction, and the element
//! of the part, which is the patch whose liquid is at stake. Forces, liquid and time stepping are
//! the caller's.
//!
//! All quantities are SI `f64`: metres, seconds, hertz, radians.
//!
//! ```
//! use pendular_walls::{FrameKind, Sieve, Walls, Wires, glam::DVec3};
//! let sieve = Sieve {
//!     aperture: 8e-3,
//!     wire_diameter: 2e-3,
//!     frame_radius: 0.05,
//!     frame_bottom: -0.01,
//!     frame_top: 0.05,
//!     wires: Wires::Cylinders,
//!     frame: FrameKind::Cylinder { patches: [12, 4] },
//!     element_length: 10e-3,
//! };
//! let walls = Walls::new(sieve.parts()?)?;
//!
//! // A 10 mm sphere in an aperture rests on four wires, sqrt(6² - 5²) mm above their axes.
//! let (centre, radius) = (DVec3::new(0.0, 0.0, 11f64.sqrt() * 1e-3), 5e-3);
//! let (mut near, mut candidates, mut touches) = (Vec::new(), Vec::new(), Vec::new());
//! walls.near(centre, radius + 1e-6, &mut near);
//! assert_eq!(near.len(), 4);
//! for &part in &near {
//!     walls.candidates(part, centre, radius + 1e-6, &mut candidates);
//!     walls.touches(part, &candidates, centre, radius, 1e-6, &mut touches);
//!     assert!(touches[0].gap.abs() < 1e-15);
//! }
//! # Ok::<(), pendular_walls::WallError>(())
//! ```

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
