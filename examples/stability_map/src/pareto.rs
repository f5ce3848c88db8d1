//! Error against cost of whole runs, as a drawing: a panel for each quantity.

use drawing::{Anchor, Axis, Mark, Pen, Svg, panel};

use crate::runs::{self, QUANTITIES, Run};

const WIDE: f64 = 270.0;
const HIGH: f64 = 250.0;
const LEFT: f64 = 62.0;
const TOP: f64 = 66.0;
const STEP: f64 = 345.0;

/// The chart; errors below 1e-5 sit on the lower end.
pub(crate) fn draw(runs: &[Run]) -> String {
    let mut svg = Svg::new(LEFT + 3.0 * STEP - 20.0, TOP + HIGH + 52.0);
    svg.text([12.0, 22.0], Anchor::Start, 15.0, "A small wet screening: error against cost");
    let notes = [
        (Mark::Circle, true, "time step over limit (table of the exact law, round wires)", 340.0),
        (Mark::Square, false, "capillary law, half the limit", 190.0),
        (Mark::Diamond, false, "prisms for wires, half the limit", 205.0),
        (Mark::Square, true, "drag", 60.0),
    ];
    let mut x = 12.0;
    for (mark, filled, words, wide) in notes {
        svg.mark([x + 6.0, 40.0], mark, filled);
        svg.text([x + 17.0, 44.0], Anchor::Start, 11.0, words);
        x += wide;
    }
    svg.area([x, 35.0], [14.0, 11.0], 225);
    let words = "scatter of the reference, step 1 and 2 % shorter";
    svg.text([x + 19.0, 44.0], Anchor::Start, 11.0, words);
    let costs = runs.iter().map(|run| run.found.cost.max(1e-3));
    let (low, high) = costs.fold((f64::INFINITY, 0.0_f64), |(l, h), c| (l.min(c), h.max(c)));
    let ends = (0.7 * low, 1.5 * high);
    for (k, (name, truth)) in QUANTITIES.iter().zip(runs::truth(runs)).enumerate() {
        let left = LEFT + STEP * k as f64;
        let x = Axis::log(ends, (left, left + WIDE));
        let y = Axis::log((1e-5, 1.0), (TOP + HIGH, TOP));
        let band = y.at(truth.1);
        svg.area([left, band], [WIDE, TOP + HIGH - band], 225);
        panel(&mut svg, (&x, 0.0, "processor time, s"), (&y, 0.0, &format!("error of {name}")));
        let at = |run: &Run| [x.at(run.found.cost), y.at((run.values()[k] - truth.0).abs())];
        points(&mut svg, runs, [left, left + WIDE], at);
    }
    svg.finish()
}

fn points(svg: &mut Svg, runs: &[Run], ends: [f64; 2], at: impl Fn(&Run) -> [f64; 2]) {
    let steps = runs.iter().filter(|run| run.axis == runs::Axis::Step);
    let line: Vec<_> = steps.map(&at).collect();
    if line.len() > 1 {
        svg.polyline(&line, Pen(120, 1.0, ""));
    }
    let runs: Vec<_> = runs.iter().filter(|run| run.axis != runs::Axis::Reference).collect();
    let mut taken: Vec<Area> = runs.iter().map(|run| Area::around(at(run))).collect();
    for run in runs {
        let (mark, filled) = match run.axis {
            runs::Axis::Law => (Mark::Square, false),
            runs::Axis::Wires => (Mark::Diamond, false),
            runs::Axis::Drag => (Mark::Square, true),
            runs::Axis::Reference | runs::Axis::Step => (Mark::Circle, true),
        };
        let words = match run.axis {
            runs::Axis::Step => run.way.share.to_string(),
            _ => run.label(),
        };
        svg.mark(at(run), mark, filled);
        let place = label(at(run), &words, ends, &taken);
        svg.text([place.left, place.bottom - 2.0], Anchor::Start, 9.5, &words);
        taken.push(place);
    }
}

/// A part of the drawing.
#[derive(Debug, Clone, Copy)]
struct Area {
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl Area {
    /// What a mark takes.
    fn around([x, y]: [f64; 2]) -> Self {
        Self { left: x - 5.0, right: x + 5.0, top: y - 5.0, bottom: y + 5.0 }
    }

    fn meets(&self, other: &Self) -> bool {
        let beside = self.left >= other.right || other.left >= self.right;
        !(beside || self.top >= other.bottom || other.top >= self.bottom)
    }
}

/// Where words about a mark go: beside it where nothing else is, and not beyond the ends of the panel.
fn label([x, y]: [f64; 2], words: &str, [left, right]: [f64; 2], taken: &[Area]) -> Area {
    let wide = 5.2 * words.chars().count() as f64;
    let area = |left: f64, middle: f64| Area {
        left,
        right: left + wide,
        top: middle - 5.5,
        bottom: middle + 5.5,
    };
    let downs = [0.0, -9.0, 9.0, -18.0, 18.0, -27.0, 27.0, -36.0, 36.0];
    let places = downs.into_iter().flat_map(|down| {
        let beside = if down == 0.0 { 8.0 } else { 3.0 };
        [area(x + beside, y + down), area(x - beside - wide, y + down)]
    });
    let inside = |place: &Area| place.left >= left && place.right <= right;
    let free = |place: &Area| inside(place) && !taken.iter().any(|t| t.meets(place));
    places.clone().find(free).unwrap_or_else(|| area((x + 8.0).min(right - wide), y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_about_marks_that_lie_close_do_not_cover_each_other() {
        let marks = [[100.0, 50.0], [104.0, 52.0], [290.0, 50.0]];
        let mut taken: Vec<Area> = marks.into_iter().map(Area::around).collect();
        for mark in marks {
            let place = label(mark, "young-laplace", [80.0, 300.0], &taken);
            assert!(!taken.iter().any(|t| t.meets(&place)), "{place:?}");
            assert!(place.right <= 300.0 && place.left >= 80.0, "{place:?}");
            taken.push(place);
        }
    }
}
