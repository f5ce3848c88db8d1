//! Resistances that are solved for at the end of the step instead of being taken from its start.

mod link;
mod normal;
mod shear;
mod term;

use glam::DVec3;

pub(crate) use link::{Body, Change, Inverse, Kept, Links, Met, Two};
pub use term::Implicit;

/// What resists the relative motion of a pair, for [`Implicit`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Resist {
    /// Drag c_n along the line of centres at the gap asked for, N s/m.
    pub drag: f64,
    /// The gap changes by much less than this, m, while c_n hardly does; 0 where that is not known.
    pub clearance: f64,
    /// Dashpot γ of the contact, N s/m.
    pub dashpot: f64,
    /// The strongest pull of the dashpot, N: a contact that pushes only has it pull at most as much
    /// as its spring pushes.
    pub pull: f64,
    /// Drag across the line of centres, N s/m: slip A, coupling B, rolling D, with A D ≥ B².
    pub across: [f64; 3],
    /// The largest torque of rolling friction, N m.
    pub rolling: f64,
}

impl Resist {
    /// Whether anything resists.
    pub(crate) fn any(&self) -> bool {
        self.drag > 0.0 || self.dashpot > 0.0 || self.across != [0.0; 3] || self.rolling > 0.0
    }
}

impl std::ops::Add for Resist {
    type Output = Self;

    /// Both resist together. A clearance of the part without drag says nothing.
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let clearance = match (self.drag > 0.0, other.drag > 0.0) {
            (true, false) => self.clearance,
            (false, true) => other.clearance,
            _ => self.clearance.min(other.clearance),
        };
        Self {
            drag: self.drag + other.drag,
            clearance,
            dashpot: self.dashpot + other.dashpot,
            pull: self.pull + other.pull,
            across: std::array::from_fn(|k| self.across[k] + other.across[k]),
            rolling: self.rolling + other.rolling,
        }
    }
}

/// What a pair remembers of the impulses that resisted its motion in the last step: where the next
/// step's search for them starts, and how far the gap has been paid for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impulse {
    /// The gap up to which the drag has been charged, m; infinite before the first step.
    pub charged: f64,
    /// Along the line of centres, N s, positive when it drives the bodies apart.
    pub normal: f64,
    /// Across it, on the first body at the point of contact, N s.
    pub shear: DVec3,
    /// Of the rolling drag: a torque R* n × this on the first body, N s.
    pub couple: DVec3,
    /// Of rolling friction, on the first body, N m s.
    pub rolling: DVec3,
}

impl Impulse {
    /// Nothing yet.
    pub const NONE: Self = Self {
        charged: f64::INFINITY,
        normal: 0.0,
        shear: DVec3::ZERO,
        couple: DVec3::ZERO,
        rolling: DVec3::ZERO,
    };
}

impl Default for Impulse {
    fn default() -> Self {
        Self::NONE
    }
}

/// How hard the implicit resistances were to find.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Passes {
    /// Steps that had any resistance.
    pub steps: u64,
    /// Passes over all pairs in them.
    pub passes: u64,
    /// Steps that stopped at the largest number of passes.
    pub at_most: u64,
}
