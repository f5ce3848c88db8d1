//! What is written as numbers.

use std::path::Path;

use crate::case::{Kind, Line};
use crate::rig::Fault;
use crate::runs::{self, Run};

fn number(value: f64) -> String {
    format!("{value:.6e}")
}

fn parameters(line: &Line) -> Vec<String> {
    let case = &line.case;
    vec![
        case.integrator.name().into(),
        case.matter.drag.name().into(),
        format!("{:e}", case.matter.stiffness),
        case.matter.restitution.to_string(),
        case.viscosity().to_string(),
    ]
}

/// A scene's map: a row per line and time step.
pub(crate) fn map(path: &Path, kind: Kind, lines: &[Line]) -> Result<(), Fault> {
    let mut out = csv::Writer::from_path(path)?;
    out.write_record([
        "integrator",
        "drag",
        "stiffness_N_per_m",
        "restitution",
        "viscosity_Pa_s",
        "step_over_limit",
        "time_step_s",
        "stable",
        "energy_error",
        "final_state",
    ])?;
    for line in lines.iter().filter(|line| line.case.kind == kind) {
        for point in &line.points {
            let mut row = parameters(line);
            row.push(point.share.to_string());
            row.push(number(point.share * line.edge.limit));
            row.push(point.stable.to_string());
            row.extend([number(point.outcome.error), number(point.outcome.state)]);
            out.write_record(row)?;
        }
    }
    Ok(out.flush()?)
}

/// Limit and edge of every line.
pub(crate) fn summary(path: &Path, lines: &[Line]) -> Result<(), Fault> {
    let mut out = csv::Writer::from_path(path)?;
    out.write_record([
        "scene",
        "integrator",
        "drag",
        "stiffness_N_per_m",
        "restitution",
        "viscosity_Pa_s",
        "set_by",
        "limit_s",
        "limit_before_the_run_s",
        "edge_s",
        "edge_over_limit",
        "holds",
    ])?;
    for line in lines {
        let edge = &line.edge;
        let mut row = vec![line.case.kind.name().to_string()];
        row.extend(parameters(line));
        row.push(edge.term.into());
        row.extend([edge.limit, edge.packed, edge.edge].map(number));
        row.push(format!("{:.3}", edge.edge / edge.limit));
        row.push(line.verdict().map_or("not ours".into(), |holds| holds.to_string()));
        out.write_record(row)?;
    }
    Ok(out.flush()?)
}

/// Whole runs with their errors and costs.
pub(crate) fn runs(path: &Path, runs: &[Run]) -> Result<(), Fault> {
    let truth = runs::truth(runs);
    let mut out = csv::Writer::from_path(path)?;
    out.write_record([
        "changed",
        "to",
        "drag",
        "step_over_limit",
        "law",
        "wire_sides",
        "processor_time_s",
        "undersize_retained",
        "liquid_on_walls",
        "restitution_on_a_wire",
        "error_retained",
        "error_on_walls",
        "error_restitution",
    ])?;
    for run in runs {
        let way = &run.way;
        let mut row = vec![run.axis.name().to_string(), run.label(), way.drag.name().into()];
        row.extend([way.share.to_string(), way.law.name().into()]);
        row.push(way.sides.map_or("round".into(), |n| n.to_string()));
        row.push(format!("{:.3}", run.found.cost));
        row.extend(run.values().map(number));
        row.extend([0, 1, 2].map(|k| number((run.values()[k] - truth[k].0).abs())));
        out.write_record(row)?;
    }
    Ok(out.flush()?)
}
