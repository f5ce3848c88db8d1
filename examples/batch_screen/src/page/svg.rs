//! One column of `retained.csv` of several runs over time, as a plain SVG drawing.

use std::fmt::Write as _;

use super::embed::html;

/// A line of the drawing: its name, times, s, and values, shares.
pub(crate) struct Line<'a> {
    pub(crate) name: &'a str,
    pub(crate) x: &'a [f64],
    pub(crate) y: &'a [f64],
}

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 440.0;
/// Pixels of the frame: left, right, top, bottom.
const FRAME: [f64; 4] = [58.0, 620.0, 16.0, 392.0];
/// Points that a line is drawn with at most.
const POINTS: usize = 400;
/// Colours that stay apart for the colour-blind too (Okabe and Ito 2008), each with a dash pattern.
const LOOKS: [(&str, &str); 8] = [
    ("#0072b2", ""),
    ("#d55e00", "7 3"),
    ("#009e73", "2 3"),
    ("#000000", "10 3 2 3"),
    ("#cc79a7", ""),
    ("#e69f00", "7 3"),
    ("#56b4e9", "2 3"),
    ("#777777", "10 3 2 3"),
];

/// Draws lines over time; values as percent of what there was at the start.
pub(crate) fn draw(lines: &[Line<'_>], label: &str) -> String {
    let most = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let end = lines.iter().map(|line| most(line.x)).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    let top = lines.iter().map(|line| most(line.y)).fold(1.0, f64::max);
    let [left, right, high, low] = FRAME;
    let x = |time: f64| left + time / end * (right - left);
    let y = |share: f64| low - share / top * (low - high);
    let mut body = String::new();
    for share in (0..=10).map(|k| 0.1 * f64::from(k)) {
        rule(&mut body, [left, y(share)], [right, y(share)]);
        let text = format!("{:.0}", 100.0 * share);
        words(&mut body, [left - 7.0, y(share) + 4.0], "end", &text);
    }
    let step = tick(end);
    for k in 0..=(end / step + 1e-9) as u32 {
        let time = f64::from(k) * step;
        rule(&mut body, [x(time), low], [x(time), high]);
        let text = format!("{}", (1e6 * time).round() / 1e6);
        words(&mut body, [x(time), low + 17.0], "middle", &text);
    }
    words(&mut body, [right, low + 36.0], "end", "time, s");
    let upright = format!("transform=\"translate(16 {high}) rotate(-90)\"");
    let _ = writeln!(body, "<text {upright} text-anchor=\"end\">{}</text>", html(label));
    for (k, line) in lines.iter().enumerate() {
        let (colour, dash) = LOOKS[k % LOOKS.len()];
        let look = format!("stroke=\"{colour}\" stroke-dasharray=\"{dash}\"");
        let every = line.x.len().div_ceil(POINTS).max(1);
        let last = line.x.len().saturating_sub(1);
        let points = line.x.iter().zip(line.y).enumerate();
        let kept = points.filter(|(n, _)| n % every == 0 || *n == last);
        let path: Vec<String> =
            kept.map(|(_, (&t, &v))| format!("{:.1} {:.1}", x(t), y(v))).collect();
        let _ = writeln!(body, "<path class=\"l\" d=\"M{}\" {look}/>", path.join("L"));
        let at = high + 14.0 + 20.0 * k as f64;
        let (from, to) = (right + 12.0, right + 40.0);
        let _ = writeln!(body, "<path class=\"l\" d=\"M{from} {at}H{to}\" {look}/>");
        words(&mut body, [right + 46.0, at + 4.0], "start", line.name);
    }
    let high = HEIGHT.max(FRAME[2] + 14.0 + 20.0 * lines.len() as f64);
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {high}\" width=\"{WIDTH}\" \
         height=\"{high}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\">\n\
         <style>.l{{fill:none;stroke-width:1.8}}.r{{stroke:#ddd}}</style>\n\
         <rect width=\"{WIDTH}\" height=\"{high}\" fill=\"#fff\"/>\n{body}</svg>\n"
    )
}

/// A tick distance that gives four to ten ticks.
fn tick(end: f64) -> f64 {
    let power = 10f64.powf(end.log10().floor());
    [0.1, 0.2, 0.5, 1.0, 2.0]
        .map(|step| step * power)
        .into_iter()
        .find(|step| end / step <= 10.0)
        .unwrap_or(end)
}

fn rule(body: &mut String, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) {
    let _ = writeln!(body, "<path class=\"r\" d=\"M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}\"/>");
}

fn words(body: &mut String, [x, y]: [f64; 2], anchor: &str, text: &str) {
    let place = format!("x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\"");
    let _ = writeln!(body, "<text {place}>{}</text>", html(text));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_lie_where_their_values_are() {
        let line = Line { name: "a<b", x: &[0.0, 5.0, 20.0], y: &[1.0, 0.5, 0.0] };
        let text = draw(&[line], "retained, %");
        // Left and right, top and bottom of the frame, and a quarter of the way.
        assert!(text.contains("d=\"M58.0 16.0L198.5 204.0L620.0 392.0\""), "{text}");
        assert!(text.contains(">a&lt;b</text>") && text.contains(">time, s</text>"));
        assert!(text.contains(">20</text>") && text.contains(">50</text>"));
    }

    #[test]
    fn a_few_ticks_always() {
        for end in [0.05, 0.3, 1.0, 3.0, 7.0, 20.0, 99.0] {
            let many = end / tick(end);
            assert!((3.9..=10.0001).contains(&many), "{end}: {many}");
        }
    }
}
