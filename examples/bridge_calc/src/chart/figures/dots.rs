//! Errors of rupture laws and transfer methods: a row per law, a panel per kind of bodies.

use crate::chart::measure::{METHODS, RUPTURES, Sample};
use crate::chart::stats::Stats;
use crate::chart::summary::{BODIES, bodies};
use crate::rupture::RuptureChoice;
use drawing::{Anchor, Axis, Mark, Pen, Svg, panel};

const WIDE: f64 = 205.0;
const LEFT: f64 = 130.0;
const TOP: f64 = 84.0;
const STEP: f64 = 26.0;
const BAR: Pen = Pen(120, 1.2, "");

/// What a figure says about itself.
struct Words<'a> {
    title: &'a str,
    axis: &'a str,
    names: Vec<&'a str>,
}

pub(crate) fn rupture(samples: &[Sample]) -> String {
    let names: Vec<&str> =
        RuptureChoice::all().iter().take(RUPTURES).map(|law| law.name()).collect();
    let words =
        Words { title: "Rupture distance against the exact bridge", axis: "relative error", names };
    draw(&words, samples, |sample, index| sample.rupture[index])
}

pub(crate) fn transfer(samples: &[Sample]) -> String {
    let words = Words {
        title: "Transfer ratio against the neck of the last stable bridge",
        axis: "error of the share",
        names: METHODS.iter().map(|method| method.name()).collect(),
    };
    draw(&words, samples, |sample, index| sample.share[index])
}

fn draw(
    words: &Words<'_>,
    samples: &[Sample],
    pick: impl Fn(&Sample, usize) -> Option<f64> + Copy,
) -> String {
    let tall = STEP * words.names.len() as f64;
    let mut svg = Svg::new(LEFT + WIDE * BODIES.len() as f64 + 10.0, TOP + tall + 50.0);
    svg.text([20.0, 22.0], Anchor::Start, 14.0, words.title);
    let note = "V* from 1e-4 to 0.1, angles to 50°. Bar: median to worst, mark: 95 % of the errors; ● equal \
                contact angles, ◇ unequal ones. What is below 1e-6 stands at the edge.";
    svg.text([20.0, 42.0], Anchor::Start, 11.0, note);
    let y = Axis::linear((0.0, words.names.len() as f64), (TOP + tall, TOP));
    for (row, name) in words.names.iter().enumerate() {
        let height = TOP + STEP * (row as f64 + 0.5);
        svg.text([LEFT - 10.0, height + 4.0], Anchor::End, 12.0, name);
    }
    for (column, (label, low, high)) in BODIES.into_iter().enumerate() {
        let left = LEFT + WIDE * column as f64;
        let x = Axis::log((1e-6, 1.0), (left, left + WIDE - 26.0));
        panel(&mut svg, (&x, 0.0, ""), (&y, 1.0, ""));
        for (power, tick) in x.ticks(0.0).into_iter().step_by(2) {
            svg.text([x.at(power), TOP + tall + 15.0], Anchor::Middle, 11.0, &tick);
        }
        svg.text([left, TOP - 8.0], Anchor::Start, 12.0, label);
        let middle = left + 0.5 * (WIDE - 26.0);
        svg.text([middle, TOP + tall + 34.0], Anchor::Middle, 12.0, words.axis);
        for row in 0..words.names.len() {
            for (equal, shift) in [(true, -5.5), (false, 5.5)] {
                let members = bodies(samples, (low, high), equal);
                let Some(stats) = Stats::of(members.filter_map(|s| pick(s, row))) else { continue };
                let height = TOP + STEP * (row as f64 + 0.5) + shift;
                dot(&mut svg, &x, height, stats, equal);
            }
        }
    }
    svg.finish()
}

fn dot(svg: &mut Svg, x: &Axis, height: f64, stats: Stats, equal: bool) {
    let [median, most, worst] = [stats.median, stats.most, stats.worst].map(|error| x.at(error));
    svg.line([median, height], [worst, height], BAR);
    for end in [median, worst] {
        svg.line([end, height - 3.0], [end, height + 3.0], BAR);
    }
    svg.mark([most, height], if equal { Mark::Circle } else { Mark::Diamond }, equal);
}
