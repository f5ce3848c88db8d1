//! One line of a map: a scene with its parameters, run over time steps.

use crate::column::Column;
use crate::edge::Edge;
use crate::plain::Damper;
use crate::rig::{Drag, Fault, Film, Matter};
use crate::{chain, column, impact, pair, plain};

/// Multiples of the predicted limit that the small scenes are run at.
const STEPS: [f64; 16] =
    [0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 0.95, 1.1, 1.25, 1.4, 1.6, 1.8, 2.1, 2.5, 3.0];
/// The same for the column, and with `--quick`.
const FEW: [f64; 8] = [0.2, 0.5, 0.8, 1.0, 1.25, 1.5, 2.0, 3.0];

/// The scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Two dry spheres meet once.
    Impact,
    /// Two spheres bounce in the well of their bridge.
    Pair,
    /// A sphere runs into two that touch.
    Chain,
    /// A thousand wet spheres in a square pipe.
    Column,
}

impl Kind {
    pub(crate) const ALL: [Self; 4] = [Self::Impact, Self::Pair, Self::Chain, Self::Column];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Impact => "impact",
            Self::Pair => "pair",
            Self::Chain => "chain",
            Self::Column => "column",
        }
    }
}

/// How a scene is integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Integrator {
    /// The core's leapfrog, dashpot and drag of half a step before.
    Leapfrog,
    /// One contact along a line, here in this program, with another reading of the dashpot.
    Plain(Damper),
}

impl Integrator {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Leapfrog => "leapfrog",
            Self::Plain(Damper::Lagged) => "plain",
            Self::Plain(Damper::Extrapolated) => "extrapolated",
            Self::Plain(Damper::Mean) => "semi-implicit",
        }
    }
}

/// A scene with its parameters.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Case {
    pub(crate) kind: Kind,
    pub(crate) integrator: Integrator,
    pub(crate) matter: Matter,
}

/// What a run at one time step came to.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Outcome {
    /// Energy that came from nowhere, over the energy that there is: see each scene.
    pub(crate) error: f64,
    /// The final state in one number: see each scene.
    pub(crate) state: f64,
}

/// One time step of a line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Point {
    /// Time step over predicted limit.
    pub(crate) share: f64,
    /// Whether a disturbance stays small at that step.
    pub(crate) stable: bool,
    pub(crate) outcome: Outcome,
}

/// A line of a map.
#[derive(Debug, Clone)]
pub(crate) struct Line {
    pub(crate) case: Case,
    pub(crate) edge: Edge,
    pub(crate) points: Vec<Point>,
}

impl Line {
    /// Whether the prediction is meant for this line and, if so, holds.
    pub(crate) fn verdict(&self) -> Option<bool> {
        (self.case.integrator == Integrator::Leapfrog).then(|| self.edge.holds())
    }
}

impl Case {
    /// Viscosity, Pa s; 0 without liquid.
    pub(crate) fn viscosity(&self) -> f64 {
        self.matter.liquid.map_or(0.0, |film| film.viscosity)
    }

    /// Finds the edge and runs all steps.
    pub(crate) fn run(&self, column: &Column, quick: bool) -> Result<Line, Fault> {
        let matter = &self.matter;
        let (edge, bed) = match (self.kind, self.integrator) {
            (Kind::Impact, Integrator::Leapfrog) => (impact::edge(matter)?, None),
            (Kind::Impact, Integrator::Plain(damper)) => (plain::edge(matter, damper)?, None),
            (Kind::Pair, _) => (pair::edge(matter)?, None),
            (Kind::Chain, _) => (chain::edge(matter)?, None),
            (Kind::Column, _) => {
                let bed = column.relaxed(matter)?;
                (column::edge(&bed, matter)?, Some(bed))
            }
        };
        let shares: &[f64] = if quick || bed.is_some() { &FEW } else { &STEPS };
        let one = |&share: &f64| -> Result<Point, Fault> {
            let h = share * edge.limit;
            let outcome = match (self.kind, self.integrator) {
                (Kind::Impact, Integrator::Leapfrog) => impact::run(matter, h)?,
                (Kind::Impact, Integrator::Plain(damper)) => plain::run(matter, damper, h)?,
                (Kind::Pair, _) => pair::run(matter, h, edge.limit)?,
                (Kind::Chain, _) => chain::run(matter, h, edge.limit)?,
                (Kind::Column, _) => match &bed {
                    Some(bed) => column::run(bed, matter, h, edge.limit)?,
                    None => Outcome::default(),
                },
            };
            Ok(Point { share, stable: h <= edge.edge, outcome })
        };
        let points = shares.iter().map(one).collect::<Result<_, _>>()?;
        Ok(Line { case: *self, edge, points })
    }
}

