//! Cost against error, with the Pareto front.

use pendular_capillary::{AnyCapillary, LawKind};

use crate::chart::Measured;
use drawing::{Anchor, Axis, Mark, Pen, Svg, THIN, panel};

const SIZE: [f64; 2] = [900.0, 520.0];
const FRONT: Pen = Pen(120, 1.5, "6 4");
const WHISKER: Pen = Pen(130, 1.0, "");
const LEADER: Pen = Pen(170, 0.8, "");
/// Least distance of two marks sideways, so that bars do not cover each other.
const APART: f64 = 9.0;

/// One law's place in the drawing.
struct Point {
    name: &'static str,
    mark: Mark,
    cost: f64,
    x: f64,
    /// Median, 95th percentile, worst.
    errors: [f64; 3],
    on_front: bool,
}

pub(crate) fn draw(laws: &[Measured]) -> String {
    let mut svg = Svg::new(SIZE[0], SIZE[1]);
    let x = Axis::log((2.0, 50.0), (70.0, 740.0));
    let y = Axis::log((1e-6, 100.0), (450.0, 50.0));
    let far = Axis::log((2e3, 2e5), (770.0, 870.0));
    svg.text([70.0, 22.0], Anchor::Start, 14.0, "What an evaluation costs and how wrong it is");
    let note = "bar: median to worst, mark: 95 % of the errors, inside each law's range, gaps to 0.98 of \
                rupture, equal angles";
    svg.text([70.0, 40.0], Anchor::Start, 11.0, note);
    panel(&mut svg, (&x, 0.0, "ns per force(gap)"), (&y, 0.0, "relative error of the force"));
    for value in [2.0, 5.0, 20.0, 50.0] {
        svg.text([x.at(value), 465.0], Anchor::Middle, 11.0, &value.to_string());
    }
    panel(&mut svg, (&far, 0.0, "ns"), (&y, 0.0, ""));
    let mut points = points(laws, &x);
    front(&mut points);
    let line = front_line(&points, &x, &y);
    svg.polyline(&line, FRONT);
    for point in &points {
        bar(&mut svg, point, &y);
    }
    labels(&mut svg, &points, &line, &y);
    reference(&mut svg, laws, &far, &y);
    let key = "filled: on the Pareto front (dashed line); circles: spheres, squares: plane only; marks of equal \
               cost stand side by side";
    svg.text([70.0, 510.0], Anchor::Start, 11.0, key);
    svg.finish()
}

/// All laws but the exact one, by cost, kept apart sideways.
fn points(laws: &[Measured], axis: &Axis) -> Vec<Point> {
    let closed = laws.iter().filter(|m| m.law != AnyCapillary::YoungLaplace);
    let mut points: Vec<Point> = closed
        .filter_map(|measured| {
            let stats = measured.inside.all()?;
            let plane = measured.law.info().kind == LawKind::SpherePlane;
            Some(Point {
                name: measured.law.name(),
                mark: if plane { Mark::Square } else { Mark::Circle },
                cost: measured.cost.force,
                x: axis.at(measured.cost.force),
                errors: [stats.median, stats.most, stats.worst],
                on_front: false,
            })
        })
        .collect();
    points.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let mut last = f64::NEG_INFINITY;
    for point in &mut points {
        point.x = point.x.max(last + APART);
        last = point.x;
    }
    points
}

/// A law is on the front if none is both cheaper and better. Plane laws compete as well.
fn front(points: &mut [Point]) {
    let mut best = f64::INFINITY;
    for point in points {
        point.on_front = point.errors[1] < best;
        best = best.min(point.errors[1]);
    }
}

/// The steps from one law on the front to the next.
fn front_line(points: &[Point], x: &Axis, y: &Axis) -> Vec<[f64; 2]> {
    let mut line: Vec<[f64; 2]> = Vec::new();
    for point in points.iter().filter(|point| point.on_front) {
        let height = y.at(point.errors[1]);
        if let Some([_, before]) = line.last().copied() {
            line.push([point.x, before]);
        } else {
            line.push([point.x, y.pixels.1]);
        }
        line.push([point.x, height]);
    }
    if let Some([_, height]) = line.last().copied() {
        line.push([x.pixels.1, height]);
    }
    line
}

fn bar(svg: &mut Svg, point: &Point, y: &Axis) {
    let [median, most, worst] = point.errors.map(|error| y.at(error));
    svg.line([point.x, median], [point.x, worst], WHISKER);
    for end in [median, worst] {
        svg.line([point.x - 3.0, end], [point.x + 3.0, end], WHISKER);
    }
    svg.mark([point.x, most], point.mark, point.on_front);
}

/// Names to the right of their marks, moved up or down until none covers another name or a mark.
fn labels(svg: &mut Svg, points: &[Point], line: &[[f64; 2]], y: &Axis) {
    // Left, right, top, bottom of all that is drawn.
    let step = |pair: &[[f64; 2]]| {
        let [[x1, y1], [x2, y2]] = [pair[0], pair[1]];
        [x1.min(x2), x1.max(x2), y1.min(y2) - 1.0, y1.max(y2) + 1.0]
    };
    let mut taken: Vec<[f64; 4]> = line.windows(2).map(step).collect();
    for point in points {
        let at = y.at(point.errors[1]);
        taken.push([point.x - 6.0, point.x + 6.0, at - 6.0, at + 6.0]);
        taken.push([point.x - 4.0, point.x + 4.0, y.at(point.errors[2]), y.at(point.errors[0])]);
    }
    // From the right: the marks that have room keep their names beside them.
    for point in points.iter().rev() {
        let (at, wide) = (y.at(point.errors[1]), 6.2 * point.name.len() as f64);
        let fits = |&(x, height): &(f64, f64)| {
            let (right, top, bottom) = (x + wide, height - 7.0, height + 7.0);
            right < y_right()
                && height > y.pixels.1 + 6.0
                && height < y.pixels.0 - 6.0
                && taken.iter().all(|t| right < t[0] || x > t[1] || bottom < t[2] || top > t[3])
        };
        let places = (0..26).flat_map(|k| {
            let shift = 8.0 * f64::from(k);
            [(point.x + 10.0 + shift, at - shift), (point.x + 10.0 + shift, at + shift)]
        });
        let far = (0..30).map(|k| (point.x + 40.0 + 12.0 * f64::from(k), at - 40.0));
        let (x, height) = places.chain(far).find(fits).unwrap_or((point.x + 10.0, at));
        if (height - at).abs() > 1.0 {
            svg.line([point.x + 4.0, at], [x - 2.0, height], LEADER);
        }
        svg.text([x, height + 4.0], Anchor::Start, 12.0, point.name);
        taken.push([x, x + wide, height - 7.0, height + 7.0]);
    }
}

/// Right end of the room for names.
fn y_right() -> f64 {
    740.0
}

/// The exact law: a cost, and no error to be measured against itself.
fn reference(svg: &mut Svg, laws: &[Measured], far: &Axis, y: &Axis) {
    let Some(exact) = laws.iter().find(|m| m.law == AnyCapillary::YoungLaplace) else { return };
    let (x, bottom) = (far.at(exact.cost.force), y.pixels.0);
    svg.line([x, bottom], [x, bottom - 60.0], THIN);
    svg.mark([x, bottom], Mark::Diamond, true);
    svg.upright([x - 6.0, bottom - 14.0], Anchor::Start, 12.0, "young-laplace: the reference");
}
