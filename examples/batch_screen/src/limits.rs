//! The table of what limits the time step: stability limits, and what accuracy asks for.

use std::f64::consts::PI;

use pendular::dem::{Boundary, Class, Limit};
use pendular::pair::Mate;
use pendular::transfer::film;
use pendular::transfer::formation;

use crate::build::{self, Built};
use crate::scene::{Packing, Scene};

/// What a row of the table is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Above it the scheme is unstable: the run refuses.
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
}

/// Steps in the duration of a contact that keep the restitution within about 1 %.
const STEPS_IN_CONTACT: f64 = 20.0;
/// Share of the range of the capillary force, or of the smallest radius, that may be travelled in a
/// step: it costs 1 to 3 % of the bridge's energy in a pass.
const TRAVEL: f64 = 0.05;
/// Share of the time constant of a bridge's stiffness that a step may have.
const BRIDGE_SHARE: f64 = 0.1;

/// All rows: stability limits first, each kind with the tightest one first.
pub(crate) fn table(scene: &Scene, built: &Built) -> Vec<Row> {
    let classes = built.particles.classes();
    let name = |class: usize| scene.classes[class].name.clone();
    let stability = Limit::table(classes, &build::loads_of(built)).into_iter().map(|limit| Row {
        term: limit.term,
        kind: Kind::Stability,
        who: name(limit.class),
        time_step: limit.time_step,
    });
    let mut rows: Vec<Row> = stability.collect();
    rows.extend(accuracy(scene, built, classes));
    rows.sort_by(|a, b| {
        let first = |row: &Row| row.kind == Kind::Accuracy;
        first(a).cmp(&first(b)).then(a.time_step.total_cmp(&b.time_step))
    });
    rows
}

fn accuracy(scene: &Scene, built: &Built, classes: &[Class]) -> Vec<Row> {
    let lightest =
        (0..classes.len()).min_by(|&a, &b| classes[a].mass().total_cmp(&classes[b].mass()));
    let Some(lightest) = lightest else { return Vec::new() };
    let (class, who) = (classes[lightest], scene.classes[lightest].name.clone());
    let reduced_mass = 0.5 * class.mass();
    let duration = PI * (reduced_mass / scene.contact.stiffness).sqrt();
    let row = |term, who: &str, time_step| Row {
        term,
        kind: Kind::Accuracy,
        who: who.to_owned(),
        time_step,
    };
    let mut rows = vec![row("contact duration", &who, duration / STEPS_IN_CONTACT)];
    let (fall, wall) = (drop_speed(scene), built.walls.speed_bound());
    let fastest = fall + wall;
    match &scene.liquid {
        None => rows.push(row("travel of walls", "screen", TRAVEL * class.radius() / wall)),
        Some(liquid) => {
            let volume = bridge_volume(class.radius(), built.derived.film);
            let range = (2.0 * volume / (PI * class.radius())).sqrt();
            rows.push(row("travel in the capillary range", &who, TRAVEL * range / fastest));
            rows.push(row("travel of walls in it", "screen", TRAVEL * range / wall));
            let radius = class.radius();
            let stiffness =
                PI * radius * liquid.surface_tension * (2.0 * PI * radius / volume).sqrt();
            let time = (reduced_mass / stiffness).sqrt();
            rows.push(row("bridge stiffness", &who, BRIDGE_SHARE * time));
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

/// The table as text; `time_step` is the one of the run.
pub(crate) fn text(rows: &[Row], time_step: f64) -> String {
    let mut text = format!(
        "  {:<30} {:<10} {:<12} {:>11}  used\n",
        "limit of the time step", "kind", "set by", "at most [s]"
    );
    for row in rows {
        let kind = match row.kind {
            Kind::Stability => "stability",
            Kind::Accuracy => "accuracy",
        };
        let used = 100.0 * time_step / row.time_step;
        text += &format!(
            "  {:<30} {kind:<10} {:<12} {:>11.3e}  {used:.0} %\n",
            row.term, row.who, row.time_step
        );
    }
    text
}
