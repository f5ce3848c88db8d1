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
        points(&mut svg, runs, at);
    }
    svg.finish()
}

fn points(svg: &mut Svg, runs: &[Run], at: impl Fn(&Run) -> [f64; 2]) {
    let steps = runs.iter().filter(|run| run.axis == runs::Axis::Step);
    let line: Vec<_> = steps.map(&at).collect();
    if line.len() > 1 {
        svg.polyline(&line, Pen(120, 1.0, ""));
    }
    for run in runs {
        let (mark, filled, words) = match run.axis {
            runs::Axis::Reference => continue,
            runs::Axis::Step => (Mark::Circle, true, format!("{}", run.way.share)),
            runs::Axis::Law => (Mark::Square, false, run.label()),
            runs::Axis::Wires => (Mark::Diamond, false, run.label()),
            runs::Axis::Drag => (Mark::Square, true, run.label()),
        };
        let [x, y] = at(run);
        svg.mark([x, y], mark, filled);
        svg.text([x + 7.0, y - 5.0], Anchor::Start, 9.5, &words);
    }
}
