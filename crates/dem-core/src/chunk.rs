//! A chunk: a fixed run of slots and everything that is computed for them.

use std::ops::Range;
use std::time::Duration;

use glam::DVec3;

use crate::implicit::{Colours, Links};
use crate::lists::PairList;
use crate::particles::Row;
use crate::view::View;
use crate::{Encounter, Touch, wall_pass};

/// Force and torque on one particle.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(crate) struct Sum {
    pub(crate) force: Row,
    pub(crate) torque: Row,
}

/// What rolling friction needs of one particle: in a read the braking torque and the number of
/// contacts; between reads the spin that the other torques gave in the last step.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Roll {
    pub(crate) spin: DVec3,
    pub(crate) contacts: f64,
}

/// One smooth piece of a wall part that a particle touches, and what the term remembers of it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Memory<C> {
    /// The touch at the last read: its normal tells which one this was, whatever triangle
    /// carried it.
    pub(crate) touch: Touch,
    pub(crate) column: C,
}

/// The touches of a particle with a wall part. Nearly always one: it lies in the list, so that no
/// step goes to look for it elsewhere.
pub(crate) type Memories<C> = smallvec::SmallVec<[Memory<C>; 1]>;

/// A particle near a wall part.
#[derive(Debug, Clone)]
pub(crate) struct WallPair<C> {
    pub(crate) slot: u32,
    pub(crate) part: u32,
    /// Where the candidates lie in the chunk's pool.
    pub(crate) candidates: Range<usize>,
    pub(crate) memories: Memories<C>,
}

/// Which list an entry stands in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum List {
    Inside,
    Across,
    /// No sphere touches tens of thousands of surfaces at once.
    Wall {
        memory: u16,
    },
}

/// Where a pair that wants attention stands. There are many at once when a wet scene starts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Note {
    pub(crate) list: List,
    pub(crate) index: u32,
}

/// A run of slots with its lists, its sums and its scratch space.
#[derive(Debug)]
pub(crate) struct Chunk<C> {
    pub(crate) range: Range<u32>,
    pub(crate) inside: PairList<C>,
    pub(crate) across: PairList<C>,
    pub(crate) walls: Vec<WallPair<C>>,
    pub(crate) pool: Vec<u32>,
    pub(crate) sums: Vec<Sum>,
    pub(crate) rolls: Vec<Roll>,
    pub(crate) notes: Vec<Note>,
    /// Scratch: the places of those pairs of a list that act and do not touch.
    pub(crate) apart: Vec<u32>,
    pub(crate) touches: Vec<Touch>,
    pub(crate) memories: Memories<C>,
    /// Pairs that resist, to be solved for: inside and with walls, and across the border where the
    /// first particle is the chunk's own. Empty unless the term is implicit.
    pub(crate) links: Links,
    pub(crate) links_across: Links,
    /// Scratch: which pairs of the chunk can be solved for at once.
    pub(crate) colours: Colours,
    /// What the impulses that the links inside remember do to the momenta of the chunk's particles;
    /// zero between steps. Empty unless the term is implicit.
    pub(crate) pushed: Vec<Sum>,
    /// Largest overlap over the smaller radius so far.
    pub(crate) overlap: f64,
    pub(crate) pair_time: Duration,
    pub(crate) wall_time: Duration,
}

impl<C: Copy + Default> Chunk<C> {
    pub(crate) fn new(range: Range<u32>, [rolls, implicit]: [bool; 2]) -> Self {
        let slots = range.len();
        Self {
            range,
            inside: PairList::default(),
            across: PairList::default(),
            walls: Vec::new(),
            pool: Vec::new(),
            sums: vec![Sum::default(); slots],
            rolls: vec![Roll::default(); if rolls { slots } else { 0 }],
            notes: Vec::new(),
            apart: Vec::new(),
            touches: Vec::new(),
            memories: Memories::new(),
            links: Links::default(),
            links_across: Links::default(),
            colours: Colours::default(),
            pushed: vec![Sum::default(); if implicit { slots } else { 0 }],
            overlap: 0.0,
            pair_time: Duration::ZERO,
            wall_time: Duration::ZERO,
        }
    }

    /// Forgets the last step; its sums are zero since they were used.
    pub(crate) fn clear(&mut self) {
        self.notes.clear();
        self.links.clear();
        self.links_across.clear();
    }

    /// Who meets in the pair that a note is about, as it was read.
    pub(crate) fn encounter(&self, view: &View<'_>, note: &Note) -> Encounter {
        let index = note.index as usize;
        match note.list {
            List::Inside => view.meet(self.inside.active[index]),
            List::Across => view.meet(self.across.active[index]),
            List::Wall { memory } => {
                let wall = &self.walls[index];
                let touch = &wall.memories[memory as usize].touch;
                Encounter { nearest: memory == 0, ..wall_pass::meeting(view, wall, touch) }
            }
        }
    }

    /// The column that a note is about.
    pub(crate) fn column(&mut self, list: List, index: u32) -> &mut C {
        let index = index as usize;
        match list {
            List::Inside => &mut self.inside.columns[index],
            List::Across => &mut self.across.columns[index],
            List::Wall { memory } => &mut self.walls[index].memories[memory as usize].column,
        }
    }
}
