//! The smallest scene that says the same: what can be dropped, simplified or taken in larger steps.
//!
//! The evidence is in two steps. The physics budget of a pilot run tells which forces do little;
//! each simplification is then run by itself and compared with the whole scene. Two runs of a
//! granular flow part ways anyhow, so differences are held against those between runs that differ
//! in nothing but a slightly shorter time step.

use pendular::Acting;
use pendular::capillary::AnyCapillary;

use crate::build::{self, Built, Source};
use crate::error::RunError;
use crate::limits::{self, Kind};
use crate::pilot::{self, Pilot};
use crate::progress::Style;
use crate::run::Outcome;
use crate::scene::{DynamicRupture, LiquidSpec, Scene, SizeClass, WireKind};
use crate::{auto, budget, evidence, report};

/// Time steps of the twins, as shares of the scene's: they differ by chance alone.
const TWINS: [f64; 2] = [0.99, 0.98];

/// A run must be this share faster before that is called a saving, and faster than the same scene
/// runs by chance.
const SAVING: f64 = 0.03;

/// A simplification and why it might do.
struct Idea {
    change: String,
    /// The same for `--set`.
    sets: Vec<String>,
    reason: String,
    apply: Box<dyn Fn(&mut Scene)>,
}

/// A run with changes beside the whole scene's.
struct Tried {
    pilot: Pilot,
    difference: f64,
    /// Share of the time.
    saved: f64,
}

/// The whole scene and what others are held against.
struct Whole<'a> {
    scene: &'a Scene,
    source: &'a Source<'a>,
    pilot: Pilot,
    /// Largest difference that a change may make.
    allowed: f64,
    /// Least share of the time that is called a saving.
    saving: f64,
}

/// Runs pilots of `time` s and proposes the smallest scene that agrees within `tolerance`.
pub(crate) fn needs(
    mut scene: Scene,
    source: &Source<'_>,
    time: f64,
    tolerance: f64,
    say: &dyn Fn(&str),
) -> Result<(), RunError> {
    let whole_time = scene.time;
    scene.time = scene.time.min(time);
    scene.output_interval = scene.output_interval.max(scene.time / 10.0);
    let built = build::build(&scene, source)?;
    scene.time_step = Some(built.settings.time_step);
    say(&report::header(&scene, &built));
    say(&format!("pilot runs of {} s; tolerance {tolerance}", scene.time));
    // Beds of other steps and frictions settle too: nothing of that stays between the lines.
    let source = &Source { style: Style::Passing, ..*source };
    let mut pilot = pilot::fly(&scene, source)?;
    if let Some(lacking) = evidence::lacking(&scene, &pilot) {
        say(&format!("whole scene: fraction retained {:.4}", pilot.retained));
        let loss = pilot.outcome.tally.capillary_loss;
        let table = budget::text(&pilot.outcome.budget, loss);
        if !table.is_empty() {
            say(table.trim_end());
        }
        say(&evidence::too_little(&scene, &lacking, whole_time));
        return Ok(());
    }
    // The first run also pays for what is made once.
    let mut times = Vec::new();
    let mut scatter = 0.0_f64;
    let mut by_class = vec![0.0_f64; scene.classes.len()];
    for share in TWINS {
        let mut twin = scene.clone();
        twin.time_step = scene.time_step.map(|step| share * step);
        let twin = pilot::fly(&twin, source)?;
        scatter = scatter.max(twin.differs(&pilot));
        for (most, difference) in by_class.iter_mut().zip(differences(&twin, &pilot)) {
            *most = most.max(difference.abs());
        }
        times.push(share * twin.seconds);
    }
    pilot.seconds = times.iter().copied().fold(f64::INFINITY, f64::min);
    let slowest = times.iter().copied().fold(0.0, f64::max);
    let saving = SAVING.max(1.0 - pilot.seconds / slowest);
    say(&format!(
        "whole scene: fraction retained {:.4} in {:.2} s of processor time; runs that differ by chance alone differ by {scatter:.4}",
        pilot.retained, pilot.seconds
    ));
    let loss = pilot.outcome.tally.capillary_loss;
    say(budget::text(&pilot.outcome.budget, loss).trim_end());
    let allowed = tolerance + scatter;
    say(&rule(tolerance, scatter, saving));
    let ideas = ideas(&scene, &built, &pilot.outcome, tolerance);
    let whole = Whole { scene: &scene, source, pilot, allowed, saving };
    say(&heading(&scene, &by_class));
    let mut taken: Vec<(Idea, Tried)> = Vec::new();
    for idea in ideas {
        let tried = whole.fly(&[&idea])?;
        say(&whole.line(&idea, &tried));
        if tried.difference <= allowed && tried.saved > saving {
            taken.push((idea, tried));
        }
    }
    whole.propose(taken, say)
}

