//! Who overlaps most.

use super::Simulation;
use crate::{Boundary, Encounter, PairTerm, wall_pass};

impl<T: PairTerm, B: Boundary> Simulation<T, B> {
    /// The deepest overlap at this moment, as a share of the smaller radius, and who it is between;
    /// walls as at the last step. `None` where nothing touches. Looks at every pair: for messages,
    /// not for every step; [`Simulation::largest_overlap`] costs nothing.
    #[must_use]
    pub fn deepest(&self) -> Option<(f64, Encounter)> {
        let view = self.view();
        let mut deepest: Option<(f64, Encounter)> = None;
        let mut look = |encounter: Encounter, radius: f64| {
            let share = -encounter.gap / radius;
            if share > deepest.map_or(0.0, |(most, _)| most) {
                deepest = Some((share, encounter));
            }
        };
        for chunk in &self.chunks {
            for &entry in chunk.inside.active.iter().chain(&chunk.across.active) {
                let [a, b] = entry.map(|slot| view.places[slot as usize].r);
                look(view.meet(entry), a.min(b));
            }
            for wall in &chunk.walls {
                let radius = view.places[wall.slot as usize].r;
                for memory in &wall.memories {
                    look(wall_pass::meeting(&view, wall, &memory.touch), radius);
                }
            }
        }
        deepest
    }
}
