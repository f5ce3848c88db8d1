//! The smallest scene that says the same: what can be dropped, simplified or taken in larger steps.
//!
//! The evidence is in two steps. The physics budget of a pilot run tells which forces do little;
//! each simplification is then run by itself and compared with the whole scene. Two runs of a
//! granular flow part ways anyhow, so differences are held against those between runs that differ
//! in nothing but a slightly shorter time step.

use pendular::capillary::AnyCapillary;
use pendular::{Acting, Budget};

use crate::auto;
use crate::build::{self, Built, Source};
use crate::error::RunError;
use crate::pilot::{self, Pilot};
use crate::report;
use crate::scene::{DynamicRupture, LiquidSpec, Scene, WireKind};

/// Time steps of the twins, as shares of the scene's: they differ by chance alone.
const TWINS: [f64; 2] = [0.99, 0.98];

/// A run must be this share faster before that is called a saving, and faster than the same scene
/// runs by chance.
const SAVING: f64 = 0.03;

/// A simplification and why it might do.
struct Idea {
    change: String,
    reason: String,
    apply: Box<dyn Fn(&mut Scene)>,
}

/// An idea after its run.
struct Tried {
    idea: Idea,
    pilot: Pilot,
    difference: f64,
    saved: f64,
}

/// Runs pilots of `time` s and proposes the smallest scene that agrees within `tolerance`.
pub(crate) fn needs(
    mut scene: Scene,
    source: &Source<'_>,
    time: f64,
    tolerance: f64,
    say: &dyn Fn(&str),
) -> Result<(), RunError> {
    scene.time = scene.time.min(time);
    scene.output_interval = scene.output_interval.max(scene.time / 10.0);
    let built = build::build(&scene, source)?;
    scene.time_step = Some(built.settings.time_step);
    say(&report::header(&scene, &built));
    say(&format!("pilot runs of {} s; tolerance {tolerance}", scene.time));
    let mut whole = pilot::fly(&scene, source)?;
    // The first run also pays for what is made once.
    let mut times = Vec::new();
    let mut scatter = 0.0_f64;
    for share in TWINS {
        let mut twin = scene.clone();
        twin.time_step = scene.time_step.map(|step| share * step);
        let twin = pilot::fly(&twin, source)?;
        scatter = scatter.max(twin.differs(&whole));
        times.push(share * twin.seconds);
    }
    whole.seconds = times.iter().copied().fold(f64::INFINITY, f64::min);
    let slowest = times.iter().copied().fold(0.0, f64::max);
    let saving = SAVING.max(1.0 - whole.seconds / slowest);
    say(&format!(
        "whole scene: fraction retained {:.4} in {:.2} s of processor time; runs that differ by chance alone differ by {scatter:.4}",
        whole.retained, whole.seconds
    ));
    say(crate::budget::text(&whole.outcome.budget, whole.outcome.tally.capillary_loss).trim_end());
    let allowed = tolerance + scatter;
    say(
        "  change                                          retained  difference  time saved  verdict",
    );
    let mut taken: Vec<Idea> = Vec::new();
    for idea in ideas(&scene, &built, &whole.outcome.budget, tolerance) {
        let tried = fly(idea, &scene, source, &whole)?;
        say(&line(&tried, allowed, saving));
        if tried.difference <= allowed && tried.saved > saving {
            taken.push(tried.idea);
        }
    }
    propose(&scene, source, &whole, taken, allowed, say)
}

fn fly(idea: Idea, scene: &Scene, source: &Source<'_>, whole: &Pilot) -> Result<Tried, RunError> {
    let mut changed = scene.clone();
    (idea.apply)(&mut changed);
    let pilot = pilot::fly(&changed, source)?;
    let difference = pilot.differs(whole);
    let saved = 1.0 - pilot.seconds / whole.seconds;
    Ok(Tried { idea, pilot, difference, saved })
}

