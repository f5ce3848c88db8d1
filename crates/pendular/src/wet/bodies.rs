//! The bodies of a scene as the liquid sees them, and what can be wrong with them.

use pendular_dem_core::Partner;
use pendular_pair::OutOfRange;
use pendular_transfer::TransferError;

use crate::Liquid;

/// Why the liquid term could not go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WetError {
    /// A law does not take the bridge that has formed.
    #[error("bridge of {volume:.3e} m^3 between particle {first} and {second:?}: {source}")]
    Law {
        /// The first body.
        first: u32,
        /// The second body.
        second: Partner,
        /// The bridge's volume, m³.
        volume: f64,
        /// What the law said.
        source: OutOfRange,
    },
    /// No transfer ratio is known for the bridge that has formed.
    #[error("bridge of {volume:.3e} m^3 between particle {first} and {second:?}: {source}")]
    Transfer {
        /// The first body.
        first: u32,
        /// The second body.
        second: Partner,
        /// The bridge's volume, m³.
        volume: f64,
        /// What the split said.
        source: TransferError,
    },
    /// A parameter of the liquid is not usable.
    #[error(transparent)]
    Parameter(#[from] OutOfRange),
    /// A material has no contact angle.
    #[error("no contact angle for {what} material {material}: {known} are given")]
    NoAngle {
        /// `particle` or `wall`.
        what: &'static str,
        /// The material's index.
        material: usize,
        /// How many angles are given.
        known: usize,
    },
}

/// A wall element as the liquid sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallElement {
    /// Area over which its film lies, m².
    pub area: f64,
}

/// The bodies of a scene as the liquid sees them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Bodies {
    /// Class of each particle, by id.
    pub class: Vec<u16>,
    /// Radius of each class, m.
    pub radii: Vec<f64>,
    /// Material of each class.
    pub materials: Vec<u8>,
    /// Half side of each wall part, m; infinite for a large wall.
    pub half_sides: Vec<f64>,
    /// Material of each wall part.
    pub wall_materials: Vec<u8>,
    /// First element of each wall part in `elements`.
    pub first_elements: Vec<u32>,
    /// Elements of all wall parts.
    pub elements: Vec<WallElement>,
}

/// How many bridges there were.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Bridges formed.
    pub formed: u64,
    /// Bridges ruptured, those of bodies that left included.
    pub ruptured: u64,
    /// Bridges formed outside the validity range of their capillary or rupture law, or of the
    /// table of transfer ratios.
    pub extrapolated: u64,
}

/// A film's error as one of its parameters.
pub(super) fn parameter(error: TransferError) -> OutOfRange {
    match error {
        TransferError::OutOfRange(source) => source,
        // A film has no other way to be wrong.
        _ => OutOfRange { quantity: "film", value: f64::NAN, allowed: (0.0, f64::INFINITY) },
    }
}

/// Checks liquid, bodies and films once, where they enter.
pub(super) fn check(liquid: &Liquid, bodies: &Bodies, films: &[f64]) -> Result<(), WetError> {
    OutOfRange::positive("surface tension", liquid.surface_tension)?;
    OutOfRange::positive("viscosity", liquid.viscosity)?;
    OutOfRange::positive("liquid density", liquid.density)?;
    for &volume in films {
        OutOfRange::within("film volume", volume, (0.0, f64::MAX))?;
    }
    for element in &bodies.elements {
        OutOfRange::positive("area of a wall element", element.area)?;
    }
    let angles = [
        ("particle", &bodies.materials, &liquid.particle_angles),
        ("wall", &bodies.wall_materials, &liquid.wall_angles),
    ];
    for (what, materials, angles) in angles {
        for material in materials.iter().map(|&m| usize::from(m)) {
            let known = angles.len();
            let angle = *angles.get(material).ok_or(WetError::NoAngle { what, material, known })?;
            let allowed = (0.0, std::f64::consts::PI);
            if !(angle >= allowed.0 && angle < allowed.1) {
                let quantity = "contact angle";
                return Err(OutOfRange { quantity, value: angle, allowed }.into());
            }
        }
    }
    Ok(())
}
