use glam::DVec3;

use crate::build::{Fit, Prism, pieces};
use crate::{Frame, Part, Shape, WallError, Wire};

/// How the wires of a [`Sieve`] are made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wires {
    /// Exact cylinders: fastest and smooth.
    Cylinders,
    /// Prisms of triangles, one face of each pointing up.
    Prisms {
        /// Number of faces.
        sides: u32,
        /// How they stand for the round wire.
        fit: Fit,
    },
}

/// How the frame of a [`Sieve`] is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrameKind {
    /// An exact cylinder with elements around and along it.
    Cylinder {
        /// Number of elements around and along the frame.
        patches: [u32; 2],
    },
    /// A prism of flat faces whose edges lie on the circle, so that the wires reach it everywhere.
    Prism {
        /// Number of faces.
        sides: u32,
        /// Number of bands along the frame.
        bands: u32,
    },
}

/// A round sieve of straight crossed wires.
///
/// The axes of all wires lie in the plane z = 0, half of them along x and half along y; the wires
/// run through each other where they cross. An aperture has its centre at the origin. A wire ends
/// where the side of it that faces the middle meets the frame, so no opening at the rim is wider
/// than the aperture; beyond that the rest of its end sticks out of the frame.
///
/// ```
/// use pendular_walls::{FrameKind, Sieve, Walls, Wires};
/// let sieve = Sieve {
///     aperture: 8e-3,
///     wire_diameter: 2e-3,
///     frame_radius: 0.1,
///     frame_bottom: -0.01,
///     frame_top: 0.05,
///     wires: Wires::Cylinders,
///     frame: FrameKind::Cylinder { patches: [36, 6] },
///     element_length: 10e-3,
/// };
/// let walls = Walls::new(sieve.parts()?)?;
/// // 20 wires each way, 10 mm apart, and the frame.
/// assert_eq!(walls.parts().len(), 41);
/// # Ok::<(), pendular_walls::WallError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sieve {
    /// Clear width a between wires, m.
    pub aperture: f64,
    /// Wire diameter w, m; the wires are a + w apart.
    pub wire_diameter: f64,
    /// Inner radius of the frame, m.
    pub frame_radius: f64,
    /// Height of the frame's lower end above the wire axes, m; negative below them.
    pub frame_bottom: f64,
    /// Height of the frame's upper end, m.
    pub frame_top: f64,
    /// How the wires are made.
    pub wires: Wires,
    /// How the frame is made.
    pub frame: FrameKind,
    /// Greatest length of a wire's elements along it, m; infinite for one piece a wire.
    pub element_length: f64,
}

/// Most wires each way; more are taken for a wrong unit.
const MOST_WIRES: f64 = 10_000.0;

/// A wire that reaches into the frame by less than this part of its diameter is left out.
const LEAST_DEPTH: f64 = 1e-3;

impl Sieve {
    /// The parts, at rest, of material 0: the wires along x (`wire-x-0`, … by rising y), the wires
    /// along y (`wire-y-0`, … by rising x), `frame`. The half side of each wire is its radius.
    ///
    /// # Errors
    /// [`WallError::OutOfRange`] unless all lengths are positive and finite (the element length
    /// may be infinite), the frame radius lies between half a pitch and 5000 pitches, the frame's
    /// top is above its bottom, and prisms have at least 3 sides.
    pub fn parts(&self) -> Result<Vec<Part>, WallError> {
        self.check()?;
        let mut parts = Vec::new();
        for (name, along, across) in [("x", DVec3::X, DVec3::Y), ("y", DVec3::Y, DVec3::X)] {
            for (k, (offset, half_length)) in self.lines().into_iter().enumerate() {
                let middle = across * offset;
                let ends = [middle - along * half_length, middle + along * half_length];
                let shape = self.wire(ends)?;
                let part = Part::new(format!("wire-{name}-{k}"), shape);
                parts.push(part.with_half_side(0.5 * self.wire_diameter));
            }
        }
        parts.push(Part::new("frame", self.frame()?));
        Ok(parts)
    }

    fn check(&self) -> Result<(), WallError> {
        WallError::positive("sieve", "aperture", self.aperture)?;
        WallError::positive("sieve", "wire diameter", self.wire_diameter)?;
        let pitch = self.aperture + self.wire_diameter;
        let allowed = (0.5 * pitch, 0.5 * MOST_WIRES * pitch);
        WallError::within("sieve", "frame radius", self.frame_radius, allowed)?;
        let height = self.frame_top - self.frame_bottom;
        WallError::positive("sieve", "height of the frame", height)
    }

    /// Offset from the middle and half length of each wire of one direction, m.
    fn lines(&self) -> Vec<(f64, f64)> {
        let pitch = self.aperture + self.wire_diameter;
        let radius = self.frame_radius;
        let mut half = Vec::new();
        for k in 0.. {
            let offset = (f64::from(k) + 0.5) * pitch;
            let inner = (offset - 0.5 * self.wire_diameter).max(0.0);
            if radius - inner <= LEAST_DEPTH * self.wire_diameter {
                break;
            }
            half.push((offset, ((radius - inner) * (radius + inner)).sqrt()));
        }
        let mirrored = half.iter().rev().map(|(offset, length)| (-offset, *length));
        mirrored.chain(half.iter().copied()).collect()
    }

    fn wire(&self, ends: [DVec3; 2]) -> Result<Shape, WallError> {
        let segments = pieces("sieve", ends[0].distance(ends[1]), self.element_length)?;
        let radius = 0.5 * self.wire_diameter;
        Ok(match self.wires {
            Wires::Cylinders => Shape::Wire(Wire::new(ends[0], ends[1], radius, segments)?),
            Wires::Prisms { sides, fit } => {
                let up = DVec3::Z;
                let prism = Prism { ends, up, radius, sides, fit, segments, closed: true };
                Shape::Mesh(prism.mesh()?)
            }
        })
    }

    fn frame(&self) -> Result<Shape, WallError> {
        let ends = [DVec3::Z * self.frame_bottom, DVec3::Z * self.frame_top];
        let radius = self.frame_radius;
        Ok(match self.frame {
            FrameKind::Cylinder { patches } => {
                Shape::Frame(Frame::new(ends[0], ends[1], radius, patches)?)
            }
            FrameKind::Prism { sides, bands } => {
                let (up, fit, segments, closed) = (DVec3::X, Fit::Inscribed, bands, false);
                let prism = Prism { ends, up, radius, sides, fit, segments, closed };
                Shape::Mesh(prism.mesh()?)
            }
        })
    }
}
