//! Neighbour search in grids of cells, one grid for each factor of two in size.
//!
//! Cells as wide as the largest pair hold crowds of small particles; so each size class has cells
//! of its own, and a particle searches all grids, in each as far as it may touch there.

use glam::DVec3;

use crate::particles::Place;

/// Size classes at most; smaller particles share the last.
const LEVELS: usize = 16;

/// Particles sorted into cells, by size.
pub(crate) struct Grids {
    levels: Vec<Grid>,
    reach: f64,
}

impl Grids {
    /// Grids in which all pairs with a gap of at most `reach` m are found.
    pub(crate) fn new(places: &[Place], reach: f64) -> Self {
        Self::with_levels(places, reach, LEVELS)
    }

    fn with_levels(places: &[Place], reach: f64, levels: usize) -> Self {
        let largest = places.iter().fold(0.0_f64, |r, p| r.max(p.r));
        let mut members: Vec<Vec<u32>> = vec![Vec::new(); levels];
        for (slot, place) in places.iter().enumerate() {
            // `as` saturates: any size finds a class.
            let level = (largest / place.r).log2() as usize;
            members[level.min(levels - 1)].push(slot as u32);
        }
        members.retain(|slots| !slots.is_empty());
        let levels = members.iter().map(|slots| Grid::new(places, slots, reach)).collect();
        Self { levels, reach }
    }

    /// Calls `see` with every slot that may lie within reach of a sphere, and with others.
    #[inline]
    pub(crate) fn around(&self, place: &Place, mut see: impl FnMut(u32)) {
        for grid in &self.levels {
            grid.within(place.x, place.r + grid.widest + self.reach, &mut see);
        }
    }
}

/// Particles of one size class in cells.
struct Grid {
    low: DVec3,
    /// Largest radius, m.
    widest: f64,
    cell: f64,
    counts: [i64; 3],
    starts: Vec<u32>,
    slots: Vec<u32>,
}

impl Grid {
    /// Cells as wide as the largest distance of a pair in the class.
    fn new(places: &[Place], members: &[u32], reach: f64) -> Self {
        let all = || members.iter().map(|&slot| &places[slot as usize]);
        let low = all().fold(DVec3::INFINITY, |low, p| low.min(p.x));
        let high = all().fold(DVec3::NEG_INFINITY, |high, p| high.max(p.x));
        let widest = all().fold(0.0_f64, |r, p| r.max(p.r));
        let size = high - low;
        // A far stray must not make millions of empty cells.
        let mut cell = 2.0 * widest + reach;
        let count = |cell: f64| (size / cell).map(|v| v.floor() + 1.0);
        while count(cell).element_product() > 4.0 * members.len() as f64 + 64.0 {
            cell *= 1.25;
        }
        let counts = count(cell).to_array().map(|v| v as i64);
        let mut grid = Self { low, widest, cell, counts, starts: Vec::new(), slots: Vec::new() };
        grid.fill(places, members);
        grid
    }

    fn fill(&mut self, places: &[Place], members: &[u32]) {
        let cell = |slot: &u32| self.index(self.at(places[*slot as usize].x));
        let cells: Vec<u32> = members.iter().map(cell).collect();
        let total = self.counts.iter().product::<i64>() as usize;
        self.starts = vec![0; total + 1];
        for &c in &cells {
            self.starts[c as usize + 1] += 1;
        }
        for c in 0..total {
            self.starts[c + 1] += self.starts[c];
        }
        let mut next = self.starts.clone();
        self.slots = vec![0; members.len()];
        for (&slot, &c) in members.iter().zip(&cells) {
            self.slots[next[c as usize] as usize] = slot;
            next[c as usize] += 1;
        }
    }

