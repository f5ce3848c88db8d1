//! A look at all that acts, between two steps.

use super::Simulation;
use crate::limit::{Limit, Sums};
use crate::view::View;
use crate::{Boundary, Encounter, Pair, PairTerm, Partner, wall_pass};

impl<T: PairTerm, B: Boundary> Simulation<T, B> {
    /// Calls `see` once with every pair that is not idle, as the next step would read it, and with
    /// its column; particles with walls as the last step read them.
    ///
    /// It is for what is looked at now and then: energies, shares of the forces, limits. The order
    /// is the same on any number of threads.
    pub fn survey(&self, mut see: impl FnMut(&Pair, &T::Column)) {
        let view = self.view();
        for chunk in &self.chunks {
            let across = chunk.across.active.iter().zip(&chunk.across.columns);
            let across = across.filter(|(entry, _)| chunk.range.contains(&entry[0]));
            let inside = chunk.inside.active.iter().zip(&chunk.inside.columns);
            for (&entry, column) in inside.chain(across) {
                if self.acts(&view.meet(entry), column) {
                    see(&self.pair(&view, entry), column);
                }
            }
            for wall in chunk.walls.iter().filter(|wall| self.boundary.is_present(wall.part)) {
                for (k, memory) in wall.memories.iter().enumerate() {
                    let encounter = Encounter {
                        nearest: k == 0,
                        ..wall_pass::meeting(&view, wall, &memory.touch)
                    };
                    if self.acts(&encounter, &memory.column) {
                        see(&self.wall_pair(&view, wall.slot, encounter, memory), &memory.column);
                    }
                }
            }
        }
    }

    /// The longest stable time step of the packing as it is now: the same formula as
    /// [`Simulation::limit`], with the sums over the pairs that act instead of twelve contacts.
    #[must_use]
    pub fn limit_now(&self) -> Limit {
        let particles = &self.particles;
        let mut sums = vec![Sums::default(); particles.created as usize];
        self.survey(|pair, column| {
            let load = self.term.load_on_limit(pair, column);
            sums[pair.encounter.first as usize].add(&load);
            if let Partner::Particle(second) = pair.encounter.second {
                sums[second as usize].add(&load);
            }
        });
        let bodies = particles.class.iter().zip(&particles.id);
        let classes = particles.classes();
        Limit::least(bodies.map(|(&class, &id)| {
            let mass = classes[usize::from(class)].mass();
            sums[id as usize].limit(mass, usize::from(class))
        }))
    }

    fn acts(&self, encounter: &Encounter, column: &T::Column) -> bool {
        !self.term.idle(encounter, &mut column.clone())
    }

    fn pair(&self, view: &View<'_>, entry: crate::lists::Entry) -> Pair {
        if self.rolls.is_empty() { view.pair::<false>(entry) } else { view.pair::<true>(entry) }
    }

    fn wall_pair(
        &self,
        view: &View<'_>,
        slot: u32,
        encounter: Encounter,
        memory: &crate::chunk::Memory<T::Column>,
    ) -> Pair {
        let (boundary, touch) = (&self.boundary, &memory.touch);
        if self.rolls.is_empty() {
            wall_pass::pair::<B, false>(view, boundary, slot, encounter, touch, touch.normal)
        } else {
            wall_pass::pair::<B, true>(view, boundary, slot, encounter, touch, touch.normal)
        }
    }
}
