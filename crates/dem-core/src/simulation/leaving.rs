//! What ends: particles outside the domain, wall parts that are taken away.

use glam::DVec3;

use super::{Departure, Simulation};
use crate::chunk::WallPair;
use crate::particles::Place;
use crate::{Boundary, PairTerm, SimulationError, Visit, wall_pass};

impl<T: PairTerm, B: Boundary> Simulation<T, B> {
    /// Refuses bodies that overlap too much.
    pub(super) fn check_overlaps(&mut self) -> Result<(), SimulationError> {
        self.refresh();
        let share = self.settings.start_overlap;
        let view = self.view();
        let fail = |encounter: crate::Encounter, allowed: f64| {
            let (first, second, overlap) = (encounter.first, encounter.second, -encounter.gap);
            Err(SimulationError::StartOverlap { first, second, overlap, allowed })
        };
        for chunk in &self.chunks {
            for &entry in chunk.inside.active.iter().chain(&chunk.across.active) {
                let encounter = view.meet(entry);
                let [a, b] = entry.map(|slot| view.places[slot as usize].r);
                if -encounter.gap > share * a.min(b) {
                    return fail(encounter, share * a.min(b));
                }
            }
            let mut touches = Vec::new();
            for wall in &chunk.walls {
                let Place { x, r } = view.places[wall.slot as usize];
                let near = &chunk.pool[wall.candidates.clone()];
                self.boundary.touches(wall.part, near, x, r, 0.0, &mut touches);
                let deepest = touches.first().filter(|t| -t.gap > share * r);
                if let Some(touch) = deepest {
                    return fail(wall_pass::meeting(&view, wall, touch), share * r);
                }
            }
        }
        Ok(())
    }

    /// Lets go of particles outside the domain and of walls that are no longer there, after a last
    /// visit of the term to every pair that ends with them.
    pub(super) fn leave(&mut self) -> Result<(), SimulationError> {
        let outside = |x: DVec3| {
            self.settings
                .domain
                .is_some_and(|(low, high)| !(x.cmpge(low).all() && x.cmple(high).all()))
        };
        let places = self.particles.places.iter().enumerate();
        let leaving: Vec<u32> =
            places.filter(|(_, p)| outside(p.x)).map(|(slot, _)| slot as u32).collect();
        self.end_pairs(&leaving)?;
        if leaving.is_empty() {
            return Ok(());
        }
        let time = self.time();
        let mut gone: Vec<_> = leaving
            .iter()
            .map(|&slot| Departure { particle: self.particles.particle(slot as usize), time })
            .collect();
        gone.sort_by_key(|d| d.particle.id);
        self.departures.extend(gone);
        self.sort(&leaving);
        Ok(())
    }

    fn end_pairs(&mut self, leaving: &[u32]) -> Result<(), SimulationError> {
        let goes = |slot: u32| leaving.binary_search(&slot).is_ok();
        let (term, boundary) = (&self.term, &self.boundary);
        let view = self.view();
        let stays = |wall: &WallPair<T::Column>| !goes(wall.slot) && boundary.is_present(wall.part);
        let mut visits: Vec<Visit<T::Column>> = Vec::new();
        for chunk in &self.chunks {
            if !leaving.is_empty() {
                for (list, across) in [(&chunk.inside, false), (&chunk.across, true)] {
                    for (&entry, column) in list.active.iter().zip(&list.columns) {
                        let ends = goes(entry[0]) || goes(entry[1]);
                        let ours = !across || chunk.range.contains(&entry[0]);
                        if ends && ours && term.live(column) {
                            let encounter = view.meet(entry);
                            visits.push(Visit { encounter, column: *column, ending: true });
                        }
                    }
                }
            }
            for wall in &chunk.walls {
                if wall.memories.is_empty() || stays(wall) {
                    continue;
                }
                let live = wall.memories.iter().filter(|m| term.live(&m.column));
                visits.extend(live.map(|m| Visit {
                    encounter: wall_pass::meeting(&view, wall, &m.touch),
                    column: m.column,
                    ending: true,
                }));
            }
        }
        for chunk in &mut self.chunks {
            chunk.walls.retain(&stays);
        }
        if visits.is_empty() {
            return Ok(());
        }
        visits.sort_by_key(|v| (v.encounter.first, v.encounter.second));
        let time = self.time();
        let settled = self.term.settle(&mut visits);
        settled.map_err(|source| SimulationError::Term { time, source })
    }
}
