//! The cells over which the laws' errors are known, and the bridges that stand for them.

use pendular_pair::{Bridge, Mate};

/// Ends of the cells in V*.
pub(super) const V_STAR: [f64; 9] = [1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.5];

/// Ends of the cells in the mean contact angle, degrees.
pub(super) const ANGLE: [f64; 7] = [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0];

/// Ends of the cells in the difference of the contact angles, degrees; the first cell is 0 alone.
pub(super) const DIFFERENCE: [f64; 3] = [0.0, 20.0, 60.0];

/// Ends of the cells in the radius ratio; the first cell is 1 alone, the last a plane alone.
pub(super) const RATIO: [f64; 5] = [1.0, 2.0, 5.0, 100.0, f64::INFINITY];

/// Ends of the cells in S/S_rup.
pub(super) const GAP: [f64; 7] = [0.0, 0.02, 0.25, 0.5, 0.75, 0.9, 0.98];

/// Cells along V*, mean angle, difference, ratio and gap.
pub(super) const SHAPE: [usize; 5] =
    [V_STAR.len() - 1, ANGLE.len() - 1, DIFFERENCE.len(), RATIO.len(), GAP.len() - 1];

/// Which body it is, in angles and ratio: a cell without its V* and gap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Body {
    pub(super) angle: usize,
    pub(super) difference: usize,
    pub(super) ratio: usize,
}

/// All cells of bodies, in the order of the data.
pub(super) fn bodies() -> impl Iterator<Item = Body> {
    let ratios =
        |angle, difference| (0..SHAPE[3]).map(move |ratio| Body { angle, difference, ratio });
    (0..SHAPE[1]).flat_map(move |a| (0..SHAPE[2]).flat_map(move |d| ratios(a, d)))
}

/// Place of a cell's first law in the data.
pub(super) fn offset(body: Body, volume: usize, gap: usize, laws: usize) -> usize {
    let index = (body.angle * SHAPE[2] + body.difference) * SHAPE[3] + body.ratio;
    ((index * SHAPE[0] + volume) * SHAPE[4] + gap) * laws
}

/// Cells between neighbouring `ends` that a closed range touches.
pub(super) fn touched(ends: &[f64], range: (f64, f64)) -> impl Iterator<Item = usize> {
    let touches = move |pair: &[f64]| {
        let inner = range.0 < pair[1] && range.1 > pair[0];
        let point = range.0 == range.1 && pair[0] <= range.0 && range.1 <= pair[1];
        inner || point
    };
    ends.windows(2).enumerate().filter(move |(_, pair)| touches(pair)).map(|(k, _)| k)
}

/// Cells of the radius ratio that a range touches.
pub(super) fn touched_ratios(range: (f64, f64)) -> impl Iterator<Item = usize> {
    let last = RATIO.len() - 1;
    (0..=last).filter(move |&k| match k {
        0 => range.0 <= 1.0,
        k if k == last => range.1 == f64::INFINITY,
        k => range.0 <= RATIO[k] && range.1 > RATIO[k - 1],
    })
}

/// Cells of the angles' difference up to a greatest one, degrees.
pub(super) fn touched_differences(greatest: f64) -> impl Iterator<Item = usize> {
    (0..DIFFERENCE.len()).filter(move |&k| k == 0 || greatest > DIFFERENCE[k - 1])
}

/// Places in a cell that stand for it: its ends and, in the logarithm for V*, its middle.
fn samples(low: f64, high: f64) -> [f64; 3] {
    [low, 0.5 * (low + high), high]
}

impl Body {
    /// Pairs of contact angles (rad) that stand for the cell, in both orders.
    pub(super) fn angles(self) -> Vec<[f64; 2]> {
        let top = ANGLE[ANGLE.len() - 1];
        let differences = match self.difference {
            0 => vec![0.0],
            k => {
                let (low, high) = (DIFFERENCE[k - 1], DIFFERENCE[k]);
                vec![0.5 * (low + high), -0.5 * (low + high), high, -high]
            }
        };
        let pair = |mean: f64, d: f64| [mean - 0.5 * d, mean + 0.5 * d];
        let means = samples(ANGLE[self.angle], ANGLE[self.angle + 1]);
        let all = means.iter().flat_map(|&mean| differences.iter().map(move |&d| pair(mean, d)));
        let inside = |pair: &[f64; 2]| pair.iter().all(|angle| (0.0..=top).contains(angle));
        all.filter(inside).map(|pair| pair.map(f64::to_radians)).collect()
    }