/// How changes are judged, in words.
fn rule(tolerance: f64, scatter: f64, saving: f64) -> String {
    format!(
        "rule: a change is taken if it differs from the whole scene by at most {:.4} = {tolerance} (tolerance) + \
         {scatter:.4} (chance), in the fraction retained and in the shares of the liquid on walls, \
         with the fines and in bridges, and saves more than {:.0} % of the time; \
         differences by class are told, not judged",
        tolerance + scatter,
        100.0 * saving
    )
}

/// Fraction retained of each class against that of another run.
fn differences(pilot: &Pilot, other: &Pilot) -> Vec<f64> {
    pilot.classes.iter().zip(&other.classes).map(|(a, b)| a - b).collect()
}

/// The classes' columns, each as wide as its name needs.
fn columns(scene: &Scene, cell: impl Fn(usize) -> String) -> String {
    let width = |name: &str| name.chars().count().max(7);
    let one = |(k, class): (usize, &SizeClass)| format!("  {:>1$}", cell(k), width(&class.name));
    scene.classes.iter().enumerate().map(one).collect()
}

fn heading(scene: &Scene, by_chance: &[f64]) -> String {
    let names = columns(scene, |k| scene.classes[k].name.clone());
    let chance = columns(scene, |k| format!("{:.4}", by_chance[k]));
    format!(
        "  {:<46}  retained  difference{names}  time saved  verdict\n  {:<46}  {:>8}  {:>10}{chance}",
        "change", "by chance, up to", "", ""
    )
}

impl Whole<'_> {
    fn fly(&self, ideas: &[&Idea]) -> Result<Tried, RunError> {
        let mut changed = self.scene.clone();
        ideas.iter().for_each(|idea| (idea.apply)(&mut changed));
        let pilot = pilot::fly(&changed, self.source)?;
        let difference = pilot.differs(&self.pilot);
        let saved = 1.0 - pilot.seconds / self.pilot.seconds;
        Ok(Tried { pilot, difference, saved })
    }

    fn numbers(&self, tried: &Tried) -> String {
        let by_class = differences(&tried.pilot, &self.pilot);
        format!(
            "{:>8.4}  {:>10.4}{}  {:>8.0} %",
            tried.pilot.retained,
            tried.difference,
            columns(self.scene, |k| format!("{:+.4}", by_class[k])),
            100.0 * tried.saved
        )
    }

    fn line(&self, idea: &Idea, tried: &Tried) -> String {
        let verdict = match (tried.difference <= self.allowed, tried.saved > self.saving) {
            (false, _) => "keep: it changes the result",
            (true, false) => "no matter: saves nothing",
            (true, true) => "take it",
        };
        let (change, reason) = (&idea.change, &idea.reason);
        format!("  {change:<46}  {}  {verdict} ({reason})", self.numbers(tried))
    }

    /// Runs all changes that were taken together, and says what to write into the scene. While they
    /// change the result together, the one that differs most by itself is given up.
    fn propose(&self, mut taken: Vec<(Idea, Tried)>, say: &dyn Fn(&str)) -> Result<(), RunError> {
        if taken.is_empty() {
            say("nothing can be left out: the scene is as small as its results allow");
            return Ok(());
        }
        taken.sort_by(|(_, a), (_, b)| a.difference.total_cmp(&b.difference));
        while taken.len() > 1 {
            let together = self.fly(&taken.iter().map(|(idea, _)| idea).collect::<Vec<_>>())?;
            let agrees = together.difference <= self.allowed;
            let verdict = if agrees { "within" } else { "above" };
            say(&format!(
                "  {:<46}  {}  {verdict} {:.4}",
                format!("{} changes together", taken.len()),
                self.numbers(&together),
                self.allowed
            ));
            if agrees {
                break;
            }
            if let Some((given_up, _)) = taken.pop() {
                say(&format!(
                    "together they change the result: given up is {}, which differs most by itself",
                    given_up.change
                ));
            }
        }
        let sets = taken.iter().flat_map(|(idea, _)| &idea.sets);
        let sets: Vec<String> = sets.map(|set| format!("--set '{set}'")).collect();
        say(&format!("proposed, for `run` or `check`: {}", sets.join(" ")));
        Ok(())
    }
}

