//! The physics budget: which forces did how much in a run.

use pendular::dem::Simulation;
use pendular::{Acting, Against, Budget, MeshWalls};
use serde_json::json;

use crate::makeup::Makeup;
use crate::tally::Tally;

/// Steps between looks at all pairs; a multiple of the steps between looks at what has left.
pub(crate) const EVERY: u64 = 1024;

/// A force with a smaller share of the impulse is called negligible.
const NEGLIGIBLE: f64 = 0.01;

/// Adds what acts now, standing for the steps since the last look.
pub(crate) fn look<T: Makeup>(simulation: &Simulation<T, MeshWalls>, budget: &mut Budget) {
    let (term, time) = (simulation.term(), EVERY as f64 * simulation.settings().time_step);
    budget.look();
    simulation.survey(|pair, column| {
        let (contact, bridge) = term.forces(pair, column);
        if contact.normal != 0.0 {
            budget.contact(pair, &contact, time);
        }
        if let Some(bridge) = bridge {
            budget.bridge(pair, &bridge, time);
        }
    });
}

/// Energy that a force took from the motion, J.
fn energy(budget: &Budget, acting: Acting, capillary_loss: f64) -> f64 {
    if acting == Acting::Capillary {
        return capillary_loss;
    }
    [Against::Particles, Against::Walls]
        .map(|against| budget.share(acting, against).energy)
        .iter()
        .sum()
}

/// One line of the table.
struct Row {
    acting: Acting,
    impulse: f64,
    walls: f64,
    energy: f64,
    joules: f64,
    seen: u64,
}

impl Row {
    fn is_needed(&self) -> bool {
        self.seen > 0 && (self.impulse >= NEGLIGIBLE || self.energy >= NEGLIGIBLE)
    }

    fn verdict(&self) -> &'static str {
        match (self.seen, self.is_needed()) {
            (0, _) => "never acted",
            (_, false) => "negligible: below 1 % of impulse and energy",
            (_, true) => "needed",
        }
    }
}

fn rows(budget: &Budget, capillary_loss: f64) -> Vec<Row> {
    let joules = |acting| energy(budget, acting, capillary_loss);
    let whole: f64 = Acting::ALL.iter().map(|&acting| joules(acting)).sum();
    let row = |&acting: &Acting| {
        let of = |against| budget.share(acting, against);
        let (particles, walls) = (of(Against::Particles), of(Against::Walls));
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        Row {
            acting,
            impulse: budget.of_impulse(acting),
            walls: share(walls.impulse, walls.impulse + particles.impulse),
            energy: share(joules(acting), whole),
            joules: joules(acting),
            seen: particles.seen + walls.seen,
        }
    };
    Acting::ALL.iter().map(row).collect()
}

/// Whether the table calls a force needed.
pub(crate) fn is_needed(budget: &Budget, capillary_loss: f64, acting: Acting) -> bool {
    rows(budget, capillary_loss).iter().any(|row| row.acting == acting && row.is_needed())
}

/// The budget for `summary.json`, one object a force.
pub(crate) fn document(budget: &Budget, tally: &Tally) -> serde_json::Value {
    let percent = |share: f64| (1e4 * share).round() / 1e2;
    let outside = tally.counts.extrapolated as f64 / tally.counts.formed.max(1) as f64;
    let rows =
        rows(budget, tally.capillary_loss).into_iter().filter(|row| row.seen > 0).map(|row| {
            json!({
                "force": row.acting.name(),
                "verdict": row.verdict(),
                "impulse_percent": percent(row.impulse),
                "with_walls_percent": percent(row.walls),
                "dissipated_percent": percent(row.energy),
                "dissipated_J": row.joules,
                // Drags have no range; rupture and capillary force are counted together.
                "outside_law_range_percent": match row.acting {
                    Acting::Capillary => percent(outside),
                    _ => 0.0,
                },
            })
        });
    rows.collect()
}

/// The budget for people; nothing before the first look.
pub(crate) fn text(budget: &Budget, capillary_loss: f64) -> String {
    if budget.looks() == 0 {
        return String::new();
    }
    let mut text =
        String::from("  force                impulse  with walls  dissipated  verdict\n");
    for row in rows(budget, capillary_loss).iter().filter(|row| row.seen > 0) {
        text += &format!(
            "  {:<19} {:>7.2} %  {:>8.1} %  {:>8.2} %  {}\n",
            row.acting.name(),
            100.0 * row.impulse,
            100.0 * row.walls,
            100.0 * row.energy,
            row.verdict()
        );
    }
    text
}
