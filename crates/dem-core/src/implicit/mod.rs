//! Resistances that are solved for at the end of the step instead of being taken from its start.

mod close;
mod colours;
mod eight;
mod link;
mod loose;
mod met;
mod normal;
mod paths;
mod shear;
mod term;

use glam::Vec3;

use crate::chunk::List;
use crate::lane::Lane;

pub(crate) use colours::Colours;
use eight::Eight;
pub(crate) use eight::{EIGHT, Visit};
use loose::{Loose, More};
pub(crate) use met::{Inverse, Met, Remembered};
use paths::Paths;
pub use term::Implicit;

/// What resists the relative motion of a pair, or of several side by side, for [`Implicit`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Resist<L = f64> {
    /// Drag c_n along the line of centres at the gap asked for, N s/m.
    pub drag: L,
    /// The gap changes by much less than this, m, while c_n hardly does; 0 where that is not known.
    pub clearance: L,
    /// Dashpot γ of the contact, N s/m.
    pub dashpot: L,
    /// The strongest pull of the dashpot, N: a contact that pushes only has it pull at most as much
    /// as its spring pushes.
    pub pull: L,
    /// Drag across the line of centres, N s/m: slip A, coupling B, rolling D, with A D ≥ B².
    pub across: [L; 3],
    /// The largest torque of rolling friction, N m.
    pub rolling: L,
}

impl<L: Lane> Resist<L> {
    /// Nothing resists.
    #[must_use]
    #[inline(always)]
    pub fn none(permit: L::Permit) -> Self {
        let none = L::splat(permit, 0.0);
        Self {
            drag: none,
            clearance: none,
            dashpot: none,
            pull: none,
            across: [none; 3],
            rolling: none,
        }
    }

    /// Puts single ones side by side.
    #[inline(always)]
    pub fn pack(permit: L::Permit, each: &L::Each<Resist>) -> Self {
        Self {
            drag: L::pack(permit, each, |r| r.drag),
            clearance: L::pack(permit, each, |r| r.clearance),
            dashpot: L::pack(permit, each, |r| r.dashpot),
            pull: L::pack(permit, each, |r| r.pull),
            across: [
                L::pack(permit, each, |r| r.across[0]),
                L::pack(permit, each, |r| r.across[1]),
                L::pack(permit, each, |r| r.across[2]),
            ],
            rolling: L::pack(permit, each, |r| r.rolling),
        }
    }

    /// One bit for each pair in which anything resists, or something that is no number.
    #[inline(always)]
    pub(crate) fn any(&self) -> u32 {
        let [slip, coupling, rolling] = self.across;
        let all = self.drag + self.dashpot + self.rolling + slip + rolling;
        let all = all + coupling.most(-coupling);
        !all.less_bits(L::splat(all.permit(), f64::MIN_POSITIVE))
    }
}

impl<L: Lane> std::ops::Add for Resist<L> {
    type Output = Self;

    /// Both resist together. A clearance of the part without drag says nothing.
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let permit = self.drag.permit();
        let (zero, any) = (L::splat(permit, 0.0), L::splat(permit, f64::INFINITY));
        let mine = zero.if_less(self.drag, self.clearance, any);
        let others = zero.if_less(other.drag, other.clearance, any);
        let ([a, b, c], [d, e, f]) = (self.across, other.across);
        Self {
            drag: self.drag + other.drag,
            clearance: mine.least(others),
            dashpot: self.dashpot + other.dashpot,
            pull: self.pull + other.pull,
            across: [a + d, b + e, c + f],
            rolling: self.rolling + other.rolling,
        }
    }
}

/// What a pair remembers of the impulses that resisted its motion in the last step: how far the gap
/// has been paid for, and where the next step's search starts. Single precision is enough for that:
/// the search ends where it ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impulse {
    /// The gap up to which the drag has been charged, m; infinite before the first step.
    pub charged: f64,
    /// Along the line of centres, N s, positive when it drives the bodies apart.
    pub normal: f32,
    /// Across it, on the first body at the point of contact, N s.
    pub shear: Vec3,
    /// Of the rolling drag: a torque R* n × this on the first body, N s.
    pub couple: Vec3,
    /// Of rolling friction, on the first body, N m s.
    pub rolling: Vec3,
}

impl Impulse {
    /// Nothing yet.
    pub const NONE: Self = Self {
        charged: f64::INFINITY,
        normal: 0.0,
        shear: Vec3::ZERO,
        couple: Vec3::ZERO,
        rolling: Vec3::ZERO,
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

/// What the pairs of a list remember.
pub(crate) trait Memory {
    /// The drag's impulse up to a gap and the drag there.
    fn charge(&self, list: List, index: u32, gap: f64) -> [f64; 2];

    /// Where the impulses of a pair are kept.
    fn impulse(&mut self, list: List, index: u32) -> Option<&mut Impulse>;
}

/// The links of a list.
#[derive(Debug, Default)]
pub(crate) struct Links {
    /// Those behind what is taken are left over from an earlier step: to write all of them anew would
    /// take longer than to use them.
    all_eights: Vec<Eight>,
    all_paths: Vec<Paths>,
    /// How many places for links among eights are taken.
    taken: usize,
    pub(crate) loose: Vec<Loose>,
    more: Vec<More>,
    /// The sums that scale a start, of the links that lie side by side, lane by lane.
    start: [[f64; EIGHT]; 2],
    /// What the pass before the last was to change, of each group of eights, and of those by themselves.
    last: Vec<f64>,
    last_loose: f64,
    /// What the impulses are scaled by in the next pass.
    share: f64,
    /// Whether there are stiff ones among them.
    stiff: bool,
}

impl Links {
    pub(crate) fn clear(&mut self) {
        self.taken = 0;
        self.loose.clear();
        self.more.clear();
        self.start = [[0.0; EIGHT]; 2];
        self.stiff = false;
        self.last.clear();
        self.last_loose = f64::NAN;
    }

    /// Lets the impulses be scaled in the next pass.
    pub(crate) fn start_from(&mut self, share: f64) {
        self.share = share;
    }

    /// By how much the impulses are to be scaled in this pass.
    pub(crate) fn take_share(&mut self) -> f64 {
        std::mem::replace(&mut self.share, 1.0)
    }

    pub(crate) fn is_empty(&self) -> bool {
        let eights = &self.all_eights[..self.taken.div_ceil(EIGHT)];
        self.loose.is_empty() && eights.iter().all(|eight| eight.which == 0)
    }

    /// The sums that scale a start, of the links that lie side by side.
    pub(crate) fn start_eights(&self) -> [f64; 2] {
        self.start.map(|lanes| lanes.iter().sum())
    }
}
