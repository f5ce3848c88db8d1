//! The pair lists that a chunk owns.

use std::ops::Range;

use crate::grid::Grids;
use crate::particles::{Particles, Place};

/// Two slots; the particle with the lower id comes first, in whatever list the pair stands.
pub(crate) type Entry = [u32; 2];

/// Pairs on two levels: `outer` within the skin, and of them `active` so near that they may act
/// before the next pruning. History lives beside `active`.
#[derive(Debug)]
pub(crate) struct PairList<C> {
    pub(crate) outer: Vec<Entry>,
    pub(crate) active: Vec<Entry>,
    pub(crate) columns: Vec<C>,
}

impl<C> Default for PairList<C> {
    fn default() -> Self {
        Self { outer: Vec::new(), active: Vec::new(), columns: Vec::new() }
    }
}

/// What orders a list, and so the sums: the chunk's own slot, then the other; inside a chunk the
/// lower slot first.
#[inline]
pub(crate) fn key(entry: Entry, range: &Range<u32>) -> u64 {
    let [a, b] = entry;
    let (mine, other) = match (range.contains(&a), range.contains(&b)) {
        (true, true) => (a.min(b), a.max(b)),
        (true, false) => (a, b),
        (false, _) => (b, a),
    };
    u64::from(mine) << 32 | u64::from(other)
}

/// Whether the two particles of an entry have a gap of at most `reach` m.
#[inline]
fn within(places: &[Place], [a, b]: Entry, reach: f64) -> bool {
    let (p, q) = (&places[a as usize], &places[b as usize]);
    let sum = p.r + q.r + reach;
    (q.x - p.x).length_squared() <= sum * sum
}

impl<C: Copy + Default> PairList<C> {
    /// Renews `active`: outer pairs with a gap of at most `reach`, and all live ones.
    pub(crate) fn prune(
        &mut self,
        places: &[Place],
        range: &Range<u32>,
        reach: f64,
        live: impl Fn(&C) -> bool,
    ) {
        let about = self.active.len() + self.active.len() / 16;
        let (mut active, mut columns) = (Vec::with_capacity(about), Vec::with_capacity(about));
        let old = self.active.iter().copied().zip(self.columns.iter().copied());
        let mut carried = old.peekable();
        let mut next = carried.peek().map(|(entry, _)| key(*entry, range));
        for &entry in &self.outer {
            let mut column = None;
            if next.is_some() {
                let at = key(entry, range);
                while next.is_some_and(|next| next <= at) {
                    let Some((earlier, c)) = carried.next() else { break };
                    next = carried.peek().map(|(entry, _)| key(*entry, range));
                    if earlier == entry {
                        column = Some(c);
                    } else if live(&c) {
                        active.push(earlier);
                        columns.push(c);
                    }
                }
            }
            if column.as_ref().is_some_and(&live) || within(places, entry, reach) {
                active.push(entry);
                columns.push(column.unwrap_or_default());
            }
        }
        for (entry, c) in carried.filter(|(_, c)| live(c)) {
            active.push(entry);
            columns.push(c);
        }
        refill(&mut self.active, active);
        refill(&mut self.columns, columns);
    }
}

/// Puts the new items into the memory of the old ones where they fit: lists that always move leave
/// holes between them.
fn refill<T: Copy>(list: &mut Vec<T>, mut new: Vec<T>) {
    if list.capacity() < new.len() {
        new.shrink_to(new.len() + new.len() / 32);
        *list = new;
    } else {
        list.clear();
        list.extend_from_slice(&new);
    }
}

/// Finds the outer pairs of the slots in `range`: those inside it once, those across its border.
pub(crate) fn find<C>(
    particles: &Particles,
    grids: &Grids,
    range: &Range<u32>,
    reach: f64,
    inside: &mut PairList<C>,
    across: &mut PairList<C>,
) {
    for list in [&mut *inside, &mut *across] {
        // About as many as before.
        let before = list.outer.len();
        list.outer.clear();
        list.outer.reserve_exact(before + before / 16);
    }
    let (places, id) = (&particles.places, &particles.id);
    let mut near: Vec<u32> = Vec::with_capacity(64);
    for i in range.clone() {
        near.clear();
        grids.around(&places[i as usize], |j| {
            let ours = range.contains(&j);
            if ours && j <= i {
                return;
            }
            if within(places, [i, j], reach) {
                near.push(j);
            }
        });
        near.sort_unstable();
        for &j in &near {
            let entry = if id[i as usize] < id[j as usize] { [i, j] } else { [j, i] };
            let list = if range.contains(&j) { &mut inside.outer } else { &mut across.outer };
            list.push(entry);
        }
    }
    inside.outer.shrink_to_fit();
    across.outer.shrink_to_fit();
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn row(n: u32) -> Vec<Place> {
        (0..n).map(|i| Place { x: DVec3::new(f64::from(i) * 2.5, 0.0, 0.0), r: 1.0 }).collect()
    }

    #[test]
    fn pruning_keeps_near_and_live_pairs_in_order() {
        let places = row(6);
        let mut list = PairList {
            outer: vec![[0, 1], [1, 2], [4, 5]],
            active: vec![[0, 1], [0, 3], [1, 2], [2, 5]],
            columns: vec![1, 7, 0, 0],
        };
        list.prune(&places, &(0..6), 0.4, |&c| c != 0);
        // No pair is within 0.4: only the live ones stay, also the one that is in no outer list.
        assert_eq!((list.active.clone(), list.columns.clone()), (vec![[0, 1], [0, 3]], vec![1, 7]));
        list.prune(&places, &(0..6), 0.6, |&c| c != 0);
        assert_eq!(list.active, vec![[0, 1], [0, 3], [1, 2], [4, 5]]);
        assert_eq!(list.columns, vec![1, 7, 0, 0]);
    }
}
