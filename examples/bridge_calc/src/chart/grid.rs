//! The bridges on which the laws are measured.

use pendular_capillary::{Bridge, Mate, OutOfRange};

/// Shares of the exact rupture distance at which forces are compared.
pub(crate) const GAPS: [f64; 19] = [
    0.0, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.7, 0.8, 0.9, 0.94, 0.96, 0.98, 0.99,
    0.999, 0.999_999,
];

/// Where the statistics end: beyond, the exact force falls with infinite slope.
pub(crate) const LAST: f64 = 0.98;

/// A zone of gaps, by its name and the shares of the rupture distance that it spans.
pub(crate) const ZONES: [(&str, f64, f64); 4] =
    [("contact", 0.0, 0.05), ("middle", 0.1, 0.8), ("rupture", 0.9, LAST), ("all", 0.0, LAST)];

/// Radius ratios with equal contact angles; infinity is a plane.
const RATIOS: [f64; 12] =
    [1.0, 1.01, 1.05, 1.2, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0, f64::INFINITY];

/// Radius ratios with unequal contact angles.
const UNEQUAL_RATIOS: [f64; 9] = [1.0, 1.2, 1.5, 2.0, 3.0, 5.0, 10.0, 100.0, f64::INFINITY];

/// Greatest V* of the grid.
const MOST: f64 = 0.5;

/// Two bodies and all volumes that are measured between them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pair {
    /// Larger over smaller radius, infinity against a plane. Body 1 is the smaller one.
    pub(crate) ratio: f64,
    /// Places of the two angles on their axis, in [`Pair::step`] of degrees.
    pub(crate) places: [usize; 2],
    /// Whether the pair belongs to the part of the grid where both angles are equal.
    pub(crate) equal: bool,
}

impl Pair {
    /// Degrees from one place of the angles' axis to the next.
    fn step(&self) -> f64 {
        if self.equal { 5.0 } else { 7.5 }
    }

    /// Volumes from one decade of V* to the next.
    fn per_decade(&self) -> usize {
        if self.equal { 6 } else { 3 }
    }

    /// Contact angles, degrees.
    pub(crate) fn degrees(&self) -> [f64; 2] {
        self.places.map(|place| place as f64 * self.step())
    }

    /// V* of the pair's bridges: 1e-6 to 0.5.
    pub(crate) fn volumes(&self) -> Vec<f64> {
        let many = self.per_decade();
        let below = |k: usize| 10f64.powf(k as f64 / many as f64 - 6.0);
        let mut all: Vec<f64> = (0..).map(below).take_while(|v| *v < 0.99 * MOST).collect();
        all.push(MOST);
        all
    }

    /// The bridge of a volume between bodies of about a millimetre, with the tension of water.
    pub(crate) fn bridge(&self, v_star: f64) -> Result<Bridge, OutOfRange> {
        let mate = if self.ratio == f64::INFINITY {
            Mate::PLANE
        } else {
            Mate::Sphere { radius: self.ratio * 1e-3 }
        };
        let angles = self.degrees().map(f64::to_radians);
        let unit = Bridge::new(1e-3, mate, 1.0, angles, 0.07275)?;
        Bridge::new(1e-3, mate, v_star * unit.harmonic_radius().powi(3), angles, 0.07275)
    }
}

/// All pairs: equal angles of 0° to 60° in steps of 5°, unequal ones in steps of 7.5°.
pub(crate) fn pairs() -> Vec<Pair> {
    let equal = RATIOS.into_iter().flat_map(|ratio| {
        (0..=12).map(move |place| Pair { ratio, places: [place; 2], equal: true })
    });
    let unequal = UNEQUAL_RATIOS.into_iter().flat_map(|ratio| {
        let places = (0..=8).flat_map(|first| (0..=8).map(move |second| [first, second]));
        // Equal spheres are the same from both sides.
        let wanted = move |p: &[usize; 2]| if ratio == 1.0 { p[0] < p[1] } else { p[0] != p[1] };
        places.filter(wanted).map(move |places| Pair { ratio, places, equal: false })
    });
    equal.chain(unequal).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_is_what_the_docs_say() {
        let all = pairs();
        let equal: Vec<&Pair> = all.iter().filter(|pair| pair.equal).collect();
        assert_eq!((equal.len(), all.len() - equal.len()), (12 * 13, 8 * 72 + 36));
        assert_eq!(equal[0].volumes().len(), 36);
        assert_eq!(all[all.len() - 1].volumes().len(), 19);
        assert_eq!(equal[12].degrees(), [60.0; 2]);
        let bridge = equal[13].bridge(0.01).unwrap();
        assert!((bridge.v_star() - 0.01).abs() < 1e-15 && bridge.radius_ratio() == 1.01);
    }
}
