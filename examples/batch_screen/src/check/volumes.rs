//! Whether the first bridges of a scene lie in the ranges of volume over which its laws hold, as the
//! laws themselves state them: told before a run.

use pendular::pair::{Bridge, Mate};
use pendular::transfer::film;
use pendular::transfer::formation::{WetMate, claims};

use super::number;
use super::ranges::{Named, between, with_walls};
use crate::build::Built;
use crate::scene::{LiquidSpec, OutsideRange, Scene};

/// The smallest and the largest V* of some bridges, each with whom it joins.
struct Span {
    least: (f64, String),
    most: (f64, String),
}

/// A line for each law whose range some first bridges miss. Later bridges are others: spheres that
/// have given liquid away have smaller ones, and walls have films of their own then.
pub(crate) fn volumes(scene: &Scene, built: &Built) -> Vec<String> {
    let Some(liquid) = scene.liquid.as_ref().filter(|_| built.derived.film > 0.0) else {
        return Vec::new();
    };
    let mut notes = Vec::new();
    for (bridges, laws, where_) in [
        (between_spheres(scene, built), between(liquid), "between spheres"),
        (at_walls(scene, built), with_walls(liquid), "with walls that are still dry"),
    ] {
        let Some(span) = span(bridges) else { continue };
        notes.extend(laws_missed(liquid, &laws, &span, where_));
    }
    notes
}

fn laws_missed(
    liquid: &LiquidSpec,
    laws: &Named<'_>,
    span: &Span,
    where_: &'static str,
) -> Vec<String> {
    let what_then = match liquid.outside_range {
        OutsideRange::Extrapolate => "those outside are extrapolated and counted",
        OutsideRange::Refuse => "the run stops at the first outside (liquid.outside_range)",
    };
    let (least, most) = (&span.least, &span.most);
    let missed = |(key, name, validity): &(&str, &str, Option<pendular::pair::Validity>)| {
        let (low, high) = validity.as_ref()?.v_star;
        (least.0 < low || most.0 > high).then(|| {
            let (low, high) = (number(low), number(high));
            format!(
                "{key} = \"{name}\" holds for V* = V/R^3 of {low} to {high}; first bridges {where_} have \
                 {:.2e} ({}) to {:.2e} ({}): {what_then}",
                least.0, least.1, most.0, most.1
            )
        })
    };
    laws.iter().filter_map(missed).collect()
}

/// V* and the two bodies of each kind of bridge between spheres that there are.
fn between_spheres(scene: &Scene, built: &Built) -> Vec<(f64, String)> {
    let all = present(scene, built);
    let mut bridges = Vec::new();
    for (k, &(radius, film_volume, name)) in all.iter().enumerate() {
        for &(other, other_volume, other_name) in &all[k..] {
            let mate = WetMate::Sphere { radius: other, film_volume: other_volume };
            let v_star = first_bridge(radius, film_volume, mate);
            bridges.extend(v_star.map(|v| (v, format!("{name} with {other_name}"))));
        }
    }
    bridges
}

/// The same with walls.
fn at_walls(scene: &Scene, built: &Built) -> Vec<(f64, String)> {
    let mut bridges = Vec::new();
    for (radius, film_volume, name) in present(scene, built) {
        for part in built.walls.0.parts() {
            let mate = WetMate::Wall { half_side: part.half_side, film_volume: 0.0, area: 1.0 };
            let v_star = first_bridge(radius, film_volume, mate);
            let wall = crate::build::apparatus::group(&part.name);
            bridges.extend(v_star.map(|v| (v, format!("{name} with {wall}"))));
        }
    }
    bridges
}

/// Radius, liquid at the start and name of the classes that have spheres.
fn present<'a>(scene: &'a Scene, built: &Built) -> Vec<(f64, f64, &'a str)> {
    let classes = built.particles.classes().iter().zip(&scene.classes).zip(&built.derived.counts);
    let one = |((class, spec), &count): ((&pendular::dem::Class, &'a _), &u64)| {
        let spec: &crate::scene::SizeClass = spec;
        let volume = film::volume(class.radius(), built.derived.film).ok()?;
        (count > 0).then_some((class.radius(), volume, spec.name.as_str()))
    };
    classes.filter_map(one).collect()
}

/// V* of the bridge that a sphere with its first film makes.
fn first_bridge(radius: f64, film_volume: f64, mate: WetMate) -> Option<f64> {
    let volume = claims(radius, film_volume, mate).ok()?.iter().sum();
    let body: Mate = mate.mate();
    // Only its volume and radii matter.
    Bridge::new(radius, body, volume, [0.0; 2], 1.0).ok().map(|bridge| bridge.v_star())
}

fn span(bridges: Vec<(f64, String)>) -> Option<Span> {
    let by = |a: &&(f64, String), b: &&(f64, String)| a.0.total_cmp(&b.0);
    let least = bridges.iter().min_by(by)?.clone();
    let most = bridges.iter().max_by(by)?.clone();
    Some(Span { least, most })
}
