//! A look at all that acts, between two steps.

use super::Simulation;
use crate::limit::{Hold, Limit};
use crate::view::View;
use crate::{Boundary, Encounter, Pair, PairTerm, Partner, wall_pass};

/// How often the shares of pairs in the limit are refined.
const REFINEMENTS: u32 = 6;
/// A refinement that changes the limit by less than this share is the last.
const WORTH: f64 = 2e-3;
/// Spheres whose limit is below this many times the least are looked at more closely.
const CLOSE: f64 = 1.4;
/// How fast a sphere counts at least, over the fastest.
const SLOWEST: f64 = 0.05;

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
                    see(&view.pair(entry), column);
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

    /// The longest stable time step of the packing as it is now, from the pairs that act and the
    /// directions they act in.
    ///
    /// Λ_K is the largest eigenvalue of any sphere's own block of the stiffness over the mass, each
    /// pair counted `1 + √(m_i/m_j) s_j/s_i` times, a wall once: a bound of the fastest motion for
    /// any arrangement and any s, exact for one pair of equal spheres. s is 1 at first, then what the
    /// blocks say, as in the power method; the best of these bounds counts. [`Simulation::limit`]
    /// takes twelve contacts from all sides instead, before there are any.
    #[must_use]
    pub fn limit_now(&self) -> Limit {
        let mut fastness = vec![1.0; self.particles.created as usize];
        let mut best = self.limit_by(&mut fastness);
        for _ in 0..REFINEMENTS {
            let finer = self.limit_by(&mut fastness);
            let gain = finer.time_step / best.time_step;
            if gain > 1.0 {
                best = finer;
            }
            if gain.is_nan() || (gain - 1.0).abs() < WORTH {
                break;
            }
        }
        best
    }

    /// The limit with pairs shared out by how fast the spheres are, by their ids, which is then
    /// multiplied by what their blocks say.
    fn limit_by(&self, fastness: &mut [f64]) -> Limit {
        let particles = &self.particles;
        let classes = particles.classes();
        let mass = |class: u16| classes[usize::from(class)].mass();
        let mut holds = vec![Hold::default(); fastness.len()];
        self.survey(|pair, column| {
            let load = self.term.load_on_limit(pair, column);
            let own = mass(pair.first_class);
            let first = pair.encounter.first as usize;
            if let Partner::Particle(second) = pair.encounter.second {
                let (second, other) = (second as usize, mass(pair.second_class));
                let faster = fastness[second] / fastness[first];
                holds[first].add(&load, pair.normal, [own, other], faster);
                holds[second].add(&load, -pair.normal, [other, own], 1.0 / faster);
            } else {
                holds[first].add(&load, pair.normal, [own, f64::INFINITY], 1.0);
            }
        });
        let bodies = particles.class.iter().zip(&particles.id);
        let mut limits: Vec<Limit> =
            bodies.map(|(&class, &id)| holds[id as usize].limit(usize::from(class))).collect();
        let close = CLOSE * Limit::least(limits.iter().copied()).time_step;
        for (limit, &id) in limits.iter_mut().zip(&particles.id) {
            if limit.time_step < close {
                *limit = holds[id as usize].finer(*limit);
            }
        }
        let least = Limit::least(limits.iter().copied());
        for (limit, &id) in limits.iter().zip(&particles.id) {
            // Slow ones are not taken to stand still: a bound that is too small for them costs others.
            let speed = (least.time_step / limit.time_step).max(SLOWEST);
            if speed.is_finite() {
                fastness[id as usize] *= speed;
            }
        }
        least
    }

    fn acts(&self, encounter: &Encounter, column: &T::Column) -> bool {
        !self.term.idle(encounter, &mut column.clone())
    }

    fn wall_pair(
        &self,
        view: &View<'_>,
        slot: u32,
        encounter: Encounter,
        memory: &crate::chunk::Memory<T::Column>,
    ) -> Pair {
        let touch = &memory.touch;
        wall_pass::pair(view, &self.boundary, slot, encounter, touch, touch.normal)
    }
}
