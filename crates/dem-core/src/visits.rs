//! Pairs that a term is to settle.

use crate::Encounter;
use crate::pairs::{First, Part, Second};

/// The pairs that a term is to settle, each once, in the order of their keys.
///
/// Numbers of pairs are below [`Visits::count`]; others may panic.
pub trait Visits<C> {
    /// How many there are.
    fn count(&self) -> usize;

    /// Pair `k` as it was read.
    fn encounter(&self, k: usize) -> Encounter;

    /// Whether pair `k` ends after this visit: a body leaves the scene, or a wall part is taken away.
    fn ends(&self, k: usize) -> bool;

    /// The term's column of pair `k`, to be changed.
    fn column(&mut self, k: usize) -> &mut C;
}

impl<C> Visits<C> for Vec<Visit<C>> {
    fn count(&self) -> usize {
        self.len()
    }

    fn encounter(&self, k: usize) -> Encounter {
        self[k].encounter
    }

    fn ends(&self, k: usize) -> bool {
        self[k].ending
    }

    fn column(&mut self, k: usize) -> &mut C {
        &mut self[k].column
    }
}

/// The columns of one of two terms.
impl<A, B, V: Visits<(A, B)>> Visits<A> for Part<'_, V, First<B>> {
    fn count(&self) -> usize {
        self.whole.count()
    }

    fn encounter(&self, k: usize) -> Encounter {
        self.whole.encounter(k)
    }

    fn ends(&self, k: usize) -> bool {
        self.whole.ends(k)
    }

    fn column(&mut self, k: usize) -> &mut A {
        &mut self.whole.column(k).0
    }
}

/// The columns of the other of two terms.
impl<A, B, V: Visits<(A, B)>> Visits<B> for Part<'_, V, Second<A>> {
    fn count(&self) -> usize {
        self.whole.count()
    }

    fn encounter(&self, k: usize) -> Encounter {
        self.whole.encounter(k)
    }

    fn ends(&self, k: usize) -> bool {
        self.whole.ends(k)
    }

    fn column(&mut self, k: usize) -> &mut B {
        &mut self.whole.column(k).1
    }
}

/// A pair that asked for attention, or is about to end.
#[derive(Debug, Clone, Copy)]
pub struct Visit<C> {
    /// The pair as it was read.
    pub encounter: Encounter,
    /// The term's column of the pair.
    pub column: C,
    /// The pair ends after this visit: a body leaves the scene, or a wall part is taken away.
    pub ending: bool,
}
