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
    check_lists(bodies, films.len())?;
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

/// What names something must name what is there: nothing is looked up in vain later.
fn check_lists(bodies: &Bodies, particles: usize) -> Result<(), OutOfRange> {
    let (classes, parts) = (bodies.radii.len(), bodies.half_sides.len());
    let lengths = [
        ("number of particles with a class", bodies.class.len(), particles),
        ("number of materials of classes", bodies.materials.len(), classes),
        ("number of materials of wall parts", bodies.wall_materials.len(), parts),
        ("number of first elements of wall parts", bodies.first_elements.len(), parts),
    ];
    for (quantity, found, asked) in lengths {
        OutOfRange::within(quantity, found as f64, (asked as f64, asked as f64))?;
    }
    let last = classes as f64 - 1.0;
    for &class in &bodies.class {
        OutOfRange::within("class of a particle", class.into(), (0.0, last))?;
    }
    let all = bodies.elements.len() as f64;
    for &first in &bodies.first_elements {
        OutOfRange::within("first element of a wall part", first.into(), (0.0, all))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_that_do_not_fit_each_other_are_named() {
        let liquid = Liquid {
            surface_tension: 0.07,
            viscosity: 1e-3,
            density: 1e3,
            particle_angles: vec![0.1],
            wall_angles: vec![0.1],
        };
        let good = Bodies {
            class: vec![0, 0],
            radii: vec![1e-3],
            materials: vec![0],
            half_sides: vec![f64::INFINITY],
            wall_materials: vec![0],
            first_elements: vec![0],
            elements: vec![WallElement { area: 1e-4 }],
        };
        let films = [1e-12; 2];
        assert_eq!(check(&liquid, &good, &films), Ok(()));
        type Spoil = fn(&mut Bodies);
        let cases: [(Spoil, &str); 6] = [
            (|b| b.class = vec![0], "particles with a class"),
            (|b| b.class = vec![0, 1], "class of a particle"),
            (|b| b.materials.clear(), "materials of classes"),
            (|b| b.wall_materials.clear(), "materials of wall parts"),
            (|b| b.first_elements.clear(), "first elements"),
            (|b| b.first_elements = vec![2], "first element"),
        ];
        for (spoil, word) in cases {
            let mut bodies = good.clone();
            spoil(&mut bodies);
            let said = check(&liquid, &bodies, &films).unwrap_err().to_string();
            assert!(said.contains(word), "{said}");
        }
    }
}
