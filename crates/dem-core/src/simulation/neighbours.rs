//! When lists are renewed, and how columns find their new places.

use std::time::Instant;

use super::built::Built;
use super::skins::Skins;
use super::{Settings, Simulation, each};
use crate::chunk::{Chunk, Memories, WallPair};
use crate::grid::Grids;
use crate::lists;
use crate::order::chunk_size;
use crate::particles::{Class, Particles};
use crate::{Boundary, PairTerm, wall_pass};

/// The term arranges what it keeps once one particle in so many has seen a pair settled.
const ARRANGE: usize = 16;

/// How far bodies may still move before a list can miss a pair.
///
/// Each budget is the sum over steps of the largest speed times the step: it can only
/// overestimate what a pair's gap has changed.
#[derive(Debug)]
pub(super) struct State {
    pub(super) chunk_size: usize,
    pub(super) classes: Vec<Class>,
    pub(super) overlap: f64,
    skins: Skins,
    outer: f64,
    inner: f64,
    walls: f64,
    reach: f64,
    wall_reach: f64,
    built: Built,
    /// Pairs that were settled since the term last arranged what it keeps.
    pub(super) visited: usize,
}

impl State {
    pub(super) fn new(particles: &Particles, settings: &Settings) -> Self {
        let classes = particles.classes().to_vec();
        let skins = Skins::new(&classes, settings);
        Self {
            chunk_size: 1,
            classes,
            overlap: 0.0,
            skins,
            outer: f64::INFINITY,
            inner: f64::INFINITY,
            walls: f64::INFINITY,
            reach: 0.0,
            wall_reach: 0.0,
            built: Built::default(),
            visited: 0,
        }
    }

    /// All lists are void: the particles stand in a new order.
    pub(super) fn renew(&mut self, particles: &Particles, chunk_size: usize) {
        self.chunk_size = chunk_size;
        (self.outer, self.inner, self.walls) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
        self.visited = particles.len();
    }

    /// A step was made: no particle moved farther than `particle` m, no wall farther than `wall`.
    pub(super) fn travel(&mut self, particle: f64, wall: f64) {
        self.outer += 2.0 * particle;
        self.inner += 2.0 * particle;
        self.walls += particle + wall;
        self.skins.pace = 2.0 * particle;
    }
}

impl<T: PairTerm, B: Boundary> Simulation<T, B> {
    /// Renews whatever list can no longer be trusted in the coming step.
    pub(super) fn refresh(&mut self) {
        let reach = self.term.reach();
        let lists = &self.lists;
        let grown = (reach - lists.reach).max(0.0);
        let stale = lists.outer + grown > lists.skins.outer;
        let prune = stale || lists.inner + grown > lists.skins.inner;
        let wall_stale = lists.walls + (reach - lists.wall_reach).max(0.0) > lists.skins.walls;
        let untidy = ARRANGE * lists.visited >= self.particles.len();
        if !(stale || prune || wall_stale || untidy) {
            return;
        }
        let start = Instant::now();
        if stale && !self.still_good(grown) {
            self.build(reach);
        }
        if prune {
            self.prune(reach);
        }
        if wall_stale {
            self.find_walls(reach);
        }
        if untidy {
            self.arrange();
        }
        self.profile.neighbours += start.elapsed();
    }

    /// Lets the term bring what it keeps of the pairs into the order of the lists.
    fn arrange(&mut self) {
        let chunks = &mut self.chunks;
        self.term.arrange(&mut |see| {
            for chunk in &mut *chunks {
                chunk.inside.columns.iter_mut().for_each(&mut *see);
                chunk.across.columns.iter_mut().for_each(&mut *see);
                let memories = chunk.walls.iter_mut().flat_map(|wall| &mut wall.memories);
                memories.for_each(|memory| see(&mut memory.column));
            }
        });
        self.lists.visited = 0;
    }

