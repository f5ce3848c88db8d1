//! All that a simulation has become, to go on from later.

use glam::DVec3;

use super::neighbours::Carried;
use super::{Settings, Simulation};
use crate::chunk::{Memory, Roll};
use crate::particles::{Place, Velocity};
use crate::{Boundary, PairTerm, Particle, ParticleError, Particles, SimulationError, Touch};

/// A particle's rolling state: the spin that the last step's torques gave, and its contacts.
pub type RollState = (DVec3, f64);

/// What a term remembers of a particle and a wall part.
#[derive(Debug, Clone, PartialEq)]
pub struct WallMemory<C> {
    /// The particle's id.
    pub particle: u32,
    /// The wall part.
    pub part: u32,
    /// Touches at the last step, and the column of each.
    pub touches: Vec<(Touch, C)>,
    /// Elements of the part that were near.
    pub elements: Vec<u32>,
}

/// Everything a simulation needs to go on, but for its laws, walls and settings: with those it goes
/// on to the bit as if it had never stopped.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot<C> {
    /// Steps done.
    pub step: u64,
    /// Particles ever added.
    pub created: u32,
    /// Particles in the core's own order, which decides the order of sums.
    pub particles: Vec<Particle>,
    /// Rolling state in the same order; empty without rolling friction.
    pub rolls: Vec<RollState>,
    /// Live columns of pairs of particles, by their ids.
    pub pairs: Vec<([u32; 2], C)>,
    /// Columns of particles and walls.
    pub walls: Vec<WallMemory<C>>,
    /// Largest overlap so far, as a share of the smaller radius.
    pub overlap: f64,
}

impl<C> Snapshot<C> {
    /// The same with every column changed, for example into something that can be stored.
    pub fn map<D>(self, mut change: impl FnMut(C) -> D) -> Snapshot<D> {
        let Self { step, created, particles, rolls, pairs, walls, overlap } = self;
        let pairs = pairs.into_iter().map(|(ids, column)| (ids, change(column))).collect();
        let walls = walls
            .into_iter()
            .map(|wall| WallMemory {
                particle: wall.particle,
                part: wall.part,
                touches: wall.touches.into_iter().map(|(t, c)| (t, change(c))).collect(),
                elements: wall.elements,
            })
            .collect();
        Snapshot { step, created, particles, rolls, pairs, walls, overlap }
    }
}

impl<T: PairTerm, B: Boundary> Simulation<T, B> {
    /// What the simulation has become.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot<T::Column> {
        let mut carried = Carried::default();
        for chunk in &self.chunks {
            carried.add(chunk, &self.particles, &self.term, &[]);
        }
        let walls =
            carried.walls.into_iter().map(|(particle, part, memories, elements)| WallMemory {
                particle,
                part,
                touches: memories.into_iter().map(|m| (m.touch, m.column)).collect(),
                elements,
            });
        Snapshot {
            step: self.step,
            created: self.particles.created,
            particles: self.particles.iter().collect(),
            rolls: self.rolls.iter().map(|roll| (roll.spin, roll.contacts)).collect(),
            pairs: carried.pairs.into_iter().flatten().collect(),
            walls: walls.collect(),
            overlap: self.largest_overlap(),
        }
    }

    /// Goes on from a snapshot. `particles` gives the classes; whatever particles it holds are
    /// replaced by those of the snapshot. Term, walls and settings are to be those of before.
    ///
    /// # Errors
    /// [`SimulationError`] as [`Simulation::new`], and if the snapshot does not fit together.
    pub fn restore(
        particles: Particles,
        term: T,
        boundary: B,
        settings: Settings,
        snapshot: Snapshot<T::Column>,
    ) -> Result<Self, SimulationError> {
        let mut simulation = Self::bare(particles, term, boundary, settings)?;
        let Snapshot { step, created, particles, rolls, pairs, walls, overlap } = snapshot;
        simulation.particles.replace(&particles, created)?;
        simulation.rolls =
            rolls.into_iter().map(|(spin, contacts)| Roll { spin, contacts }).collect();
        let wanted = if simulation.term.rolls() { particles.len() } else { 0 };
        if simulation.rolls.len() != wanted {
            return Err(SimulationError::Snapshot { what: "rolling states" });
        }
        let mut known = vec![false; created as usize];
        particles.iter().for_each(|p| known[p.id as usize] = true);
        let there = |id: u32| known.get(id as usize) == Some(&true);
        let pairs_fit = pairs.iter().all(|(ids, _)| ids.iter().all(|&id| there(id)));
        if !pairs_fit || !walls.iter().all(|wall| there(wall.particle)) {
            return Err(SimulationError::Snapshot {
                what: "pairs of particles that are not there",
            });
        }
        let walls = walls.into_iter().map(|wall| {
            let memory = |(touch, column)| Memory { touch, column };
            let memories = wall.touches.into_iter().map(memory).collect();
            (wall.particle, wall.part, memories, wall.elements)
        });
        let carried = Carried { pairs: vec![pairs], walls: walls.collect() };
        simulation.step = step;
        simulation.lists.overlap = overlap;
        let (time, h) = (simulation.time(), simulation.settings.time_step);
        let lag = if step == 0 { 0.0 } else { 0.5 * h };
        simulation.boundary.move_to(time, time - lag);
        simulation.cut(carried);
        Ok(simulation)
    }
}

impl Particles {
    /// Takes the particles of a snapshot, in their order, instead of its own.
    fn replace(&mut self, particles: &[Particle], created: u32) -> Result<(), ParticleError> {
        (self.places, self.velocities) = (Vec::new(), Vec::new());
        (self.class, self.id) = (Vec::new(), Vec::new());
        for particle in particles {
            let Particle { id, class, position, velocity, spin } = *particle;
            let classes = self.classes().len();
            let kind = self.classes().get(usize::from(class));
            let r = kind.ok_or(ParticleError::UnknownClass { class, classes })?.radius();
            if id >= created {
                return Err(ParticleError::TooMany {
                    what: "particles",
                    allowed: created as usize,
                });
            }
            self.places.push(Place { x: position, r });
            self.velocities.push(Velocity::new(velocity, spin));
            self.class.push(class);
            self.id.push(id);
        }
        self.created = created;
        Ok(())
    }
}
