//! The maps as drawings: a strip of time steps for every set of parameters.

use drawing::{Anchor, Axis, Mark, Pen, Svg, THIN};

use crate::case::{Integrator, Kind, Line, Point};
use crate::rig::Drag;

const LEFT: f64 = 232.0;
const WIDE: f64 = 430.0;
const TOP: f64 = 92.0;
const STRIP: f64 = 21.0;
/// Ends of the axis: time step over predicted limit.
const ENDS: (f64, f64) = (0.04, 8.0);

/// Greys of the four kinds of cells, dark is bad.
const UNSTABLE: u8 = 70;
const LARGE: u8 = 165;
const SMALL: u8 = 212;
const GOOD: u8 = 243;

fn grey(point: &Point) -> u8 {
    match point.outcome.error {
        _ if !point.stable => UNSTABLE,
        error if error <= 0.01 => GOOD,
        error if error <= 0.1 => SMALL,
        _ => LARGE,
    }
}

/// What the energy error of a scene is measured by.
fn measure(kind: Kind) -> &'static str {
    match kind {
        Kind::Impact => "energy error over the energy before the impact, worst of 16 offsets",
        Kind::Pair => "energy gained over the depth of the bridge's well",
        Kind::Chain => "energy gained over that of the first sphere",
        Kind::Column => "energy gained over weight times radius",
    }
}

fn label(line: &Line) -> String {
    let matter = &line.case.matter;
    let mut words = format!("k {:e} N/m, e {}", matter.stiffness, matter.restitution);
    if matter.liquid.is_some() {
        words += &format!(", η {} Pa s", line.case.viscosity());
    }
    if line.case.integrator != Integrator::Leapfrog {
        words = format!("{}, {words}", line.case.integrator.name());
    }
    if matter.drag == Drag::Implicit {
        words = format!("implicit, {words}");
    }
    words
}

/// The map of one scene; `None` if it has no line.
pub(crate) fn draw(kind: Kind, title: &str, lines: &[Line]) -> Option<String> {
    let lines: Vec<_> = lines.iter().filter(|line| line.case.kind == kind).collect();
    lines.first()?;
    let bottom = TOP + STRIP * lines.len() as f64;
    let mut svg = Svg::new(LEFT + WIDE + 24.0, bottom + 48.0);
    let axis = Axis::log(ENDS, (LEFT, LEFT + WIDE));
    svg.text([12.0, 24.0], Anchor::Start, 15.0, title);
    legend(&mut svg, kind);
    for (k, line) in lines.iter().enumerate() {
        let top = TOP + STRIP * k as f64;
        strip(&mut svg, &axis, line, top);
        svg.text([LEFT - 8.0, top + 14.5], Anchor::End, 11.0, &label(line));
    }
    for tick in [0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0] {
        let at = axis.at(tick);
        svg.line([at, bottom], [at, bottom + 4.0], THIN);
        svg.text([at, bottom + 17.0], Anchor::Middle, 11.0, &tick.to_string());
    }
    let middle = LEFT + 0.5 * WIDE;
    svg.text([middle, bottom + 36.0], Anchor::Middle, 12.0, "time step over predicted limit");
    for (at, pen) in [(1.0, Pen(0, 2.0, "")), (2.0, Pen(0, 1.0, "4 3"))] {
        svg.line([axis.at(at), TOP - 5.0], [axis.at(at), bottom], pen);
    }
    svg.frame([LEFT, TOP], [WIDE, bottom - TOP], THIN);
    for (k, line) in lines.iter().enumerate() {
        let y = TOP + STRIP * (k as f64 + 0.5);
        let at = |h: f64| axis.at(h / line.edge.limit);
        svg.mark([at(line.edge.packed), y], Mark::Diamond, false);
        svg.mark([at(line.edge.edge), y], Mark::Circle, true);
    }
    Some(svg.finish())
}

/// The cells of one line, each from halfway to its neighbours.
fn strip(svg: &mut Svg, axis: &Axis, line: &Line, top: f64) {
    let shares: Vec<f64> = line.points.iter().map(|p| p.share).collect();
    for (k, point) in line.points.iter().enumerate() {
        let before = k.checked_sub(1).map_or(ENDS.0, |j| (shares[j] * point.share).sqrt());
        let after = shares.get(k + 1).map_or(ENDS.1, |next| (next * point.share).sqrt());
        // The edge is known better than the grid: no cell straddles it.
        let edge = line.edge.edge / line.edge.limit;
        let (from, to) = if point.stable {
            (before, if shares.get(k + 1).is_some_and(|s| *s > edge) { edge } else { after })
        } else {
            (if k > 0 && shares[k - 1] <= edge { edge } else { before }, after)
        };
        let (x, y) = (axis.at(from), axis.at(to));
        svg.area([x, top + 1.0], [y - x, STRIP - 2.0], grey(point));
    }
}

fn legend(svg: &mut Svg, kind: Kind) {
    let y = 46.0;
    let mut x = 12.0;
    let cells = [
        (GOOD, "error up to 1 %", 118.0),
        (SMALL, "up to 10 %", 94.0),
        (LARGE, "more", 62.0),
        (UNSTABLE, "unstable", 82.0),
    ];
    for (grey, words, wide) in cells {
        svg.area([x, y - 9.0], [14.0, 11.0], grey);
        svg.frame([x, y - 9.0], [14.0, 11.0], Pen(120, 0.8, ""));
        svg.text([x + 19.0, y], Anchor::Start, 11.0, words);
        x += wide;
    }
    for (mark, filled, words, wide) in [
        (Mark::Circle, true, "measured edge", 104.0),
        (Mark::Diamond, false, "limit known before the run", 0.0),
    ] {
        svg.mark([x + 6.0, y - 4.0], mark, filled);
        svg.text([x + 17.0, y], Anchor::Start, 11.0, words);
        x += wide;
    }
    let words = format!("{}; lines: predicted limit and twice that", measure(kind));
    svg.text([12.0, 66.0], Anchor::Start, 11.0, &words);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Case, Outcome};
    use crate::edge::Edge;
    use crate::rig::Matter;

    #[test]
    fn cells_say_what_they_are() {
        let point =
            |stable, error| Point { share: 1.0, stable, outcome: Outcome { error, state: 0.0 } };
        assert_eq!(grey(&point(false, 0.0)), UNSTABLE);
        assert_eq!(grey(&point(true, 0.0)), GOOD);
        assert_eq!(grey(&point(true, 0.05)), SMALL);
        assert_eq!(grey(&point(true, f64::INFINITY)), LARGE);
    }

    #[test]
    fn a_map_has_a_strip_for_every_line_and_says_whose() {
        let matter = Matter {
            stiffness: 1e4,
            restitution: 0.5,
            liquid: None,
            drag: crate::rig::Drag::Explicit,
        };
        let case = Case { kind: Kind::Impact, integrator: Integrator::Leapfrog, matter };
        let edge = Edge { limit: 1e-6, packed: 5e-7, edge: 1.4e-6, term: "springs" };
        let points = vec![Point { share: 0.5, stable: true, outcome: Outcome::default() }];
        let line = Line { case, edge, points };
        let svg = draw(Kind::Impact, "Impact", &[line.clone(), line]).unwrap();
        assert_eq!(svg.matches("k 1e4 N/m, e 0.5").count(), 2);
        assert!(draw(Kind::Pair, "Pair", &[]).is_none());
    }
}