    /// Whether the true displacements since the last build, the common one taken out, allow to
    /// keep the outer lists for some time; if so, the budget is set to them.
    fn still_good(&mut self, grown: f64) -> bool {
        let lists = &mut self.lists;
        if !lists.outer.is_finite() {
            return false;
        }
        let bound = 2.0 * lists.built.most_moved(&self.particles.places);
        let good = bound + grown < 0.75 * lists.skins.outer;
        if good {
            lists.outer = bound;
        }
        good
    }

    fn build(&mut self, reach: f64) {
        let pairs = self.count_pairs();
        self.lists.skins.choose_outer(self.particles.len(), pairs);
        let range = reach + self.lists.skins.outer;
        let grids = Grids::new(&self.particles.places, range);
        let particles = &self.particles;
        each(&mut self.chunks, self.settings.threads, |chunk| {
            let (inside, across) = (&mut chunk.inside, &mut chunk.across);
            lists::find(particles, &grids, &chunk.range, range, inside, across);
        });
        let lists = &mut self.lists;
        lists.built.note(&particles.places);
        (lists.outer, lists.reach) = (0.0, reach);
        self.profile.builds += 1;
    }

    /// How many pairs are in the outer lists and in the active ones.
    fn count_pairs(&self) -> [usize; 2] {
        self.chunks.iter().fold([0; 2], |[outer, active], Chunk { inside, across, .. }| {
            let more = inside.outer.len() + across.outer.len();
            [outer + more, active + inside.active.len() + across.active.len()]
        })
    }

    fn prune(&mut self, reach: f64) {
        let pairs = self.count_pairs();
        self.lists.skins.choose_inner(pairs);
        let range = reach + self.lists.skins.inner;
        let (places, term) = (&self.particles.places, &self.term);
        each(&mut self.chunks, self.settings.threads, |chunk| {
            let live = |column: &T::Column| term.live(column);
            chunk.inside.prune(places, &chunk.range, range, live);
            chunk.across.prune(places, &chunk.range, range, live);
        });
        self.lists.inner = 0.0;
        self.profile.prunes += 1;
    }

    fn find_walls(&mut self, reach: f64) {
        let range = reach + self.lists.skins.walls;
        let (places, term, boundary) = (&self.particles.places, &self.term, &self.boundary);
        each(&mut self.chunks, self.settings.threads, |chunk| {
            wall_pass::find(term, boundary, places, range, chunk);
        });
        (self.lists.walls, self.lists.wall_reach) = (0.0, reach);
    }
}

impl<T: PairTerm, B: Boundary> Simulation<T, B> {
    /// Sorts the particles along the Morton curve, without those in `leaving`, cuts them into new
    /// chunks and carries every live column over.
    pub(super) fn sort(&mut self, leaving: &[u32]) {
        let start = Instant::now();
        let mut carried = Carried::default();
        // One after the other, so that nothing is there twice.
        for chunk in std::mem::take(&mut self.chunks) {
            carried.add(&chunk, &self.particles, &self.term, leaving);
            self.lists.overlap = self.lists.overlap.max(chunk.overlap);
            self.profile.pairs += chunk.pair_time;
            self.profile.walls += chunk.wall_time;
        }
        let slots: Vec<u32> = if leaving.is_empty() {
            crate::order::morton(&self.particles)
        } else {
            let all = 0..self.particles.len() as u32;
            all.filter(|slot| leaving.binary_search(slot).is_err()).collect()
        };
        self.particles.arrange(&slots);
        if !self.rolls.is_empty() {
            self.rolls = slots.iter().map(|&s| self.rolls[s as usize]).collect();
        }
        self.cut(carried);
        self.profile.neighbours += start.elapsed();
    }

    /// Cuts the particles, in the order they stand in, into chunks that own the carried columns.
    pub(super) fn cut(&mut self, carried: Carried<T::Column>) {
        let size = chunk_size(self.particles.len());
        self.lists.renew(&self.particles, size);
        let n = self.particles.len() as u32;
        let rolls = !self.rolls.is_empty();
        self.chunks = (0..n)
            .step_by(size)
            .map(|first| Chunk::new(first..n.min(first + size as u32), [rolls, T::IMPLICIT]))
            .collect();
        carried.hand_out(self);
    }
}

