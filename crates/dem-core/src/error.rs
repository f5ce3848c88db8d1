use crate::{Partner, TermError};

/// Largest coordinate of a particle, m.
pub(crate) const FARTHEST: f64 = 1e6;

/// What is wrong with a particle or a class of particles.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ParticleError {
    /// A class has a radius or density that is not positive and finite.
    #[error("{quantity} = {value} of a particle class must be positive and finite")]
    Class {
        /// `radius` or `density`.
        quantity: &'static str,
        /// Its value, SI.
        value: f64,
    },
    /// A particle names a class that is not there.
    #[error("class {class} does not exist: there are {classes} classes")]
    UnknownClass {
        /// The class named.
        class: u16,
        /// How many there are.
        classes: usize,
    },
    /// A position, velocity or spin is not finite.
    #[error("{quantity} of particle {id} is not finite")]
    NotFinite {
        /// `position`, `velocity` or `spin`.
        quantity: &'static str,
        /// The particle it was meant for.
        id: u32,
    },
    /// A position is too far from the origin to be meant.
    #[error("particle {id} lies {distance:.3e} m from the origin; allowed: up to {FARTHEST:.0e} m")]
    Far {
        /// The particle it was meant for.
        id: u32,
        /// Largest coordinate, m.
        distance: f64,
    },
    /// More classes or particles than the indices can hold.
    #[error("more than {allowed} {what}")]
    TooMany {
        /// `classes` or `particles`.
        what: &'static str,
        /// The largest number allowed.
        allowed: usize,
    },
}

/// Why a simulation could not be set up or go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SimulationError {
    /// A setting is not usable.
    #[error("{quantity} = {value} must be positive and finite")]
    Setting {
        /// The setting's name.
        quantity: &'static str,
        /// Its value, SI.
        value: f64,
    },
    /// The time step is longer than the packing allows.
    #[error(
        "time step {time_step:.3e} s is above the limit {allowed:.3e} s that class {class} \
         (radius {radius:.3e} m) sets through the {term}"
    )]
    TimeStep {
        /// The step asked for, s.
        time_step: f64,
        /// The longest step allowed, s.
        allowed: f64,
        /// The class that limits it.
        class: usize,
        /// That class's radius, m.
        radius: f64,
        /// What limits it: springs and dashpots of the contact, or viscous drag.
        term: &'static str,
    },
    /// A wall part has a material that a term has no law for.
    #[error("a wall part has material {material}, but the term knows {known} wall materials")]
    WallMaterial {
        /// The material's index.
        material: usize,
        /// How many the term knows.
        known: usize,
    },
    /// Bodies overlap too much at the start.
    #[error(
        "particle {first} overlaps {second:?} by {overlap:.3e} m at the start, more than {allowed:.3e} m"
    )]
    StartOverlap {
        /// The particle.
        first: u32,
        /// What it overlaps.
        second: Partner,
        /// Overlap, m.
        overlap: f64,
        /// The largest overlap allowed, m.
        allowed: f64,
    },
    /// A position or velocity became NaN or infinite.
    #[error("particle {id} has a position or velocity that is not finite at t = {time:.9} s")]
    NotFinite {
        /// The particle.
        id: u32,
        /// Simulated time, s.
        time: f64,
    },
    /// A step has failed before.
    #[error("a step after t = {time:.9} s has failed: what it has left cannot be gone on from")]
    Failed {
        /// Simulated time, s.
        time: f64,
    },
    /// A term could not settle.
    #[error("at t = {time:.9} s: {source}")]
    Term {
        /// Simulated time, s.
        time: f64,
        /// The term's own error.
        source: TermError,
    },
    /// A snapshot does not fit together.
    #[error("the snapshot holds {what}")]
    Snapshot {
        /// What is wrong with it.
        what: &'static str,
    },
    /// The snapshot's particles are not usable.
    #[error(transparent)]
    Particle(#[from] ParticleError),
    /// The threads could not be started.
    #[error("could not start {threads} threads: {reason}")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// What the system said, or how many are allowed.
        reason: String,
    },
}
