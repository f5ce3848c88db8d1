use std::collections::HashMap;
use std::sync::{Arc, OnceLock, PoisonError, RwLock};

use pendular_pair::Bridge;

use super::folded::{Folded, OUTPUTS};
use super::grid::{bridge_of, volume_at, volume_place};

/// Nodes in ln V* of one pair's table.
const NODES: usize = 65;

/// Pairs that are remembered; one more and the memory starts afresh.
const REMEMBERED: usize = 512;

/// A change of the share from one node to the next that betrays the neck's jump.
const JUMP: f64 = 0.05;

/// The angles of the smaller and the larger body (rad) and r_small/r_large, 0 for a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pair {
    pub(super) angles: [f64; 2],
    pub(super) ratio: f64,
}

type Key = [u64; 3];

/// Folded bridges of one pair over ln V*, each solved when it is first wanted.
#[derive(Debug)]
struct PairTable {
    pair: Pair,
    nodes: [OnceLock<Option<[f64; OUTPUTS]>>; NODES],
}

impl Pair {
    fn key(&self) -> Key {
        [self.angles[0], self.angles[1], self.ratio].map(f64::to_bits)
    }

    fn bridge(&self, v_star: f64) -> Option<Bridge> {
        bridge_of(v_star, self.angles, self.ratio)
    }

    /// The folded bridge of this pair at V*; the share is the smaller body's.
    ///
    /// The value depends on the pair and V* alone, not on what was asked before.
    pub(super) fn look_up(&self, v_star: f64) -> Option<Folded> {
        let table = self.table();
        let exact = || Folded::exact(&self.bridge(v_star)?).ok();
        table.interpolate(volume_place(v_star)).or_else(exact)
    }

    /// This pair's table, shared by all threads.
    fn table(&self) -> Arc<PairTable> {
        static MEMORY: OnceLock<RwLock<HashMap<Key, Arc<PairTable>>>> = OnceLock::new();
        let memory = MEMORY.get_or_init(RwLock::default);
        let key = self.key();
        let known = memory.read().unwrap_or_else(PoisonError::into_inner).get(&key).cloned();
        known.unwrap_or_else(|| {
            let mut memory = memory.write().unwrap_or_else(PoisonError::into_inner);
            if memory.len() >= REMEMBERED {
                memory.clear();
            }
            let fresh = || PairTable { pair: *self, nodes: [const { OnceLock::new() }; NODES] };
            memory.entry(key).or_insert_with(|| Arc::new(fresh())).clone()
        })
    }
}

impl PairTable {
    fn node(&self, k: usize) -> Option<&[f64; OUTPUTS]> {
        let solve = || {
            let v_star = volume_at(k as f64 / (NODES - 1) as f64);
            Some(Folded::exact(&self.pair.bridge(v_star)?).ok()?.to_array())
        };
        self.nodes[k].get_or_init(solve).as_ref()
    }

    /// Whether the neck jumps between a node and the next, or is not known there.
    fn jumps(&self, k: usize) -> bool {
        let share = |k: usize| self.node(k).map(|node| node[OUTPUTS - 1]);
        match (share(k), share(k + 1)) {
            (Some(here), Some(there)) => (there - here).abs() > JUMP,
            _ => true,
        }
    }

    /// Cubic interpolation through four nodes around the place that lie on one side of a jump of
    /// the neck; `None` where there are no such four.
    fn interpolate(&self, place: f64) -> Option<Folded> {
        let x = place.clamp(0.0, 1.0) * (NODES - 1) as f64;
        let below = (x as usize).min(NODES - 2);
        let last = NODES - 4;
        let smooth = |first: &usize| !(*first..*first + 3).any(|k| self.jumps(k));
        let middle = below.saturating_sub(1).min(last);
        let first = if smooth(&middle) {
            middle
        } else if self.jumps(below) {
            return None;
        } else {
            let sides = [below.min(last), below.saturating_sub(2).min(last)];
            sides.into_iter().find(smooth)?
        };
        let mut sum = [0.0; OUTPUTS];
        for (k, weight) in weights(x - first as f64).into_iter().enumerate() {
            for (entry, value) in sum.iter_mut().zip(self.node(first + k)?) {
                *entry += weight * value;
            }
        }
        Some(Folded::from_array(sum))
    }
}

/// Lagrange weights of the nodes 0, 1, 2, 3 at `x`.
fn weights(x: f64) -> [f64; 4] {
    let [a, b, c, d] = [x, x - 1.0, x - 2.0, x - 3.0];
    [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lagrange_weights_carry_a_cubic() {
        let f = |x: f64| 1.0 + x * (2.0 - x * (0.5 - 0.3 * x));
        for x in [0.0, 0.4, 1.5, 3.0] {
            let sum: f64 = weights(x).iter().enumerate().map(|(k, w)| w * f(k as f64)).sum();
            assert!((sum - f(x)).abs() < 1e-14);
        }
    }

    #[test]
    fn the_value_does_not_depend_on_what_was_asked_before() {
        let pair = Pair { angles: [0.2, 0.7], ratio: 0.31 };
        let first = pair.look_up(3e-3);
        for k in 0..20 {
            pair.look_up(volume_at(f64::from(k) / 19.0));
        }
        assert_eq!(pair.look_up(3e-3), first);
        let fresh = PairTable { pair, nodes: [const { OnceLock::new() }; NODES] };
        assert_eq!(fresh.interpolate(volume_place(3e-3)), first);
    }
}
