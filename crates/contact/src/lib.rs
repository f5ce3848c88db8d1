//! Dry contact laws of spheres, in scalars: what a DEM code needs to know of one contact.

mod law;

pub use law::NormalContact;
