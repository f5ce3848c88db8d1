//! Worst error of each law over volume and contact angle.

use pendular_capillary::{AnyCapillary, CapillaryLaw};

use crate::chart::Measured;
use crate::chart::measure::Sample;
use crate::chart::summary::{map_ratio, worst};
use drawing::{Anchor, Pen, Svg, THIN};

const COLUMNS: usize = 2;
const SQUARE: [f64; 2] = [36.0, 19.0];
/// Volumes: every third of the grid's, half a decade apart; angles: every second, 10° apart.
const VOLUMES: usize = 12;
const ANGLES: usize = 7;
const CELL: [f64; 2] = [VOLUMES as f64 * SQUARE[0] + 70.0, ANGLES as f64 * SQUARE[1] + 62.0];
const EDGE: [f64; 2] = [52.0, 66.0];
const RANGE: Pen = Pen(0, 2.4, "");

pub(crate) fn draw(laws: &[Measured], samples: &[Sample]) -> String {
    let shown: Vec<&Measured> =
        laws.iter().filter(|measured| measured.law != AnyCapillary::YoungLaplace).collect();
    let rows = shown.len().div_ceil(COLUMNS);
    let width = EDGE[0] + COLUMNS as f64 * CELL[0] - 20.0;
    let mut svg = Svg::new(width, EDGE[1] + rows as f64 * CELL[1] + 4.0);
    let title = "Worst relative error of the force, in percent, gaps up to 0.9 of rupture";
    svg.text([EDGE[0], 20.0], Anchor::Start, 14.0, title);
    let note = "equal spheres (sphere and plane where the name says so), equal angles; thick: stated range; \
                –: no value";
    svg.text([EDGE[0], 38.0], Anchor::Start, 11.0, note);
    for (place, measured) in shown.into_iter().enumerate() {
        let left = EDGE[0] + (place % COLUMNS) as f64 * CELL[0];
        let top = EDGE[1] + (place / COLUMNS) as f64 * CELL[1];
        map(&mut svg, [left, top], measured, samples);
    }
    svg.finish()
}

fn map(svg: &mut Svg, [left, top]: [f64; 2], measured: &Measured, samples: &[Sample]) {
    let (law, index) = (measured.law, measured.index);
    let ratio = map_ratio(law);
    let mut inside = [[false; ANGLES]; VOLUMES];
    let on_map = |s: &&Sample| {
        s.pair.equal
            && s.pair.ratio == ratio
            && s.place.is_multiple_of(3)
            && s.pair.places[0].is_multiple_of(2)
            && s.place / 3 < VOLUMES
    };
    for sample in samples.iter().filter(on_map) {
        let (column, row) = (sample.place / 3, sample.pair.places[0] / 2);
        let x = left + column as f64 * SQUARE[0];
        let y = top + (ANGLES - 1 - row) as f64 * SQUARE[1];
        inside[column][row] = law.validity().check(&sample.bridge).is_ok();
        square(svg, [x, y], sample.force[index].as_ref().map(|errors| worst(errors, 0.0, 0.9)));
    }
    outline(svg, [left, top], &inside);
    let size = [VOLUMES as f64 * SQUARE[0], ANGLES as f64 * SQUARE[1]];
    svg.frame([left, top], size, THIN);
    svg.text([left, top - 6.0], Anchor::Start, 12.0, law.name());
    for column in (0..VOLUMES).step_by(2) {
        let x = left + (column as f64 + 0.5) * SQUARE[0];
        let label = format!("1e-{}", 6 - column / 2);
        svg.text([x, top + size[1] + 13.0], Anchor::Middle, 10.0, &label);
    }
    for row in (0..ANGLES).step_by(2) {
        let y = top + (ANGLES - 1 - row) as f64 * SQUARE[1] + 13.0;
        svg.text([left - 4.0, y], Anchor::End, 10.0, &format!("{}°", 10 * row));
    }
    let middle = left + 0.5 * size[0];
    svg.text([middle, top + size[1] + 27.0], Anchor::Middle, 11.0, "V* = V/R³");
    svg.upright([left - 34.0, top + 0.5 * size[1]], Anchor::Middle, 11.0, "θ");
}

/// A square whose grey and number say the error.
fn square(svg: &mut Svg, [x, y]: [f64; 2], error: Option<f64>) {
    let middle = [x + 0.5 * SQUARE[0], y + 0.5 * SQUARE[1] + 3.5];
    let Some(error) = error else {
        svg.cell(middle, false, "–");
        return;
    };
    // White at 0.1 % and below, dark at 100 % and above.
    let depth = ((error.max(1e-9).log10() + 3.0) / 3.0).clamp(0.0, 1.0);
    svg.area([x, y], SQUARE, (255.0 - 190.0 * depth) as u8);
    let words = percent(100.0 * error);
    svg.cell(middle, depth > 0.72, &words);
}

/// Two significant digits where there is room for them.
fn percent(value: f64) -> String {
    match value {
        v if v >= 9999.5 => ">9999".to_owned(),
        v if v >= 9.95 => format!("{v:.0}"),
        v if v >= 0.995 => format!("{v:.1}"),
        v if v >= 0.0995 => format!("{v:.2}"),
        v => format!("{v:.3}"),
    }
}

/// The edge between the squares inside the stated range and those outside.
fn outline(svg: &mut Svg, [left, top]: [f64; 2], inside: &[[bool; ANGLES]; VOLUMES]) {
    let is = |column: i32, row: i32| {
        let at =
            |c: i32, r: i32| inside.get(usize::try_from(c).ok()?)?.get(usize::try_from(r).ok()?);
        at(column, row).copied().unwrap_or(false)
    };
    let corner = |column: i32, row: i32| {
        let y = top + (ANGLES as i32 - row) as f64 * SQUARE[1];
        [left + f64::from(column) * SQUARE[0], y]
    };
    for column in 0..=VOLUMES as i32 {
        for row in 0..=ANGLES as i32 {
            if is(column - 1, row) != is(column, row) {
                svg.line(corner(column, row), corner(column, row + 1), RANGE);
            }
            if is(column, row - 1) != is(column, row) {
                svg.line(corner(column, row), corner(column + 1, row), RANGE);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percents_by_hand() {
        let all = [0.012, 0.1, 1.04, 9.96, 123.4, 1e5].map(percent);
        assert_eq!(all, ["0.012", "0.10", "1.0", "10", "123", ">9999"]);
    }
}
