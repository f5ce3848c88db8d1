//! What a run knows of itself at one moment.

use pendular::dem::{Boundary, Simulation};
use pendular::{Account, Counts, Ledger, MeshWalls};
use serde::{Deserialize, Serialize};

use crate::build::WetTerm;
use crate::makeup::Makeup;

/// Counts and volumes at one moment.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tally {
    /// Simulated time, s.
    pub(crate) time: f64,
    /// Particles of each class that are still there.
    pub(crate) above: Vec<u64>,
    /// Particles of each class that were collected.
    pub(crate) collected: Vec<u64>,
    /// Particles of each class that have passed the screen, collected or not.
    pub(crate) passed: Vec<u64>,
    /// Particles of each class that left in any other way.
    pub(crate) escaped: Vec<u64>,
    /// Liquid in films on the particles of each class not collected, those that escaped with what
    /// they took along, m³.
    pub(crate) film: Vec<f64>,
    /// The same with the shares of the bridges they hold, split as at a rupture now, m³.
    pub(crate) film_shared: Vec<f64>,
    /// Liquid that was collected with each class, m³.
    pub(crate) fines: Vec<f64>,
    /// Liquid in films on each wall part, m³.
    pub(crate) parts: Vec<f64>,
    /// The same with the shares of the bridges, m³.
    pub(crate) parts_shared: Vec<f64>,
    /// Liquid in bridges, m³.
    pub(crate) bridges: f64,
    /// Live bridges with walls.
    pub(crate) wall_bridges: u64,
    /// Mean V* of the live bridges; 0 where there is none.
    pub(crate) mean_v_star: f64,
    /// How many bridges there were and are.
    pub(crate) counts: Counts,
    /// (total − initial total)/initial total of the liquid.
    pub(crate) imbalance: f64,
    /// Kinetic energy of all particles, J.
    pub(crate) kinetic: f64,
    /// Their potential energy above the wire axes, J.
    pub(crate) potential: f64,
    /// Capillary energy of the live bridges, J; 0 or less.
    pub(crate) capillary: f64,
    /// Capillary energy lost so far at formations and ruptures, J.
    pub(crate) capillary_loss: f64,
}

/// What has left so far.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(crate) struct Gone {
    pub(crate) collected: Vec<u64>,
    pub(crate) fines: Vec<f64>,
    pub(crate) escaped: Vec<u64>,
    /// Liquid on those that escaped, m³.
    pub(crate) taken: Vec<f64>,
}

impl Gone {
    /// Nothing yet, of so many classes.
    pub(crate) fn none(classes: usize) -> Self {
        let (none, dry) = (vec![0; classes], vec![0.0; classes]);
        Self { collected: none.clone(), fines: dry.clone(), escaped: none, taken: dry }
    }
}

impl Tally {
    /// Takes stock of a simulation.
    pub(crate) fn of<T: Makeup>(
        simulation: &Simulation<T, MeshWalls>,
        gone: &Gone,
        passed: &[u64],
    ) -> Self {
        let classes = simulation.particles().classes();
        let mut tally = Self {
            time: simulation.time(),
            above: vec![0; classes.len()],
            film: gone.taken.clone(),
            film_shared: vec![0.0; classes.len()],
            collected: gone.collected.clone(),
            fines: gone.fines.clone(),
            escaped: gone.escaped.clone(),
            passed: passed.to_vec(),
            parts: vec![0.0; simulation.boundary().0.parts().len()],
            kinetic: simulation.particles().kinetic_energy(),
            ..Self::default()
        };
        let gravity = simulation.settings().gravity;
        let wet = simulation.term().wet();
        for particle in simulation.particles().iter() {
            let class = usize::from(particle.class);
            tally.above[class] += 1;
            tally.potential -= classes[class].mass() * gravity.dot(particle.position);
            if let Some(wet) = wet {
                tally.film[class] += wet.ledger().volume(Account::Film(particle.id));
            }
        }
        tally.film_shared.clone_from(&tally.film);
        tally.parts_shared.clone_from(&tally.parts);
        if let Some(wet) = wet {
            tally.liquid(simulation, wet);
        }
        tally
    }

    fn liquid<T: Makeup>(&mut self, simulation: &Simulation<T, MeshWalls>, wet: &WetTerm) {
        let walls = &simulation.boundary().0;
        let elements = Ledger::walls(wet.ledger());
        for part in 0..self.parts.len() {
            let first = walls.first_element(part as u32) as usize;
            let count = walls.parts()[part].shape.element_count() as usize;
            self.parts[part] = elements.get(first..first + count).map_or(0.0, |e| e.iter().sum());
        }
        self.film_shared.clone_from(&self.film);
        self.parts_shared.clone_from(&self.parts);
        let mut v_star = 0.0;
        let mut alive = 0_u64;
        for live in wet.bridges() {
            let [first, second] = live.split.shares(live.bridge.volume());
            self.film_shared[usize::from(wet.class(live.first))] += first;
            match live.second {
                pendular::dem::Partner::Particle(id) => {
                    self.film_shared[usize::from(wet.class(id))] += second;
                }
                pendular::dem::Partner::Wall(part) => {
                    self.parts_shared[part as usize] += second;
                    self.wall_bridges += 1;
                }
            }
            v_star += live.bridge.v_star();
            alive += 1;
        }
        self.mean_v_star = v_star / alive.max(1) as f64;
        // The sum of no volumes is -0.
        self.bridges = wet.ledger().in_bridges() + 0.0;
        self.counts = wet.counts();
        self.imbalance = wet.ledger().imbalance();
        self.capillary_loss = wet.capillary_loss();
        simulation.survey(|pair, column| {
            let energy = |bridge| wet.energy_of(bridge, pair.encounter.gap);
            self.capillary += T::store(column).bridge.and_then(energy).unwrap_or(0.0);
        });
    }

    /// Particles of a class that are not in the collecting bin.
    pub(crate) fn retained(&self, class: usize) -> u64 {
        self.above[class] + self.escaped[class]
    }

    /// Particles that escaped.
    pub(crate) fn lost(&self) -> u64 {
        self.escaped.iter().sum()
    }

    /// Live bridges.
    pub(crate) fn alive(&self) -> u64 {
        self.counts.formed - self.counts.ruptured
    }
}

/// Largest speed of any wall, m/s.
pub(crate) fn wall_speed(walls: &MeshWalls) -> f64 {
    walls.speed_bound()
}
