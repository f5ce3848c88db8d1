use pendular_lubrication::{NormalCurve, NormalDrag, Resistance, TangentialCurve, TangentialDrag};
use pendular_pair::{Bridge, OutOfRange};
use pendular_transfer::{AnyRupture, Dynamic};

/// The liquid of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Liquid {
    /// Surface tension σ, N/m.
    pub surface_tension: f64,
    /// Viscosity η, Pa s.
    pub viscosity: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Contact angle on each particle material, rad.
    pub particle_angles: Vec<f64>,
    /// Contact angle on each wall material, rad.
    pub wall_angles: Vec<f64>,
}

/// The laws of the bridges of one kind of pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairLaws<C, N, S> {
    /// Capillary force.
    pub capillary: C,
    /// Viscous force along the line of centres.
    pub normal: N,
    /// Viscous force and torque across it.
    pub tangential: S,
    /// Static rupture distance.
    pub rupture: AnyRupture,
    /// What speed adds to the rupture distance.
    pub dynamic: Dynamic,
}

/// No viscous drag at all.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct NoDrag;

impl NormalDrag for NoDrag {
    type Curve = Self;

    fn curve(&self, _: &Bridge, _: f64) -> Result<Self, OutOfRange> {
        Ok(Self)
    }
}

impl NormalCurve for NoDrag {
    fn coefficient(&self, _: f64) -> f64 {
        0.0
    }

    fn impulse(&self, _: f64) -> f64 {
        0.0
    }
}

impl TangentialDrag for NoDrag {
    type Curve = Self;

    fn curve(&self, _: &Bridge, _: f64) -> Result<Self, OutOfRange> {
        Ok(Self)
    }
}

impl TangentialCurve for NoDrag {
    fn resistance(&self, _: f64) -> Resistance {
        Resistance::default()
    }
}