fn line(tried: &Tried, allowed: f64, saving: f64) -> String {
    let verdict = match (tried.difference <= allowed, tried.saved > saving) {
        (false, _) => "keep: it changes the result",
        (true, false) => "no matter: saves nothing",
        (true, true) => "take it",
    };
    format!(
        "  {:<46} {:>9.4}  {:>10.4}  {:>8.0} %  {verdict} ({})",
        tried.idea.change,
        tried.pilot.retained,
        tried.difference,
        100.0 * tried.saved,
        tried.idea.reason
    )
}

/// Runs all changes that were taken together and says what to write into the scene.
fn propose(
    scene: &Scene,
    source: &Source<'_>,
    whole: &Pilot,
    taken: Vec<Idea>,
    allowed: f64,
    say: &dyn Fn(&str),
) -> Result<(), RunError> {
    if taken.is_empty() {
        say("nothing can be left out: the scene is as small as its results allow");
        return Ok(());
    }
    let mut smallest = scene.clone();
    taken.iter().for_each(|idea| (idea.apply)(&mut smallest));
    let pilot = pilot::fly(&smallest, source)?;
    let (difference, saved) = (pilot.differs(whole), 1.0 - pilot.seconds / whole.seconds);
    say(&format!(
        "all that was taken together: fraction retained {:.4}, difference {difference:.4}, {:.0} % of the time saved",
        pilot.retained,
        100.0 * saved
    ));
    if difference > allowed {
        say("together they change the result: take them one at a time");
    }
    say("proposed changes of the scene:");
    taken.iter().for_each(|idea| say(&format!("  {}", idea.change)));
    Ok(())
}

/// What might be left out or made cheaper, given what the forces did.
fn ideas(scene: &Scene, built: &Built, budget: &Budget, tolerance: f64) -> Vec<Idea> {
    let mut ideas = Vec::new();
    let small = |acting| budget.of_impulse(acting) < tolerance;
    let share = |acting| format!("{:.2} % of the impulse", 100.0 * budget.of_impulse(acting));
    let rolls = scene.contacts.iter().any(|pair| pair.rolling_friction > 0.0);
    if rolls && small(Acting::RollingFriction) {
        ideas.push(Idea {
            change: "contacts: rolling_friction = 0".into(),
            reason: share(Acting::RollingFriction),
            apply: Box::new(|scene| {
                scene.contacts.iter_mut().for_each(|pair| pair.rolling_friction = 0.0);
            }),
        });
    }
    if let Some(liquid) = &scene.liquid {
        ideas.extend(drags(liquid, &small, &share));
        ideas.extend(capillary(scene, built, liquid, tolerance));
    }
    ideas.extend(steps(built));
    ideas.extend(wires(scene));
    ideas
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
            reason: share(Acting::ViscousNormal),
            apply: wet(|liquid| liquid.normal_drag = auto::NONE.into()),
        });
    }
    let tangential = [&liquid.tangential_drag, &liquid.tangential_drag_wall];
    if tangential.iter().any(|name| *name != auto::NONE) && small(Acting::ViscousTangential) {
        ideas.push(Idea {
            change: "liquid: tangential_drag, …_wall = \"none\"".into(),
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
        reason: format!("error of the force at most {:.1} %", 100.0 * advice.error),
        apply: wet(move |liquid| liquid.capillary = name.into()),
    })
}

/// The longest step that is stable, with something to spare.
fn steps(built: &Built) -> Option<Idea> {
    let step = built.settings.time_step;
    let longest = 0.95 * build::limit(built).time_step;
    // Two digits, rounded down.
    let unit = 10_f64.powf(longest.log10().floor() - 1.0);
    let longest = (longest / unit).floor() * unit;
    (longest > 1.05 * step).then(|| Idea {
        change: format!("time_step = {longest:.1e}"),
        reason: "within the stability limit".into(),
        apply: Box::new(move |scene| scene.time_step = Some(longest)),
    })
}

fn wires(scene: &Scene) -> Option<Idea> {
    (scene.screen.wires == WireKind::Mesh).then(|| Idea {
        change: "screen: wires = \"cylinders\"".into(),
        reason: "exact, and a wire is one shape instead of many triangles".into(),
        apply: Box::new(|scene| scene.screen.wires = WireKind::Cylinders),
    })
}
