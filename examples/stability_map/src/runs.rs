//! Accuracy against speed of whole runs: one thing changed at a time.

use pendular::capillary::AnyCapillary;

use crate::rig::{Drag, Fault};
use crate::screen::{self, Screened, Way};

/// What is changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Axis {
    /// The reference and its repetitions with a step up to 2 % shorter.
    Reference,
    /// The time step.
    Step,
    /// The capillary law.
    Law,
    /// The wires.
    Wires,
    /// The drag.
    Drag,
}

impl Axis {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Reference => "reference",
            Self::Step => "time step",
            Self::Law => "law",
            Self::Wires => "wires",
            Self::Drag => "drag",
        }
    }
}

/// One run.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run {
    pub(crate) axis: Axis,
    pub(crate) way: Way,
    pub(crate) found: Screened,
}

/// The three quantities of a run, in the order of the chart's panels.
pub(crate) const QUANTITIES: [&str; 3] =
    ["undersize retained", "liquid on walls", "restitution on a wire"];

impl Run {
    pub(crate) fn values(&self) -> [f64; 3] {
        [self.found.retained, self.found.on_walls, self.found.restitution]
    }

    /// What was changed, in a word.
    pub(crate) fn label(&self) -> String {
        match self.axis {
            Axis::Reference => "reference".into(),
            Axis::Step => format!("{:.2} of the limit", self.way.share),
            Axis::Law => self.way.law.name().into(),
            Axis::Drag => format!("{} at {}", self.way.drag.name(), self.way.share),
            Axis::Wires => self.way.sides.map_or("cylinder".into(), |n| format!("{n} sides")),
        }
    }
}

/// The runs to do: reference first. All take the exact bridge from its table, whose error is far
/// below their scatter; it is solved anew for every bridge in one of them.
pub(crate) fn plan(quick: bool) -> Vec<(Axis, Way)> {
    let finest = if quick { 0.5 } else { 0.1 };
    let reference =
        Way { share: finest, law: AnyCapillary::Tabulated, sides: None, drag: Drag::Explicit };
    let usual = Way { share: 0.5, law: AnyCapillary::Tabulated, sides: None, drag: Drag::Explicit };
    let mut all: Vec<_> = [1.0, 0.99, 0.98]
        .map(|by| (Axis::Reference, Way { share: by * finest, ..reference }))
        .to_vec();
    let steps: &[f64] = if quick { &[1.0] } else { &[1.0, 0.7, 0.5, 0.35, 0.2] };
    all.extend(steps.iter().map(|&share| (Axis::Step, Way { share, ..usual })));
    let laws = [
        AnyCapillary::YoungLaplace,
        AnyCapillary::WillettFull,
        AnyCapillary::WillettReduced,
        AnyCapillary::Lambert,
    ];
    let laws = &laws[if quick { 3 } else { 0 }..];
    all.extend(laws.iter().map(|&law| (Axis::Law, Way { law, ..usual })));
    let sides: &[u32] = if quick { &[8] } else { &[8, 16, 32] };
    all.extend(sides.iter().map(|&n| (Axis::Wires, Way { sides: Some(n), ..usual })));
    let shares: &[f64] = if quick { &[1.0] } else { &[0.5, 1.0] };
    let implicit = |&share: &f64| (Axis::Drag, Way { share, drag: Drag::Implicit, ..usual });
    all.extend(shares.iter().map(implicit));
    all
}

/// Does one of them.
pub(crate) fn run(axis: Axis, way: &Way, quick: bool) -> Result<Run, Fault> {
    let time = if quick { 0.03 } else { 0.4 };
    Ok(Run { axis, way: *way, found: screen::run(way, time)? })
}

/// Mean of the references and their largest deviation from it, for each quantity.
pub(crate) fn truth(runs: &[Run]) -> [(f64, f64); 3] {
    let all: Vec<_> = runs.iter().filter(|run| run.axis == Axis::Reference).collect();
    [0, 1, 2].map(|k| {
        let mean = all.iter().map(|run| run.values()[k]).sum::<f64>() / all.len() as f64;
        let most = all.iter().map(|run| (run.values()[k] - mean).abs()).fold(0.0, f64::max);
        (mean, most)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_truth_is_the_mean_of_the_references_with_their_scatter() {
        let way = Way { share: 0.1, law: AnyCapillary::Lambert, sides: None, drag: Drag::Explicit };
        let run = |axis, retained| {
            let found = Screened { retained, ..Screened::default() };
            Run { axis, way, found }
        };
        let runs = [
            run(Axis::Reference, 0.5),
            run(Axis::Reference, 0.6),
            run(Axis::Reference, 0.4),
            run(Axis::Step, 9.0),
        ];
        let (mean, most) = truth(&runs)[0];
        assert!((mean - 0.5).abs() < 1e-15 && (most - 0.1).abs() < 1e-15);
    }

    #[test]
    fn one_thing_is_changed_at_a_time() {
        let all = plan(false);
        let usual =
            Way { share: 0.5, law: AnyCapillary::Tabulated, sides: None, drag: Drag::Explicit };
        for (axis, way) in all.iter().filter(|(axis, _)| *axis != Axis::Reference) {
            let same = [
                matches!(axis, Axis::Step | Axis::Drag) || way.share == usual.share,
                *axis == Axis::Law || way.law == usual.law,
                *axis == Axis::Wires || way.sides.is_none(),
                *axis == Axis::Drag || way.drag == Drag::Explicit,
            ];
            assert!(same.iter().all(|s| *s), "{axis:?} {way:?}");
        }
    }
}