/// All lines of the four maps; a few with `quick`.
pub(crate) fn all(quick: bool) -> Vec<Case> {
    let mut cases = impacts(quick);
    let viscosities: &[f64] = if quick { &[1e-3, 1.0] } else { &[1e-3, 0.1, 1.0, 10.0] };
    let stiffnesses: &[f64] = if quick { &[1e4] } else { &[1e3, 1e5] };
    let restitutions: &[f64] = if quick { &[0.8] } else { &[0.9, 0.3] };
    for kind in [Kind::Pair, Kind::Chain] {
        for &k in stiffnesses {
            for &e in restitutions {
                cases.extend(viscosities.iter().map(|&v| wet(kind, Drag::Explicit, k, e, v)));
            }
        }
        let viscous = &viscosities[viscosities.len().saturating_sub(2)..];
        cases.extend(viscous.iter().map(|&v| wet(kind, Drag::Implicit, 1e5, 0.9, v)));
    }
    let beds: &[(Drag, f64, f64, f64)] = if quick {
        &[(Drag::Explicit, 1e4, 0.8, 1e-3)]
    } else {
        &[
            (Drag::Explicit, 1e4, 0.9, 1e-3),
            (Drag::Explicit, 1e4, 0.3, 1e-3),
            (Drag::Explicit, 1e5, 0.9, 1e-3),
            (Drag::Explicit, 1e5, 0.3, 1e-3),
            (Drag::Explicit, 1e4, 0.9, 0.1),
            (Drag::Explicit, 1e5, 0.9, 0.1),
            (Drag::Explicit, 1e4, 0.9, 1.0),
            (Drag::Explicit, 1e5, 0.3, 10.0),
            (Drag::Implicit, 1e5, 0.9, 10.0),
        ]
    };
    cases.extend(beds.iter().map(|&(drag, k, e, v)| wet(Kind::Column, drag, k, e, v)));
    cases
}

fn wet(kind: Kind, drag: Drag, stiffness: f64, restitution: f64, viscosity: f64) -> Case {
    let liquid = Some(Film::thin(viscosity));
    let matter = Matter { stiffness, restitution, liquid, drag };
    Case { kind, integrator: Integrator::Leapfrog, matter }
}

fn impacts(quick: bool) -> Vec<Case> {
    let restitutions: &[f64] = if quick { &[0.5] } else { &[0.98, 0.8, 0.5, 0.2, 0.05] };
    let one = |integrator, drag, stiffness, restitution| {
        let matter = Matter { stiffness, restitution, liquid: None, drag };
        Case { kind: Kind::Impact, integrator, matter }
    };
    let mut cases = Vec::new();
    let mut add = |integrator, drag, stiffness| {
        cases.extend(restitutions.iter().map(|&e| one(integrator, drag, stiffness, e)));
    };
    for &stiffness in if quick { &[1e5][..] } else { &[1e3, 1e5] } {
        add(Integrator::Leapfrog, Drag::Explicit, stiffness);
    }
    add(Integrator::Leapfrog, Drag::Implicit, 1e5);
    for damper in [Damper::Extrapolated, Damper::Mean] {
        add(Integrator::Plain(damper), Drag::Explicit, 1e5);
    }
    cases
}
