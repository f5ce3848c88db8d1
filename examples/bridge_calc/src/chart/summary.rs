//! From single errors to statistics per law.

use pendular_capillary::{AnyCapillary, CapillaryLaw};

use super::grid::{GAPS, ZONES};
use super::measure::Sample;
use super::stats::Stats;

/// Which bridges of the grid are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Group {
    /// Equal contact angles, inside the law's stated range.
    Inside,
    /// Equal contact angles, outside the stated range, where the law has a value.
    Outside,
    /// Unequal contact angles, inside the stated range.
    UnequalInside,
}

impl Group {
    fn has(self, sample: &Sample, law: AnyCapillary) -> bool {
        let inside = law.validity().check(&sample.bridge).is_ok();
        match self {
            Self::Inside => sample.pair.equal && inside,
            Self::Outside => sample.pair.equal && !inside,
            Self::UnequalInside => !sample.pair.equal && inside,
        }
    }
}

/// Errors of a law's force over a group of bridges.
#[derive(Debug, Clone)]
pub(crate) struct ForceErrors {
    /// Bridges in the group.
    pub(crate) bridges: usize,
    /// Bridges for which the law has no value.
    pub(crate) refused: usize,
    /// As [`ZONES`]; `None` where the law answers no bridge.
    pub(crate) zones: [Option<Stats>; ZONES.len()],
    /// At each of [`GAPS`].
    pub(crate) gaps: [Option<Stats>; GAPS.len()],
}

impl ForceErrors {
    /// Statistics over all gaps up to 0.98 of the rupture distance.
    pub(crate) fn all(&self) -> Option<Stats> {
        self.zones[ZONES.len() - 1]
    }
}

pub(crate) fn force_errors(
    samples: &[Sample],
    index: usize,
    law: AnyCapillary,
    group: Group,
) -> ForceErrors {
    let members: Vec<&Sample> = samples.iter().filter(|s| group.has(s, law)).collect();
    let answers: Vec<&[f64; GAPS.len()]> =
        members.iter().filter_map(|sample| sample.force[index].as_ref()).collect();
    let over = |low: f64, high: f64| {
        let wanted = |share: f64| low <= share && share <= high;
        let zone = |errors: &[f64; GAPS.len()]| {
            let kept = errors.iter().zip(GAPS).filter(|(_, share)| wanted(*share));
            kept.map(|(error, _)| *error).collect::<Vec<_>>()
        };
        Stats::of(answers.iter().flat_map(|errors| zone(errors)))
    };
    ForceErrors {
        bridges: members.len(),
        refused: members.len() - answers.len(),
        zones: ZONES.map(|(_, low, high)| over(low, high)),
        gaps: GAPS.map(|share| over(share, share)),
    }
}

/// Worst error of one bridge between two shares of the rupture distance.
pub(crate) fn worst(errors: &[f64; GAPS.len()], low: f64, high: f64) -> f64 {
    let kept = errors.iter().zip(GAPS).filter(|(_, share)| (low..=high).contains(share));
    kept.fold(0.0, |worst, (error, _)| worst.max(*error))
}

/// Groups of bridges over which rupture laws and transfer methods are compared: V* from 1e-4 to 0.1
/// and angles up to 50°.
pub(crate) const BODIES: [(&str, f64, f64); 4] = [
    ("equal spheres", 1.0, 1.0),
    ("ratio 1.2 to 5", 1.2, 5.0),
    ("ratio 10 to 100", 10.0, 100.0),
    ("sphere and plane", f64::INFINITY, f64::INFINITY),
];

/// The samples of one of [`BODIES`], with equal or unequal angles.
pub(crate) fn bodies(
    samples: &[Sample],
    ratios: (f64, f64),
    equal: bool,
) -> impl Iterator<Item = &Sample> + Clone {
    samples.iter().filter(move |s| {
        let v_star = s.bridge.v_star();
        s.pair.equal == equal
            && (ratios.0..=ratios.1).contains(&s.pair.ratio)
            && s.pair.degrees().iter().all(|angle| *angle <= 50.0)
            && (0.999e-4..=0.1001).contains(&v_star)
    })
}

/// Where a law's error map is drawn: equal spheres, or a plane for a law that knows only that.
pub(crate) fn map_ratio(law: AnyCapillary) -> f64 {
    law.validity().radius_ratio.0
}