    /// Mates of a unit sphere that stand for the cell.
    pub(super) fn mates(self) -> Vec<Mate> {
        let last = RATIO.len() - 1;
        let ratios = match self.ratio {
            0 => vec![1.0],
            k if k == last => return vec![Mate::PLANE],
            k => samples(RATIO[k - 1].ln(), RATIO[k].ln()).map(f64::exp).to_vec(),
        };
        ratios.into_iter().map(|radius| Mate::Sphere { radius }).collect()
    }

    /// Bridges that stand for a cell of bodies and volume.
    pub(super) fn bridges(self, volume: usize) -> Vec<Bridge> {
        let volumes = samples(V_STAR[volume].ln(), V_STAR[volume + 1].ln()).map(f64::exp);
        // Rounding must not carry an end out of a law's range.
        let volumes = volumes
            .map(|v| v.clamp(V_STAR[volume] * (1.0 + 1e-12), V_STAR[volume + 1] * (1.0 - 1e-12)));
        let mut bridges = Vec::new();
        for mate in self.mates() {
            for angles in self.angles() {
                let unit = Bridge::new(1.0, mate, 1.0, angles, 1.0).ok();
                let scale = unit.map_or(1.0, |bridge| bridge.harmonic_radius());
                let at = |v: &f64| Bridge::new(1.0, mate, v * scale.powi(3), angles, 1.0).ok();
                bridges.extend(volumes.iter().filter_map(at));
            }
        }
        bridges
    }
}

/// Fractions of S_rup that stand for a cell of the gap.
pub(super) fn gaps(cell: usize) -> [f64; 3] {
    samples(GAP[cell], GAP[cell + 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_touch_the_cells_they_enter() {
        let cells = |range| touched(&ANGLE, range).collect::<Vec<_>>();
        assert_eq!(cells((10.0, 20.0)), [1]);
        assert_eq!(cells((9.0, 20.1)), [0, 1, 2]);
        assert_eq!(cells((0.0, 0.0)), [0]);
        assert_eq!(cells((20.0, 20.0)), [1, 2]);
        let ratios = |range| touched_ratios(range).collect::<Vec<_>>();
        assert_eq!(ratios((1.0, 1.0)), [0]);
        assert_eq!(ratios((1.0, 3.0)), [0, 1, 2]);
        assert_eq!(ratios((f64::INFINITY, f64::INFINITY)), [4]);
        assert_eq!(touched_differences(0.0).collect::<Vec<_>>(), [0]);
        assert_eq!(touched_differences(30.0).collect::<Vec<_>>(), [0, 1, 2]);
    }

    #[test]
    fn offsets_number_all_cells_without_gaps() {
        let mut all: Vec<usize> = bodies()
            .flat_map(|body| {
                let gaps = move |v| (0..SHAPE[4]).map(move |g| offset(body, v, g, 3));
                (0..SHAPE[0]).flat_map(gaps)
            })
            .collect();
        all.sort_unstable();
        let count: usize = SHAPE.iter().product();
        assert!(all.into_iter().eq((0..count).map(|k| 3 * k)));
    }

    #[test]
    fn bridges_lie_in_their_cell() {
        let body = Body { angle: 2, difference: 1, ratio: 2 };
        let bridges = body.bridges(5);
        assert_eq!(bridges.len(), 3 * 3 * 12);
        for b in bridges {
            let mean = b.mean_contact_angle().to_degrees();
            assert!((20.0 - 1e-9..=30.0 + 1e-9).contains(&mean));
            assert!((1e-3..=1e-2).contains(&b.v_star()));
            assert!((2.0 - 1e-9..=5.0 + 1e-9).contains(&b.radius_ratio()));
        }
    }
}
