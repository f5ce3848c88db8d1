//! Neighbour search in a grid of cells.

use glam::DVec3;

use crate::particles::Place;

/// Particles sorted into cells a little larger than the largest interaction.
pub(crate) struct Grid {
    low: DVec3,
    cell: f64,
    counts: [i64; 3],
    starts: Vec<u32>,
    slots: Vec<u32>,
}

impl Grid {
    /// Cells so wide that every pair with a gap of at most `reach` lies in neighbouring ones.
    pub(crate) fn new(places: &[Place], reach: f64) -> Self {
        let low = places.iter().fold(DVec3::INFINITY, |low, p| low.min(p.x));
        let high = places.iter().fold(DVec3::NEG_INFINITY, |high, p| high.max(p.x));
        let widest = 2.0 * places.iter().fold(0.0_f64, |r, p| r.max(p.r)) + reach;
        let size = if places.is_empty() { DVec3::ZERO } else { high - low };
        // A far stray must not make millions of empty cells.
        let mut cell = widest;
        let count = |cell: f64| (size / cell).map(|v| v.floor() + 1.0);
        while count(cell).element_product() > 4.0 * places.len() as f64 + 64.0 {
            cell *= 1.25;
        }
        let counts = count(cell).to_array().map(|v| v as i64);
        let mut grid = Self { low, cell, counts, starts: Vec::new(), slots: Vec::new() };
        grid.fill(places);
        grid
    }

    fn fill(&mut self, places: &[Place]) {
        let cells: Vec<u32> = places.iter().map(|p| self.index(self.at(p.x))).collect();
        let total = self.counts.iter().product::<i64>() as usize;
        self.starts = vec![0; total + 1];
        for &c in &cells {
            self.starts[c as usize + 1] += 1;
        }
        for c in 0..total {
            self.starts[c + 1] += self.starts[c];
        }
        let mut next = self.starts.clone();
        self.slots = vec![0; places.len()];
        for (slot, &c) in cells.iter().enumerate() {
            self.slots[next[c as usize] as usize] = slot as u32;
            next[c as usize] += 1;
        }
    }

    fn at(&self, x: DVec3) -> [i64; 3] {
        let cell = ((x - self.low) / self.cell).to_array();
        let mut at = [0; 3];
        for axis in 0..3 {
            at[axis] = (cell[axis] as i64).clamp(0, self.counts[axis] - 1);
        }
        at
    }

    fn index(&self, at: [i64; 3]) -> u32 {
        ((at[2] * self.counts[1] + at[1]) * self.counts[0] + at[0]) as u32
    }

    /// Calls `see` with every slot in the cells around `x`, row by row.
    #[inline]
    pub(crate) fn around(&self, x: DVec3, mut see: impl FnMut(u32)) {
        let at = self.at(x);
        let span = |axis: usize| ((at[axis] - 1).max(0), (at[axis] + 1).min(self.counts[axis] - 1));
        let ((x0, x1), (y0, y1), (z0, z1)) = (span(0), span(1), span(2));
        for z in z0..=z1 {
            for y in y0..=y1 {
                let first = self.starts[self.index([x0, y, z]) as usize] as usize;
                let last = self.starts[self.index([x1, y, z]) as usize + 1] as usize;
                self.slots[first..last].iter().for_each(|&slot| see(slot));
            }
        }
    }
}
