//! Which pairs can be solved for at once.

use std::ops::Range;

use super::EIGHT;
use crate::lists::Entry;

/// Pairs that are coloured at a time: few enough for their bodies to stay near.
const WINDOW: usize = 512;
/// How many colours there are.
const COLOURS: usize = 64;

/// A greedy colouring of pairs: those of one colour have no body in common.
#[derive(Debug, Default)]
pub(crate) struct Colours {
    /// The colours that are taken at each slot of the chunk, one bit each.
    taken: Vec<u64>,
    colour: Vec<u8>,
    sorted: Vec<u32>,
}

impl Colours {
    /// How many pairs are worth sorting at a time.
    pub(crate) const WINDOW: usize = WINDOW;

    /// Sorts `acting`, places in a list of pairs inside `range`, so that of its first pairs every
    /// eight have no body in common; returns how many those are. The others come last.
    pub(crate) fn sort(
        &mut self,
        active: &[Entry],
        acting: &mut [u32],
        range: &Range<u32>,
    ) -> usize {
        let Self { taken, colour, sorted } = self;
        taken.clear();
        taken.resize(range.len(), 0);
        let bodies = |at: u32| active[at as usize].map(|slot| (slot - range.start) as usize);
        // The last count is of those for which no colour is left.
        let mut counts = [0_usize; COLOURS + 1];
        colour.clear();
        for &at in &*acting {
            let [a, b] = bodies(at);
            let free = (!(taken[a] | taken[b])).trailing_zeros();
            let bit = 1_u64.checked_shl(free).unwrap_or(0);
            taken[a] |= bit;
            taken[b] |= bit;
            counts[free as usize] += 1;
            colour.push(free as u8);
        }
        // Whole eights of every colour first, then what is left of it.
        let whole = |count: usize| count / EIGHT * EIGHT;
        let eights: usize = counts[..COLOURS].iter().map(|&count| whole(count)).sum();
        let mut places = [[0_usize; 2]; COLOURS + 1];
        let (mut next, mut rest) = (0, eights);
        for (place, &count) in places.iter_mut().zip(&counts[..COLOURS]) {
            *place = [next, rest];
            next += whole(count);
            rest += count - whole(count);
        }
        places[COLOURS] = [next, rest];
        counts[COLOURS] = 0;
        sorted.clear();
        sorted.resize(acting.len(), 0);
        let mut left = counts.map(whole);
        for (&at, &colour) in acting.iter().zip(&*colour) {
            let colour = usize::from(colour);
            let which = usize::from(left[colour] == 0);
            left[colour] = left[colour].saturating_sub(1);
            let place = &mut places[colour][which];
            sorted[*place] = at;
            *place += 1;
        }
        acting.copy_from_slice(sorted);
        eights
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every pair of the corners of a grid of 4 x 4 x 8, and a hub that meets 100 others.
    fn pairs() -> Vec<Entry> {
        let slot = |x: u32, y: u32, z: u32| 10 + x + 4 * (y + 4 * z);
        let mut pairs = Vec::new();
        for (x, y, z) in (0..8).flat_map(|z| (0..16).map(move |k| (k % 4, k / 4, z))) {
            let others = [(x + 1, y, z), (x, y + 1, z), (x, y, z + 1), (x + 1, y + 1, z)];
            let inside = |(x, y, z): &(u32, u32, u32)| *x < 4 && *y < 4 && *z < 8;
            let new =
                others.into_iter().filter(inside).map(|(p, q, r)| [slot(x, y, z), slot(p, q, r)]);
            pairs.extend(new);
        }
        pairs.extend((0..100).map(|k| [k + 10, 150]));
        pairs
    }

    #[test]
    fn eights_have_no_body_in_common_and_no_pair_is_lost() {
        let active = pairs();
        let mut acting: Vec<u32> = (0..active.len() as u32).collect();
        let mut colours = Colours::default();
        let eights = colours.sort(&active, &mut acting, &(10..151));
        assert!(eights % EIGHT == 0 && eights > active.len() / 2, "{eights} of {}", active.len());
        for eight in acting[..eights].chunks(EIGHT) {
            let mut bodies: Vec<u32> = eight.iter().flat_map(|&at| active[at as usize]).collect();
            bodies.sort_unstable();
            bodies.dedup();
            assert_eq!(bodies.len(), 2 * EIGHT);
        }
        let mut all = acting.clone();
        all.sort_unstable();
        assert!(all.into_iter().eq(0..active.len() as u32));
        let mut again = acting.clone();
        assert_eq!(colours.sort(&active, &mut again, &(10..151)), eights, "nothing is left behind");
    }
}
