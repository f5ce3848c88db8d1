//! Where the particles are at the start: placed at random without overlap, or read from a file.

use std::collections::BTreeSet;
use std::path::Path;

use glam::DVec3;
use rand_pcg::Pcg64;
use rand_pcg::rand_core::{Rng, SeedableRng};

use crate::error::SceneError;

/// A particle to be: its index of class, and its centre, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Placed {
    pub(crate) class: u16,
    pub(crate) position: DVec3,
}

/// The upright cylinder to be filled.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Space {
    /// Radius of the cylinder, m.
    pub(crate) radius: f64,
    /// Lowest point that a particle may reach, m.
    pub(crate) bottom: f64,
    /// Highest point that a particle may reach, m.
    pub(crate) top: f64,
    /// Share of the space to be filled.
    pub(crate) solid_fraction: f64,
}

/// Tries for each particle before the space is made a little higher.
const TRIES: usize = 2_000;
/// Cells of the grid that finds neighbours, at most.
const MOST_CELLS: f64 = 1e7;
/// Gap kept between particles, as a share of the smallest radius.
const APART: f64 = 1e-3;

/// Places `counts[k]` spheres of `radii[k]` at random, the largest first.
///
/// The space is filled from its bottom up to the solid fraction asked for; where that is too dense
/// for random placing the filling grows higher. The same seed gives the same packing everywhere.
pub(crate) fn random(
    radii: &[f64],
    counts: &[u64],
    space: &Space,
    seed: u64,
) -> Result<Vec<Placed>, SceneError> {
    let volume: f64 = radii
        .iter()
        .zip(counts)
        .map(|(r, &n)| n as f64 * 4.0 / 3.0 * std::f64::consts::PI * r.powi(3))
        .sum();
    let largest = radii.iter().fold(0.0_f64, |m, &r| m.max(r));
    let area = std::f64::consts::PI * space.radius.powi(2);
    let mut height = (volume / (area * space.solid_fraction)).max(2.5 * largest);
    let mut order: Vec<usize> = (0..radii.len()).collect();
    order.sort_by(|&a, &b| radii[b].total_cmp(&radii[a]).then(a.cmp(&b)));
    while space.bottom + height <= space.top {
        let mut random = Pcg64::seed_from_u64(seed);
        if let Some(placed) = fill(radii, counts, &order, space, height, &mut random) {
            return Ok(placed);
        }
        height *= 1.05;
    }
    let (have, need) = (space.top - space.bottom, height);
    let message = format!(
        "{have:.4} m of height are there, {need:.4} m are needed: raise screen.height_mm or \
         packing.solid_fraction (at most 0.35), or take fewer particles"
    );
    Err(SceneError::Packing { message })
}

fn fill(
    radii: &[f64],
    counts: &[u64],
    order: &[usize],
    space: &Space,
    height: f64,
    random: &mut Pcg64,
) -> Option<Vec<Placed>> {
    let largest = radii.iter().fold(0.0_f64, |m, &r| m.max(r));
    let apart = APART * radii.iter().fold(f64::INFINITY, |m, &r| m.min(r));
    let mut cells = Cells::new(space.radius, height, 2.0 * largest + apart);
    let mut placed = Vec::new();
    for &class in order {
        let r = radii[class];
        for _ in 0..counts[class] {
            let found = (0..TRIES).find_map(|_| {
                let x = point(random, space.radius - r - apart, height - 2.0 * r)?;
                let x = x + DVec3::Z * r;
                cells.is_free(x, r + apart, &placed, radii).then_some(x)
            })?;
            cells.insert(found, placed.len());
            placed.push(Placed { class: class as u16, position: found });
        }
    }
    for one in &mut placed {
        one.position.z += space.bottom;
    }
    Some(placed)
}

/// A point in a cylinder of the given radius and height; `None` if it has none.
fn point(random: &mut Pcg64, radius: f64, height: f64) -> Option<DVec3> {
    if !(radius > 0.0 && height > 0.0) {
        return None;
    }
    loop {
        let (x, y) = (2.0 * uniform(random) - 1.0, 2.0 * uniform(random) - 1.0);
        if x * x + y * y <= 1.0 {
            return Some(DVec3::new(radius * x, radius * y, height * uniform(random)));
        }
    }
}

/// Uniform in [0, 1): our own 53 bits, so that a seed means the same with every library version.
fn uniform(random: &mut Pcg64) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// A grid that finds what lies near a point.
struct Cells {
    low: f64,
    size: f64,
    counts: [usize; 3],
    held: Vec<Vec<usize>>,
}

impl Cells {
    fn new(radius: f64, height: f64, size: f64) -> Self {
        let along = |length: f64, size: f64| (length / size).ceil() + 1.0;
        let mut size = size;
        // Coarse cells find the same: a few small spheres in a wide frame would fill the memory.
        while along(2.0 * radius, size).powi(2) * along(height, size) > MOST_CELLS {
            size *= 2.0;
        }
        let across = along(2.0 * radius, size) as usize;
        let counts = [across, across, along(height, size) as usize];
        let held = vec![Vec::new(); counts.iter().product()];
        Self { low: -radius, size, counts, held }
    }

