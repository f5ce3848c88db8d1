//! The table of what limits the time step: stability limits, and what accuracy asks for.

use std::f64::consts::PI;

use pendular::dem::{Boundary, Class, Limit};
use pendular::pair::Mate;
use pendular::transfer::film;
use pendular::transfer::formation;

use crate::build::{self, Built};
use crate::scene::{Packing, Scene};

/// What a row of the table is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    /// All terms together: above it the scheme is unstable, and the run refuses.
    Limit,
    /// The stability limit of one term, if it acted alone.
    Stability,
    /// Above it results lose accuracy.
    Accuracy,
}

/// One row of the table.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    pub(crate) term: &'static str,
    pub(crate) kind: Kind,
    /// Who sets it.
    pub(crate) who: String,
    /// Longest time step, s.
    pub(crate) time_step: f64,
    /// What a longer step costs, if that is accuracy.
    pub(crate) cost: &'static str,
}

/// Steps in the duration of a contact that keep the restitution within about 1 %.
const STEPS_IN_CONTACT: f64 = 20.0;
/// Share of the range of the capillary force, or of the smallest radius, that may be travelled in a
/// step: it costs 1 to 3 % of the bridge's energy in a pass.
const TRAVEL: f64 = 0.05;
/// Share of the time constant of a bridge's stiffness that a step may have.
const BRIDGE_SHARE: f64 = 0.1;

/// All rows: the limit first, then those of single terms, then accuracy, each kind with the tightest
/// one first.
pub(crate) fn table(scene: &Scene, built: &Built) -> Vec<Row> {
    let classes = built.particles.classes();
    let name = |class: usize| scene.classes[class].name.clone();
    let row = |kind, term, limit: &Limit| Row {
        term,
        kind,
        who: name(limit.class),
        time_step: limit.time_step,
        cost: "",
    };
    // Terms that act together leave no more than each of them alone would.
    let mut rows = vec![row(Kind::Limit, "all terms together", &build::limit(built))];
    let alone = Limit::table(classes, &build::loads_of(built));
    rows.extend(alone.iter().map(|limit| row(Kind::Stability, limit.term, limit)));
    rows.extend(accuracy(scene, built, classes));
    rows.sort_by(|a, b| a.kind.cmp(&b.kind).then(a.time_step.total_cmp(&b.time_step)));
    rows
}

fn accuracy(scene: &Scene, built: &Built, classes: &[Class]) -> Vec<Row> {
    let lightest =
        (0..classes.len()).min_by(|&a, &b| classes[a].mass().total_cmp(&classes[b].mass()));
    let Some(lightest) = lightest else { return Vec::new() };
    let (class, who) = (classes[lightest], scene.classes[lightest].name.clone());
    let reduced_mass = 0.5 * class.mass();
    let duration = PI * (reduced_mass / scene.contact.stiffness).sqrt();
    let row = |term, who: &str, time_step, cost| Row {
        term,
        kind: Kind::Accuracy,
        who: who.to_owned(),
        time_step,
        cost,
    };
    let restitution = "the restitution of a contact may be off by more than about 1 %";
    let mut rows = vec![row("contact duration", &who, duration / STEPS_IN_CONTACT, restitution)];
    let (fall, wall) = (drop_speed(scene), built.walls.speed_bound());
    let fastest = fall + wall;
    match &scene.liquid {
        None => {
            let cost = "a wall moves by more than 5 % of the smallest radius in a step";
            rows.push(row("travel of walls", "screen", TRAVEL * class.radius() / wall, cost));
        }
        Some(liquid) => {
            let volume = bridge_volume(class.radius(), built.derived.film);
            let range = (2.0 * volume / (PI * class.radius())).sqrt();
            let energy = "the energy of a bridge may be off by more than 1 to 3 % in a pass";
            let travel = |term, who, speed| row(term, who, TRAVEL * range / speed, energy);
            rows.push(travel("travel in the capillary range", &who, fastest));
            rows.push(travel("travel of walls in it", "screen", wall));
            let radius = class.radius();
            let stiffness =
                PI * radius * liquid.surface_tension * (2.0 * PI * radius / volume).sqrt();
            let time = (reduced_mass / stiffness).sqrt();
            let cost = "the pull of a bridge is followed less closely than it should be";
            rows.push(row("bridge stiffness", &who, BRIDGE_SHARE * time, cost));
        }
    }
    rows.retain(|row| row.time_step.is_finite());
    rows
}

/// Volume of the first bridge of two equal spheres with films of one thickness, m³.
pub(crate) fn bridge_volume(radius: f64, thickness: f64) -> f64 {
    let share = formation::sphere_fraction(radius, Mate::Sphere { radius }).unwrap_or(0.0);
    2.0 * share * film::volume(radius, thickness).unwrap_or(0.0)
}

/// Speed of a sphere that falls onto the screen, m/s.
pub(crate) fn drop_speed(scene: &Scene) -> f64 {
    let height = match &scene.packing {
        Packing::Bin { floor_height_mm, .. } => 1e-3 * floor_height_mm,
        Packing::Random { clearance_mm, .. } => 1e-3 * clearance_mm,
        Packing::File { .. } => 1e-3 * scene.screen.height_mm,
    };
    (2.0 * -scene.gravity[2].min(0.0) * height).sqrt()
}

/// The table as text, and what it means for a run with the step `time_step`.
pub(crate) fn text(rows: &[Row], time_step: f64) -> String {
    let mut text = format!(
        "  {:<30} {:<10} {:<12} {:>11}  used\n",
        "limit of the time step", "kind", "set by", "at most [s]"
    );
    let used = |row: &Row| 100.0 * time_step / row.time_step;
    for row in rows {
        let kind = match row.kind {
            Kind::Limit => "limit",
            Kind::Stability => "stability",
            Kind::Accuracy => "accuracy",
        };
        text += &format!(
            "  {:<30} {kind:<10} {:<12} {:>11.3e}  {:.0} %\n",
            row.term,
            row.who,
            row.time_step,
            used(row)
        );
    }
    text += "  The first row decides: a longer step is refused. Stability rows say what one term would \
             allow alone.\n  Accuracy rows are advice: a step above 100 % of one runs, but costs \
             accuracy.\n";
    for row in rows.iter().filter(|row| row.kind == Kind::Accuracy && used(row) > 100.0) {
        text += &format!("  {} at {:.0} %: {}\n", row.term, used(row), row.cost);
    }
    text
}
