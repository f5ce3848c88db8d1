//! What a run says before and after: header, final table, summary.json.

use std::path::Path;

use serde_json::json;

use crate::assumed;
use crate::budget;
use crate::build::{Built, Derived};
use crate::error::RunError;
use crate::guard::Guard;
use crate::replace::replace;
use crate::run::Outcome;
use crate::scene::{Drag, Scene, WireKind};
use crate::screening::partition;
use crate::tables::{groups, retained};
use crate::tally::{Tally, wall_speed};

/// What the run is about to do, with the numbers that follow from the scene.
pub(crate) fn header(scene: &Scene, built: &Built) -> String {
    let mut text = format!("{}\n", scene.title);
    let derived = &built.derived;
    for (k, class) in scene.classes.iter().enumerate() {
        let (count, mass) = (derived.counts[k], derived.masses[k]);
        text += &format!(
            "  {:<12} {:>6} spheres of {} mm, {:.1} g\n",
            class.name,
            count,
            class.diameter_mm,
            1e3 * count as f64 * mass
        );
    }
    let screen = &scene.screen;
    let wires = match screen.wires {
        WireKind::Cylinders => "exact cylinders".to_owned(),
        WireKind::Mesh => format!("prisms of {} sides", screen.wire_sides),
    };
    text += &format!(
        "  screen       a = {} mm, w = {} mm, diameter {} mm, wires as {wires}\n",
        screen.aperture_mm, screen.wire_diameter_mm, screen.diameter_mm
    );
    for term in scene.motion.all() {
        let (frequency, amplitude) = (term.frequency, term.amplitude_mm);
        text += &format!("  motion       {frequency} Hz, amplitude {amplitude:?} mm\n");
    }
    text += &format!("               at most {:.3} m/s\n", wall_speed(&built.walls));
    match &scene.liquid {
        None => text += "  liquid       none: a dry run\n",
        Some(liquid) => {
            text += &format!(
                "  liquid       {} % of the dry mass, {:.3} ml: a film of {:.1} um on every sphere\n  laws         capillary {}, normal drag {}, tangential drag {}, rupture {}\n  drag         {}\n",
                liquid.moisture_percent,
                1e6 * derived.liquid,
                1e6 * derived.film,
                liquid.capillary,
                liquid.normal_drag,
                liquid.tangential_drag,
                liquid.rupture,
                drag(liquid.drag, derived.implicit)
            );
        }
    }
    let guard = Guard::new(scene, &built.walls, &[]);
    text += &format!(
        "  guard        stops at an overlap of {} % of a radius or a speed of {:.2} m/s\n",
        100.0 * scene.guard.overlap_share,
        guard.speed()
    );
    for (key, value) in assumed::list(scene) {
        text += &format!("  assumed      {key} = {value}\n");
    }
    text += &crate::notes::text(scene, built);
    let time_step = built.settings.time_step;
    let steps = (scene.time / time_step).round();
    text += &format!("  time step    {time_step:.3e} s, {steps} steps to t = {} s", scene.time);
    text
}

/// How the drags enter the step, and why.
fn drag(asked: Drag, implicit: bool) -> &'static str {
    match (asked, implicit) {
        (Drag::Auto, true) => {
            "implicit: explicit drags would need a shorter step than the contacts"
        }
        (Drag::Auto, false) => "explicit: drags allow as long a step as the contacts",
        (_, true) => "implicit, as asked for",
        (_, false) => "explicit, as asked for",
    }
}

/// Fractions retained, total and by class.
pub(crate) fn retained_at_end(
    scene: &Scene,
    derived: &Derived,
    outcome: &Outcome,
) -> (f64, Vec<f64>) {
    let density = scene.liquid.as_ref().map_or(0.0, |liquid| liquid.density);
    retained(&outcome.tally, &outcome.start, &derived.masses, density)
}

/// The final table.
pub(crate) fn table(scene: &Scene, derived: &Derived, outcome: &Outcome) -> String {
    let (total, classes) = retained_at_end(scene, derived, outcome);
    let tally = &outcome.tally;
    let mut text = format!("after {:.3} s\n", tally.time);
    text += "  class          start   above  collected  fraction retained\n";
    for (k, class) in scene.classes.iter().enumerate() {
        text += &format!(
            "  {:<12} {:>7} {:>7} {:>10}  {:.4}\n",
            class.name, derived.counts[k], tally.above[k], tally.collected[k], classes[k]
        );
    }
    let sum = |v: &[u64]| v.iter().sum::<u64>();
    text += &format!(
        "  {:<12} {:>7} {:>7} {:>10}  {total:.4}\n",
        "all",
        sum(&derived.counts),
        sum(&tally.above),
        sum(&tally.collected)
    );
    if tally.lost() > 0 {
        text += &format!(
            "  {} spheres escaped: they left in another way than into the collecting bin and count as \
             retained\n",
            tally.lost()
        );
    }
    if scene.liquid.is_some() {
        let ul = |volume: f64| 1e9 * volume;
        text += &format!(
            "  liquid [ul]: {:.1} on spheres not collected, {:.1} on fines, {:.1} on walls, {:.1} in {} bridges\n",
            ul(tally.film.iter().sum()),
            ul(tally.fines.iter().sum()),
            ul(tally.parts.iter().sum()),
            ul(tally.bridges),
            tally.alive()
        );
        text += &format!(
            "  {} bridges formed, {} outside a law's range; liquid imbalance {:.1e}\n",
            tally.counts.formed, tally.counts.extrapolated, tally.imbalance
        );
    }
    text += &budget::text(&outcome.budget, tally.capillary_loss);
    if outcome.passes.at_most > 0 {
        text += &format!(
            "  {} of {} steps with implicit drags stopped at the most passes, short of \
             liquid.drag_tolerance\n",
            outcome.passes.at_most, outcome.passes.steps
        );
    }
    let seconds = outcome.wall_time.as_secs_f64();
    text += &format!(
        "  {} steps in {seconds:.1} s of wall time; largest overlap {:.2} % of a radius\n  {}",
        outcome.steps,
        100.0 * outcome.largest_overlap,
        outcome.spent.line()
    );
    text
}