/// What might be left out or made cheaper, given what the forces did.
fn ideas(scene: &Scene, built: &Built, outcome: &Outcome, tolerance: f64) -> Vec<Idea> {
    let mut ideas = Vec::new();
    let (budget, loss) = (&outcome.budget, outcome.tally.capillary_loss);
    let small = |acting| budget.of_impulse(acting) < tolerance;
    let share = |acting| {
        let share = format!("{:.2} % of the impulse", 100.0 * budget.of_impulse(acting));
        match budget::is_needed(budget, loss, acting) {
            true => format!(
                "{share}; the table above calls it needed by its share, but this run decides"
            ),
            false => share,
        }
    };
    if small(Acting::RollingFriction) {
        ideas.extend(rolling(scene, share(Acting::RollingFriction)));
    }
    if let Some(liquid) = &scene.liquid {
        ideas.extend(drags(liquid, &small, &share));
        ideas.extend(capillary(scene, built, liquid, tolerance));
    }
    ideas.extend(steps(scene, built));
    ideas.extend(wires(scene));
    ideas
}

fn rolling(scene: &Scene, reason: String) -> Option<Idea> {
    let rolls = scene.contacts.iter().any(|pair| pair.rolling_friction > 0.0);
    let set = |k: usize| format!("contacts[{k}].rolling_friction=0");
    rolls.then(|| Idea {
        change: "contacts: rolling_friction = 0".into(),
        sets: (0..scene.contacts.len()).map(set).collect(),
        reason,
        apply: Box::new(|scene| {
            scene.contacts.iter_mut().for_each(|pair| pair.rolling_friction = 0.0);
        }),
    })
}

fn drags(
    liquid: &LiquidSpec,
    small: &dyn Fn(Acting) -> bool,
    share: &dyn Fn(Acting) -> String,
) -> Vec<Idea> {
    let mut ideas = Vec::new();
    if liquid.normal_drag != auto::NONE && small(Acting::ViscousNormal) {
        ideas.push(Idea {
            change: "liquid: normal_drag = \"none\"".into(),
            sets: vec!["liquid.normal_drag=none".into()],
            reason: share(Acting::ViscousNormal),
            apply: wet(|liquid| liquid.normal_drag = auto::NONE.into()),
        });
    }
    let tangential = [&liquid.tangential_drag, &liquid.tangential_drag_wall];
    if tangential.iter().any(|name| *name != auto::NONE) && small(Acting::ViscousTangential) {
        ideas.push(Idea {
            change: "liquid: tangential_drag, …_wall = \"none\"".into(),
            sets: ["", "_wall"].map(|wall| format!("liquid.tangential_drag{wall}=none")).into(),
            reason: share(Acting::ViscousTangential),
            apply: wet(|liquid| {
                liquid.tangential_drag = auto::NONE.into();
                liquid.tangential_drag_wall = auto::NONE.into();
            }),
        });
    }
    if liquid.dynamic_rupture != DynamicRupture::None && small(Acting::DynamicRupture) {
        ideas.push(Idea {
            change: "liquid: dynamic_rupture = \"none\"".into(),
            sets: vec!["liquid.dynamic_rupture=none".into()],
            reason: share(Acting::DynamicRupture),
            apply: wet(|liquid| liquid.dynamic_rupture = DynamicRupture::None),
        });
    }
    ideas
}