    #[inline]
    fn at(&self, x: DVec3) -> [i64; 3] {
        let cell = ((x - self.low) / self.cell).to_array();
        let mut at = [0; 3];
        for axis in 0..3 {
            // A point below the grid lies in its first cell: `as` cuts towards zero.
            at[axis] = (cell[axis] as i64).clamp(0, self.counts[axis] - 1);
        }
        at
    }

    #[inline]
    fn index(&self, at: [i64; 3]) -> u32 {
        ((at[2] * self.counts[1] + at[1]) * self.counts[0] + at[0]) as u32
    }

    /// Calls `see` with every slot in the cells within `distance` of `x`, row by row.
    #[inline]
    fn within(&self, x: DVec3, distance: f64, see: &mut impl FnMut(u32)) {
        let ([x0, y0, z0], [x1, y1, z1]) = (self.at(x - distance), self.at(x + distance));
        for z in z0..=z1 {
            for y in y0..=y1 {
                let first = self.starts[self.index([x0, y, z]) as usize] as usize;
                let last = self.starts[self.index([x1, y, z]) as usize + 1] as usize;
                self.slots[first..last].iter().for_each(|&slot| see(slot));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    /// Large spheres on a lattice, small ones anywhere, ratio 10 and equal volumes; some strays.
    fn mixture() -> Vec<Place> {
        let mut random = Pcg64::seed_from_u64(3);
        let mut uniform = || (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        let mut places = Vec::new();
        for k in 0..27 {
            let at = DVec3::new(f64::from(k % 3), f64::from(k / 3 % 3), f64::from(k / 9));
            places.push(Place { x: 2.2 * at, r: 1.0 });
        }
        for _ in 0..20_000 {
            let x = 6.6 * DVec3::new(uniform(), uniform(), uniform()) - 1.1;
            places.push(Place { x, r: 0.1 + 0.01 * uniform() });
        }
        places.push(Place { x: DVec3::splat(1e3), r: 0.3 });
        places.push(Place { x: DVec3::new(-40.0, 0.0, 2.0), r: 1e-9 });
        places
    }

    fn pairs(places: &[Place], grids: &Grids, reach: f64) -> (Vec<[u32; 2]>, u64) {
        let (mut found, mut seen) = (Vec::new(), 0);
        for (i, p) in places.iter().enumerate() {
            grids.around(p, |j| {
                seen += 1;
                let q = &places[j as usize];
                if (q.x - p.x).length() <= p.r + q.r + reach {
                    found.push([i as u32, j]);
                }
            });
        }
        found.sort_unstable();
        (found, seen)
    }

    /// With `--nocapture` it also says how long building the grids and the search took.
    #[test]
    fn size_classes_find_the_same_pairs_among_ten_times_fewer_candidates() {
        let (places, reach) = (mixture(), 0.02);
        let timed = |levels: fn(&[Place], f64) -> Grids| {
            let start = std::time::Instant::now();
            let found = pairs(&places, &levels(&places, reach), reach);
            (found, start.elapsed())
        };
        let (plain, plain_time) = timed(|places, reach| Grids::with_levels(places, reach, 1));
        let (sized, sized_time) = timed(Grids::new);
        println!("one plain grid {plain_time:?}, size classes {sized_time:?}");
        assert!(plain.0 == sized.0);
        assert!(plain.0.len() > places.len() + 10_000, "pairs besides each with itself");
        assert!(plain.1 > 10 * sized.1, "{} against {}", plain.1, sized.1);
    }

    #[test]
    fn all_pairs_are_found_on_the_edge_of_reach() {
        let reach = 0.5;
        let row =
            |gap: f64| [Place { x: DVec3::ZERO, r: 1.0 }, Place { x: DVec3::X * gap, r: 0.1 }];
        let near = row(1.1 + reach * (1.0 - 1e-12));
        assert_eq!(pairs(&near, &Grids::new(&near, reach), reach).0.len(), 4);
        let none: [Place; 0] = [];
        assert!(pairs(&none, &Grids::new(&none, reach), reach).0.is_empty());
    }
}