/// Cut size, mm, and imperfection.
fn partition_of(scene: &Scene, derived: &Derived, tally: &Tally) -> (Option<f64>, Option<f64>) {
    let diameters: Vec<f64> = scene.classes.iter().map(|class| class.diameter_mm).collect();
    let counts = tally.passed.iter().zip(&derived.counts);
    let passed: Vec<f64> = counts.map(|(&n, &all)| n as f64 / all.max(1) as f64).collect();
    partition(&diameters, &passed)
}

/// Writes `summary.json`.
pub(crate) fn summary(
    path: &Path,
    scene: &Scene,
    (source, decided): (&str, &[crate::auto::Decision]),
    settings: &pendular::dem::Settings,
    derived: &Derived,
    outcome: &Outcome,
    parts: &[String],
) -> Result<(), RunError> {
    let (total, classes) = retained_at_end(scene, derived, outcome);
    let tally = &outcome.tally;
    let names: Vec<&str> = scene.classes.iter().map(|class| class.name.as_str()).collect();
    let by_class = |values: Vec<serde_json::Value>| -> serde_json::Map<_, _> {
        names.iter().map(|n| (*n).to_owned()).zip(values).collect()
    };
    let walls: serde_json::Map<String, serde_json::Value> = groups(parts)
        .into_iter()
        .map(|(name, members)| {
            let volume: f64 = members.iter().map(|&k| tally.parts[k]).sum();
            (name, json!(volume))
        })
        .collect();
    let (cut, imperfection) = partition_of(scene, derived, tally);
    let document = json!({
        "program": { "name": env!("CARGO_PKG_NAME"), "version": env!("CARGO_PKG_VERSION") },
        "scene": source,
        "title": scene.title,
        "decided": decided.iter().cloned().collect::<std::collections::BTreeMap<_, _>>(),
        "assumptions": assumed::list(scene).into_iter().collect::<serde_json::Map<_, _>>(),
        "screen": {
            "diameter_mm": scene.screen.diameter_mm,
            "aperture_mm": scene.screen.aperture_mm,
            "wire_diameter_mm": scene.screen.wire_diameter_mm,
        },
        "derived": {
            "time_step_s": settings.time_step,
            "particles": by_class(derived.counts.iter().map(|n| json!(n)).collect()),
            "solid_mass_kg": derived.solid_mass,
            "liquid_m3": derived.liquid,
            "film_m": derived.film,
        },
        // To the digits of the tables.
        "time_s": (1e6 * tally.time).round() / 1e6,
        "drag": scene.liquid.as_ref().map(|_| if derived.implicit { "implicit" } else { "explicit" }),
        "drag_passes_since_resume": derived.implicit.then(|| json!({
            "steps": outcome.passes.steps,
            "passes": outcome.passes.passes,
            "steps_at_most_passes": outcome.passes.at_most,
        })),
        "steps": outcome.steps,
        "threads": settings.threads,
        "fraction_retained": {
            "total": total,
            "by_class": by_class(classes.iter().map(|y| json!(y)).collect()),
        },
        "classes": scene.classes.iter().zip(&derived.counts).map(|(class, count)| json!({
            "name": class.name,
            "diameter_mm": class.diameter_mm,
            "count": count,
        })).collect::<Vec<_>>(),
        "collected": by_class(tally.collected.iter().map(|n| json!(n)).collect()),
        "passed": by_class(tally.passed.iter().map(|n| json!(n)).collect()),
        "above": by_class(tally.above.iter().map(|n| json!(n)).collect()),
        "partition": { "cut_size_mm": cut, "imperfection": imperfection },
        "escaped": tally.lost(),
        "escaped_by_class": by_class(tally.escaped.iter().map(|n| json!(n)).collect()),
        "bridges": {
            "formed": tally.counts.formed,
            "ruptured": tally.counts.ruptured,
            "alive": tally.alive(),
            "alive_wall": tally.wall_bridges,
            "outside_law_range": tally.counts.extrapolated,
        },
        "liquid_m3": {
            "above": by_class(tally.film.iter().map(|v| json!(v)).collect()),
            "fines": by_class(tally.fines.iter().map(|v| json!(v)).collect()),
            "walls": walls,
            "bridges": tally.bridges,
        },
        "liquid_imbalance": tally.imbalance,
        "largest_overlap": outcome.largest_overlap,
        "least_limit_s": outcome.limit.is_finite().then_some(outcome.limit),
        "budget": budget::document(&outcome.budget, tally),
        "wall_time_s": outcome.wall_time.as_secs_f64(),
        "stopped_by_guard": outcome.fault,
        "time_split_s": outcome.spent.seconds(),
        "time_split_percent": outcome.spent.percent(),
    });
    let write = || -> std::io::Result<()> {
        let mut text = serde_json::to_vec_pretty(&document)?;
        text.push(b'\n');
        replace(path, &text)
    };
    write().map_err(|source| RunError::Write { path: path.to_path_buf(), source })
}