fn wet(change: impl Fn(&mut LiquidSpec) + 'static) -> Box<dyn Fn(&mut Scene)> {
    Box::new(move |scene| {
        if let Some(liquid) = &mut scene.liquid {
            change(liquid);
        }
    })
}

/// The cheapest laws whose error against the exact bridge is below the tolerance of the force.
fn capillary(scene: &Scene, built: &Built, liquid: &LiquidSpec, tolerance: f64) -> Option<Idea> {
    let now: AnyCapillary = liquid.capillary.parse().ok()?;
    let advice = auto::advise(scene, built, tolerance.max(auto::FORCE_TOLERANCE)).ok()?;
    let name = advice.law.name();
    (advice.law != now).then(|| Idea {
        change: format!("liquid: capillary = \"{name}\""),
        sets: vec![format!("liquid.capillary={name}")],
        reason: format!("error of the force at most {:.1} %", 100.0 * advice.error),
        apply: wet(move |liquid| liquid.capillary = name.into()),
    })
}

/// The longest step that is stable, with something to spare.
fn steps(scene: &Scene, built: &Built) -> Option<Idea> {
    let step = built.settings.time_step;
    let longest = 0.95 * build::limit(built).time_step;
    // Two digits, rounded down.
    let unit = 10_f64.powf(longest.log10().floor() - 1.0);
    let longest = (longest / unit).floor() * unit;
    let costs = || {
        let rows = limits::table(scene, built).into_iter();
        let dear = rows.filter(|row| row.kind == Kind::Accuracy && longest > row.time_step);
        dear.map(|row| {
            let used = 100.0 * longest / row.time_step;
            format!("; check: {} at {used:.0} %: {}", row.term, row.cost)
        })
        .collect::<String>()
    };
    (longest > 1.05 * step).then(|| Idea {
        change: format!("time_step = {longest:.1e}"),
        sets: vec![format!("time_step={longest:.1e}")],
        reason: format!("within the stability limit{}", costs()),
        apply: Box::new(move |scene| scene.time_step = Some(longest)),
    })
}

fn wires(scene: &Scene) -> Option<Idea> {
    (scene.screen.wires == WireKind::Mesh).then(|| Idea {
        change: "screen: wires = \"cylinders\"".into(),
        sets: vec!["screen.wires=cylinders".into()],
        reason: "exact, and a wire is one shape instead of many triangles".into(),
        apply: Box::new(|scene| scene.screen.wires = WireKind::Cylinders),
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::document::{self, Set};
    use crate::place::Origin;

    #[test]
    fn what_is_proposed_is_what_was_run() {
        let demo = crate::builtin::find("demo").unwrap();
        let demo = demo.replace("wires = \"cylinders\"", "wires = \"mesh\"");
        let origin = || Origin::new(Path::new("demo"), &demo);
        let scene = Scene::read(&demo, origin()).unwrap();
        let mut all = drags(scene.liquid.as_ref().unwrap(), &|_| true, &|_| String::new());
        all.extend(rolling(&scene, String::new()));
        all.extend(wires(&scene));
        assert_eq!(all.len(), 5);
        let told =
            |scene: &Scene| format!("{:?} {:?} {:?}", scene.liquid, scene.contacts, scene.screen);
        for idea in all {
            let mut applied = scene.clone();
            (idea.apply)(&mut applied);
            let sets: Vec<Set> = idea.sets.iter().map(|set| Set::parse(set).unwrap()).collect();
            let text = document::with(&demo, &mut origin(), &sets).unwrap();
            let set = Scene::read(&text, origin()).unwrap();
            assert_eq!(told(&applied), told(&set), "{}", idea.change);
            assert_ne!(told(&applied), told(&scene), "{}", idea.change);
        }
    }
}
