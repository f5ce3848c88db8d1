//! Pairs that want attention: the term settles them where they stand.

use std::time::Instant;

use super::Simulation;
use crate::chunk::{Chunk, List, Note};
use crate::view::View;
use crate::visits::Visits;
use crate::{Boundary, Encounter, PairTerm, Partner, SimulationError};

/// Where a pair stands: a chunk, and the place in one of its lists.
type Standing = (u32, Note);

impl<T: PairTerm, B: Boundary> Simulation<T, B> {
    /// Lets the term settle the pairs that want attention, in the order of their keys. Where a pair
    /// crosses a border its other copy gets the same column.
    pub(super) fn settle(&mut self) -> Result<(), SimulationError> {
        if self.chunks.iter().all(|chunk| chunk.notes.is_empty()) {
            return Ok(());
        }
        let start = Instant::now();
        let Due { pairs, copies } = self.due();
        self.lists.visited += pairs.len();
        let time = self.time();
        let view = View::new(&self.particles, &self.rolls, &self.inverse, self.times());
        let chunks = &mut self.chunks[..];
        let settled = self.term.settle(&mut InPlace { view, chunks, pairs: &pairs });
        settled.map_err(|source| SimulationError::Term { time, source })?;
        for (k, (number, note)) in copies {
            let (owner, own) = &pairs[k as usize];
            let column = *self.chunks[*owner as usize].column(own.list, own.index);
            *self.chunks[number as usize].column(note.list, note.index) = column;
        }
        if T::IMPLICIT {
            self.meet_settled(&pairs);
        }
        self.profile.settling += start.elapsed();
        Ok(())
    }

    /// All pairs that want attention in the order of their keys.
    fn due(&mut self) -> Due {
        let mut all = Vec::with_capacity(self.chunks.iter().map(|chunk| chunk.notes.len()).sum());
        for number in 0..self.chunks.len() {
            // They are many only when a wet scene starts: nothing is kept for as many again.
            let notes = std::mem::take(&mut self.chunks[number].notes);
            let (chunk, view) = (&self.chunks[number], self.view());
            all.extend(notes.into_iter().map(|note| {
                let Encounter { first, second, .. } = chunk.encounter(&view, &note);
                ((first, second), number as u32, note)
            }));
        }
        all.sort_unstable_by_key(|(bodies, chunk, note)| (*bodies, *chunk, note.list, note.index));
        let mut due = Due { pairs: Vec::with_capacity(all.len()), copies: Vec::new() };
        let mut last: Option<(u32, Partner)> = None;
        for (bodies, chunk, note) in all {
            let this = (chunk, note);
            let count = due.pairs.len() as u32;
            match due.pairs.last_mut() {
                // A particle may touch a wall part several times; between particles it is a copy.
                Some(other) if last == Some(bodies) && note.list == List::Across => {
                    let copy = if self.owns(&this) { std::mem::replace(other, this) } else { this };
                    due.copies.push((count - 1, copy));
                }
                _ => due.pairs.push(this),
            }
            last = Some(bodies);
        }
        due
    }

    /// Whether this is the copy of a pair that counts: the one of its first particle's chunk.
    fn owns(&self, (chunk, note): &Standing) -> bool {
        let chunk = &self.chunks[*chunk as usize];
        let first = || chunk.across.active[note.index as usize][0];
        note.list != List::Across || chunk.range.contains(&first())
    }
}

/// Pairs that want attention, and by their number among them the copies of some.
struct Due {
    pairs: Vec<Standing>,
    copies: Vec<(u32, Standing)>,
}

/// Pairs as they stand in the lists of the chunks.
struct InPlace<'a, C> {
    view: View<'a>,
    chunks: &'a mut [Chunk<C>],
    pairs: &'a [Standing],
}

impl<C: Copy + Default> Visits<C> for InPlace<'_, C> {
    fn count(&self) -> usize {
        self.pairs.len()
    }

    fn encounter(&self, k: usize) -> Encounter {
        let (chunk, note) = &self.pairs[k];
        self.chunks[*chunk as usize].encounter(&self.view, note)
    }

    fn ends(&self, _: usize) -> bool {
        false
    }

    fn column(&mut self, k: usize) -> &mut C {
        let (chunk, note) = self.pairs[k];
        self.chunks[chunk as usize].column(note.list, note.index)
    }
}