/// All live columns, by the ids of their bodies, while the particles change their order.
pub(super) struct Carried<C> {
    /// In several parts: each is given back as soon as its columns have found their places.
    pub(super) pairs: Vec<Vec<([u32; 2], C)>>,
    pub(super) walls: Vec<CarriedWall<C>>,
}

/// A wall pair on its way: the particle's id, the part, memories, candidates.
pub(super) type CarriedWall<C> = (u32, u32, Memories<C>, Vec<u32>);

impl<C> Default for Carried<C> {
    fn default() -> Self {
        Self { pairs: Vec::new(), walls: Vec::new() }
    }
}

impl<C: Copy + Default + Send + Sync> Carried<C> {
    /// Adds the live columns of a chunk, but for those of particles that leave.
    pub(super) fn add(
        &mut self,
        chunk: &Chunk<C>,
        particles: &Particles,
        term: &impl PairTerm<Column = C>,
        leaving: &[u32],
    ) {
        let id = &particles.id;
        let stays = |slot: u32| leaving.binary_search(&slot).is_err();
        let (inside, across) = (&chunk.inside, &chunk.across);
        let inside = inside.active.iter().zip(&inside.columns);
        let across = across.active.iter().zip(&across.columns);
        let ours = across.filter(|(entry, _)| chunk.range.contains(&entry[0]));
        let live = inside
            .chain(ours)
            .filter(|(entry, column)| term.live(column) && entry.iter().all(|&slot| stays(slot)));
        let named =
            |(entry, column): (&[u32; 2], &C)| (entry.map(|slot| id[slot as usize]), *column);
        self.pairs.push(live.map(named).collect());
        for wall in chunk.walls.iter().filter(|wall| stays(wall.slot)) {
            let candidates = chunk.pool[wall.candidates.clone()].to_vec();
            let memories = wall.memories.clone();
            self.walls.push((id[wall.slot as usize], wall.part, memories, candidates));
        }
    }

    /// Puts the columns into the lists of the new chunks; the lists' order is restored.
    pub(super) fn hand_out<T: PairTerm<Column = C>, B>(self, simulation: &mut Simulation<T, B>) {
        let size = simulation.lists.chunk_size as u32;
        let mut slot_of = vec![u32::MAX; simulation.particles.created as usize];
        for (slot, &id) in simulation.particles.id.iter().enumerate() {
            slot_of[id as usize] = slot as u32;
        }
        let mut inside: Vec<Vec<_>> = simulation.chunks.iter().map(|_| Vec::new()).collect();
        let mut across = inside.clone();
        for (ids, column) in self.pairs.into_iter().flatten() {
            let entry = ids.map(|id| slot_of[id as usize]);
            let [a, b] = entry.map(|slot| (slot / size) as usize);
            if a == b {
                inside[a].push((entry, column));
            } else {
                across[a].push((entry, column));
                across[b].push((entry, column));
            }
        }
        let chunks = &mut simulation.chunks;
        for ((chunk, inside), across) in chunks.iter_mut().zip(inside).zip(across) {
            for (list, mut pairs) in [(&mut chunk.inside, inside), (&mut chunk.across, across)] {
                pairs.sort_unstable_by_key(|(entry, _)| lists::key(*entry, &chunk.range));
                (list.active, list.columns) = pairs.into_iter().unzip();
            }
        }
        let mut walls: Vec<_> = self
            .walls
            .into_iter()
            .map(|(id, part, memories, near)| (slot_of[id as usize], part, memories, near))
            .collect();
        walls.sort_unstable_by_key(|&(slot, part, ..)| (slot, part));
        for (slot, part, memories, near) in walls {
            let chunk = &mut chunks[(slot / size) as usize];
            let candidates = chunk.pool.len()..chunk.pool.len() + near.len();
            chunk.pool.extend(near);
            chunk.walls.push(WallPair { slot, part, candidates, memories });
        }
    }
}
