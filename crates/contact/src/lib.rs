#![doc = include_str!("../README.md")]

mod any;
mod damping;
mod elastic_plastic;
mod error;
mod hertz_mindlin;
mod impact;
mod law;
mod linear;
mod material;
mod plastic_energy;

pub use any::{AnyContact, ContactModel, UnknownContact};
pub use damping::{Dashpot, damping_ratio, dashpot, restitution};
pub use elastic_plastic::{ElasticPlastic, PlasticMemory};
pub use error::ContactError;
pub use hertz_mindlin::HertzMindlin;
pub use impact::{Impact, impact};
pub use law::NormalContact;
pub use linear::Linear;
pub use material::{Elastic, tangential_ratio};