    fn at(&self, x: DVec3) -> [usize; 3] {
        let cell = [x.x - self.low, x.y - self.low, x.z].map(|v| (v / self.size) as usize);
        [0, 1, 2].map(|axis| cell[axis].min(self.counts[axis] - 1))
    }

    fn index(&self, at: [usize; 3]) -> usize {
        (at[2] * self.counts[1] + at[1]) * self.counts[0] + at[0]
    }

    fn insert(&mut self, x: DVec3, k: usize) {
        let index = self.index(self.at(x));
        self.held[index].push(k);
    }

    fn is_free(&self, x: DVec3, r: f64, placed: &[Placed], radii: &[f64]) -> bool {
        let at = self.at(x);
        let span =
            |axis: usize| at[axis].saturating_sub(1)..=(at[axis] + 1).min(self.counts[axis] - 1);
        for cz in span(2) {
            for cy in span(1) {
                for cx in span(0) {
                    for &k in &self.held[self.index([cx, cy, cz])] {
                        let reach = r + radii[usize::from(placed[k].class)];
                        if (placed[k].position - x).length_squared() < reach * reach {
                            return false;
                        }
                    }
                }
            }
        }
        true
    }
}

/// Reads `id,x,y,z,radius,density` and gives each particle the class of its radius and density.
pub(crate) fn from_file(
    path: &Path,
    radii: &[f64],
    densities: &[f64],
) -> Result<Vec<Placed>, SceneError> {
    let file = path.to_path_buf();
    let fail = |line: u64, message: String| SceneError::Csv { file: file.clone(), line, message };
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_path(path)
        .map_err(|e| fail(1, e.to_string()))?;
    let header = reader.headers().map_err(|e| fail(1, e.to_string()))?.clone();
    let wanted = ["id", "x", "y", "z", "radius", "density"];
    if header.iter().ne(wanted) {
        let found = header.iter().collect::<Vec<_>>().join(",");
        return Err(fail(1, format!("the header is `{found}`, it must be `{}`", wanted.join(","))));
    }
    let (mut placed, mut ids) = (Vec::new(), BTreeSet::new());
    for record in reader.records() {
        let record = record.map_err(|e| {
            let line = e.position().map_or(0, csv::Position::line);
            fail(line, e.to_string())
        })?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |k: usize| {
            let text = record.get(k).unwrap_or("");
            let value = text.parse::<f64>().ok().filter(|v| v.is_finite());
            value.ok_or_else(|| fail(line, format!("{} = `{text}` is no finite number", wanted[k])))
        };
        let id = record.get(0).unwrap_or("");
        if !ids.insert(id.to_owned()) {
            return Err(fail(line, format!("id {id} is there twice; allowed: an id of its own")));
        }
        let position = DVec3::new(number(1)?, number(2)?, number(3)?);
        let (radius, density) = (number(4)?, number(5)?);
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b;
        let class = (0..radii.len())
            .find(|&k| close(radius, radii[k]) && close(density, densities[k]))
            .ok_or_else(|| {
                let known: Vec<_> = radii
                    .iter()
                    .zip(densities)
                    .map(|(r, d)| format!("{r} m with {d} kg/m3"))
                    .collect();
                let message = format!(
                    "no class has radius {radius} m and density {density} kg/m3; classes: {}",
                    known.join(", ")
                );
                fail(line, message)
            })?;
        placed.push(Placed { class: class as u16, position });
    }
    Ok(placed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn space(top: f64) -> Space {
        Space { radius: 0.05, bottom: 0.003, top, solid_fraction: 0.3 }
    }

    #[test]
    fn nothing_overlaps_and_all_are_inside() {
        let (radii, counts) = ([1.5e-3, 2.5e-3, 5e-3], [300, 100, 30]);
        let placed = random(&radii, &counts, &space(0.2), 7).unwrap();
        assert_eq!(placed.len(), 430);
        for (k, a) in placed.iter().enumerate() {
            let r = radii[usize::from(a.class)];
            assert!(a.position.truncate().length() + r <= 0.05);
            assert!(a.position.z - r >= 0.003 - 1e-12);
            for b in &placed[..k] {
                let distance = (a.position - b.position).length();
                assert!(distance > r + radii[usize::from(b.class)]);
            }
        }
    }

    #[test]
    fn a_seed_is_a_packing() {
        let (radii, counts) = ([2e-3], [200]);
        let one = random(&radii, &counts, &space(0.1), 1).unwrap();
        assert_eq!(one, random(&radii, &counts, &space(0.1), 1).unwrap());
        assert_ne!(one, random(&radii, &counts, &space(0.1), 2).unwrap());
    }

    #[test]
    fn a_few_small_spheres_in_a_wide_space_need_no_more_memory() {
        let wide = Space { radius: 10.0, ..space(0.1) };
        assert_eq!(random(&[1e-6], &[20], &wide, 1).unwrap().len(), 20);
    }

    #[test]
    fn too_many_say_how_much_height_they_need() {
        let error = random(&[5e-3], &[10_000], &space(0.1), 1).unwrap_err();
        assert!(error.to_string().contains("screen.height_mm"), "{error}");
    }
}
