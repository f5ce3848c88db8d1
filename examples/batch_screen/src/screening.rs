//! What happens at the screen: who passes it, and which apertures are blocked.

use std::collections::BTreeMap;

use glam::DVec3;
use pendular::MeshWalls;
use pendular::dem::{PairTerm, Particle, Simulation};
use serde::{Deserialize, Serialize};

use crate::scene::Scene;

/// A particle that has passed the screen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Passage {
    pub(crate) time: f64,
    pub(crate) particle: Particle,
}

/// Follows the particles through the screen.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct Screening {
    aperture: f64,
    wire: f64,
    radius: f64,
    through: Vec<bool>,
    /// Particles of each class that have passed.
    pub(crate) passed: Vec<u64>,
    in_apertures: BTreeMap<[i32; 2], u32>,
}

impl Screening {
    pub(crate) fn new(scene: &Scene, particles: usize) -> Self {
        Self {
            aperture: 1e-3 * scene.screen.aperture_mm,
            wire: 1e-3 * scene.screen.wire_diameter_mm,
            radius: 0.5e-3 * scene.screen.diameter_mm,
            through: vec![false; particles],
            passed: vec![0; scene.classes.len()],
            in_apertures: BTreeMap::new(),
        }
    }

    /// Particles that have come to lie wholly below the wires since the last look; each counts
    /// once, whatever becomes of it.
    pub(crate) fn passages<T: PairTerm>(
        &mut self,
        simulation: &Simulation<T, MeshWalls>,
    ) -> Vec<Passage> {
        let classes = simulation.particles().classes();
        let shift = displacement(simulation).z;
        let mut new = Vec::new();
        for particle in simulation.particles().iter() {
            let r = classes[usize::from(particle.class)].radius();
            let below = particle.position.z - shift < -(0.5 * self.wire + r);
            if below && !self.through[particle.id as usize] {
                self.note(particle, simulation.time(), &mut new);
            }
        }
        new.sort_by_key(|passage| passage.particle.id);
        new
    }

    /// A particle that is collected has passed, wherever it was at the last look.
    pub(crate) fn note(&mut self, particle: Particle, time: f64, new: &mut Vec<Passage>) {
        let through = &mut self.through[particle.id as usize];
        if !*through {
            *through = true;
            self.passed[usize::from(particle.class)] += 1;
            new.push(Passage { time, particle });
        }
    }

    /// Whether a particle has passed the screen.
    pub(crate) fn is_through(&self, id: u32) -> bool {
        self.through.get(id as usize).copied().unwrap_or(false)
    }

    /// Number of apertures whose centre lies in the frame.
    pub(crate) fn apertures(&self) -> u64 {
        let most = (self.radius / self.pitch()).ceil() as i32;
        let inside = |i: i32, j: i32| self.pitch() * f64::from(i).hypot(f64::from(j)) < self.radius;
        (-most..=most).map(|i| (-most..=most).filter(|&j| inside(i, j)).count() as u64).sum()
    }

    fn pitch(&self) -> f64 {
        self.aperture + self.wire
    }

    /// Apertures held by the same sphere as at the last call, by the sphere's class. A sphere
    /// holds an aperture while its centre is over it and it dips between the wires.
    pub(crate) fn blocked<T: PairTerm>(
        &mut self,
        simulation: &Simulation<T, MeshWalls>,
    ) -> Vec<u64> {
        let particles = simulation.particles();
        let shift = displacement(simulation);
        let mut now: BTreeMap<[i32; 2], (f64, Particle)> = BTreeMap::new();
        for particle in particles.iter() {
            let x = particle.position - shift;
            let r = particles.classes()[usize::from(particle.class)].radius();
            let cell = [x.x, x.y].map(|v| (v / self.pitch()).round() as i32);
            let off = |k: usize| (x[k] - self.pitch() * f64::from(cell[k])).abs();
            let over = off(0) < 0.5 * self.aperture && off(1) < 0.5 * self.aperture;
            let dips = x.z - r < 0.5 * self.wire && x.z + r > -0.5 * self.wire;
            if over && dips && now.get(&cell).is_none_or(|(height, _)| x.z < *height) {
                now.insert(cell, (x.z, particle));
            }
        }
        let mut blocked = vec![0; self.passed.len()];
        for (cell, (_, particle)) in &now {
            if self.in_apertures.get(cell) == Some(&particle.id) {
                blocked[usize::from(particle.class)] += 1;
            }
        }
        self.in_apertures = now.into_iter().map(|(cell, (_, p))| (cell, p.id)).collect();
        blocked
    }
}

/// Where the screen is now, against its rest position.
pub(crate) fn displacement<T: PairTerm>(simulation: &Simulation<T, MeshWalls>) -> DVec3 {
    let walls = &simulation.boundary().0;
    // All parts that move do so with the screen. The wires come first, unless a file replaces them.
    let moving = walls.parts().iter().position(|part| !part.motion.is_still());
    moving.map_or(DVec3::ZERO, |part| walls.displacement(part as u32))
}

/// Diameter (of `diameters`, ascending by `order`) at which the probability of passing falls
/// through `level`, by interpolation between classes; `None` where it does not.
fn diameter_at(level: f64, diameters: &[f64], passed: &[f64]) -> Option<f64> {
    let mut order: Vec<usize> = (0..diameters.len()).collect();
    order.sort_by(|&a, &b| diameters[a].total_cmp(&diameters[b]));
    order.windows(2).find_map(|pair| {
        let (a, b) = (pair[0], pair[1]);
        let (high, low) = (passed[a], passed[b]);
        let inside = high >= level && low <= level && high > low;
        let share = (high - level) / (high - low);
        inside.then(|| diameters[a] + share * (diameters[b] - diameters[a]))
    })
}

/// Cut size d₅₀ and imperfection (d₂₅ − d₇₅)/(2 d₅₀) of probabilities of passing by class; d₇₅ and
/// d₂₅ are the diameters that pass with 75 and 25 %. `None` where they are not reached.
pub(crate) fn partition(diameters: &[f64], passed: &[f64]) -> (Option<f64>, Option<f64>) {
    let at = |level| diameter_at(level, diameters, passed);
    let cut = at(0.5);
    let imperfection = match (at(0.25), cut, at(0.75)) {
        (Some(coarse), Some(cut), Some(fine)) => Some((coarse - fine) / (2.0 * cut)),
        _ => None,
    };
    (cut, imperfection)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn partition_by_hand() {
        // 100, 60, 0 % at 5, 7, 10 mm: d50 = 7 + 3/6, d75 = 5 + 2·25/40, d25 = 7 + 3·35/60.
        let (cut, imperfection) = partition(&[7.0, 10.0, 5.0], &[0.6, 0.0, 1.0]);
        assert!((cut.unwrap() - 7.5).abs() < 1e-12);
        assert!((imperfection.unwrap() - (8.75 - 6.25) / 15.0).abs() < 1e-12);
        assert_eq!(partition(&[5.0, 7.0], &[0.0, 0.0]), (None, None));
        let (cut, imperfection) = partition(&[5.0, 7.0], &[0.6, 0.3]);
        assert!(cut.is_some() && imperfection.is_none());
    }
}
