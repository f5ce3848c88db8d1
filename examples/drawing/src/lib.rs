//! Drawings as SVG text: just enough for axes, lines, marks and words. Lengths are pixels.

use std::fmt::Write as _;

/// A drawing on white, its units pixels.
pub struct Svg {
    body: String,
    width: f64,
    height: f64,
}

/// Where a text hangs on its point.
#[derive(Debug, Clone, Copy)]
pub enum Anchor {
    /// The text begins there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// The shape of a mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A circle.
    Circle,
    /// A square.
    Square,
    /// A square on its corner.
    Diamond,
}

/// How a line looks: grey level 0 (black) to 255, width, dash pattern (empty: drawn through).
#[derive(Debug, Clone, Copy)]
pub struct Pen(pub u8, pub f64, pub &'static str);

/// Black, one pixel wide.
pub const THIN: Pen = Pen(0, 1.0, "");
/// The light grey of grid lines.
pub const GRID: Pen = Pen(225, 1.0, "");

impl Svg {
    /// An empty drawing.
    #[must_use]
    pub fn new(width: f64, height: f64) -> Self {
        Self { body: String::new(), width, height }
    }

    /// A straight line.
    pub fn line(&mut self, from: [f64; 2], to: [f64; 2], pen: Pen) {
        self.polyline(&[from, to], pen);
    }

    /// A line through points.
    pub fn polyline(&mut self, points: &[[f64; 2]], Pen(grey, width, dash): Pen) {
        let _ = write!(self.body, "<path d=\"");
        for (k, [x, y]) in points.iter().enumerate() {
            let _ = write!(self.body, "{}{x:.1} {y:.1}", if k == 0 { 'M' } else { 'L' });
        }
        let _ = write!(self.body, "\" fill=\"none\" stroke=\"{}\"", hex(grey));
        let _ = write!(self.body, " stroke-width=\"{width}\"");
        if !dash.is_empty() {
            let _ = write!(self.body, " stroke-dasharray=\"{dash}\"");
        }
        self.body.push_str("/>\n");
    }

    /// A filled rectangle with a grey level.
    pub fn area(&mut self, corner: [f64; 2], size: [f64; 2], grey: u8) {
        let ([x, y], [w, h]) = (corner, size);
        let _ = write!(self.body, "<path d=\"M{x} {y}h{w}v{h}h-{w}z\"");
        let _ = writeln!(self.body, " fill=\"{}\"/>", hex(grey));
    }

    /// An empty rectangle.
    pub fn frame(&mut self, corner: [f64; 2], size: [f64; 2], pen: Pen) {
        let ([x, y], [w, h]) = (corner, size);
        self.polyline(&[[x, y], [x + w, y], [x + w, y + h], [x, y + h], [x, y]], pen);
    }

    /// A mark with its middle at a point.
    pub fn mark(&mut self, [x, y]: [f64; 2], mark: Mark, filled: bool) {
        let fill = if filled { "#000" } else { "#fff" };
        let style = format!("fill=\"{fill}\" stroke=\"#000\" stroke-width=\"1.3\"");
        let _ = match mark {
            Mark::Circle => {
                writeln!(self.body, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\" {style}/>")
            }
            Mark::Square => writeln!(
                self.body,
                "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"8\" height=\"8\" {style}/>",
                x - 4.0,
                y - 4.0
            ),
            Mark::Diamond => {
                writeln!(self.body, "<path d=\"M{x:.1} {:.1}l6 6l-6 6l-6 -6z\" {style}/>", y - 6.0)
            }
        };
    }

    /// Words at a point, `size` pixels high.
    pub fn text(&mut self, [x, y]: [f64; 2], anchor: Anchor, size: f64, words: &str) {
        self.words(&format!("x=\"{x:.1}\" y=\"{y:.1}\""), anchor, size, words);
    }

    /// A number in the middle of a square, white on a dark one.
    pub fn cell(&mut self, [x, y]: [f64; 2], light: bool, words: &str) {
        let class = if light { "c w" } else { "c" };
        let _ = writeln!(
            self.body,
            "<text class=\"{class}\" x=\"{x}\" y=\"{y}\">{}</text>",
            escaped(words)
        );
    }

    /// Text that runs upwards.
    pub fn upright(&mut self, [x, y]: [f64; 2], anchor: Anchor, size: f64, words: &str) {
        let place = format!("transform=\"translate({x:.1} {y:.1}) rotate(-90)\"");
        self.words(&place, anchor, size, words);
    }

    fn words(&mut self, place: &str, anchor: Anchor, size: f64, words: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let safe = escaped(words);
        let _ = write!(self.body, "<text {place} font-size=\"{size}\" text-anchor=\"{anchor}\"");
        let _ = writeln!(self.body, ">{safe}</text>");
    }

    /// The finished file.
    #[must_use]
    pub fn finish(self) -> String {
        let Self { body, width, height } = self;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"Helvetica, Arial, sans-serif\">\n\
             <style>.c{{font-size:9.5px;text-anchor:middle}}.w{{fill:#fff}}</style>\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n{body}</svg>\n"
        )
    }
}

fn escaped(words: &str) -> String {
    words.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn hex(grey: u8) -> String {
    format!("#{grey:02x}{grey:02x}{grey:02x}")
}

/// A number line between two pixels.
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    /// Whether equal distances are equal ratios.
    pub log: bool,
    /// Values at its ends.
    pub ends: (f64, f64),
    /// Pixels of its ends.
    pub pixels: (f64, f64),
}

impl Axis {
    /// A logarithmic axis; its ends are positive.
    #[must_use]
    pub fn log(ends: (f64, f64), pixels: (f64, f64)) -> Self {
        Self { log: true, ends, pixels }
    }

    /// A linear axis.
    #[must_use]
    pub fn linear(ends: (f64, f64), pixels: (f64, f64)) -> Self {
        Self { log: false, ends, pixels }
    }

    /// The pixel of a value; values off the axis stick to its ends.
    #[must_use]
    pub fn at(&self, value: f64) -> f64 {
        let place = |v: f64| if self.log { v.max(f64::MIN_POSITIVE).ln() } else { v };
        let (low, high) = (place(self.ends.0), place(self.ends.1));
        let share = ((place(value) - low) / (high - low)).clamp(0.0, 1.0);
        self.pixels.0 + share * (self.pixels.1 - self.pixels.0)
    }

    /// Values and labels of the ticks: powers of ten, or `step` apart on a linear axis.
    #[must_use]
    pub fn ticks(&self, step: f64) -> Vec<(f64, String)> {
        if self.log {
            let (low, high) = (self.ends.0.log10(), self.ends.1.log10());
            let powers = (low - 1e-9).ceil() as i32..=(high + 1e-9).floor() as i32;
            return powers.map(|k| (10f64.powi(k), power(k))).collect();
        }
        let many = ((self.ends.1 - self.ends.0) / step + 1e-9).floor() as u32;
        (0..=many)
            .map(|k| self.ends.0 + f64::from(k) * step)
            .map(|value| (value, format!("{}", (value * 1e6).round() / 1e6)))
            .collect()
    }
}

/// 10 to a power, in words that fit a tick.
fn power(k: i32) -> String {
    match k {
        -2..=0 => format!("{}", 10f64.powi(k)),
        1..=4 => format!("{}", 10f64.powi(k)),
        _ => {
            let digits = k.to_string();
            let raised = digits.chars().map(|c| match c {
                '-' => '⁻',
                '1' => '¹',
                '2' => '²',
                '3' => '³',
                other => char::from_u32('⁰' as u32 + other as u32 - '0' as u32).unwrap_or(other),
            });
            format!("10{}", raised.collect::<String>())
        }
    }
}

/// Grid lines, frame and tick labels of a panel. An empty axis label leaves its ticks unlabelled.
pub fn panel(svg: &mut Svg, x: (&Axis, f64, &str), y: (&Axis, f64, &str)) {
    let ((x_axis, x_step, x_label), (y_axis, y_step, y_label)) = (x, y);
    let (left, right) = x_axis.pixels;
    let (bottom, top) = y_axis.pixels;
    for (value, label) in x_axis.ticks(x_step) {
        let at = x_axis.at(value);
        svg.line([at, bottom], [at, top], GRID);
        if !x_label.is_empty() {
            svg.text([at, bottom + 15.0], Anchor::Middle, 11.0, &label);
        }
    }
    for (value, label) in y_axis.ticks(y_step) {
        let at = y_axis.at(value);
        svg.line([left, at], [right, at], GRID);
        if !y_label.is_empty() {
            svg.text([left - 6.0, at + 4.0], Anchor::End, 11.0, &label);
        }
    }
    svg.frame([left, top], [right - left, bottom - top], THIN);
    svg.text([0.5 * (left + right), bottom + 33.0], Anchor::Middle, 12.0, x_label);
    svg.upright([left - 44.0, 0.5 * (top + bottom)], Anchor::Middle, 12.0, y_label);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_by_hand() {
        let log = Axis::log((1e-4, 1.0), (100.0, 500.0));
        assert!((log.at(1e-2) - 300.0).abs() < 1e-9);
        assert_eq!((log.at(0.0), log.at(7.0)), (100.0, 500.0));
        let labels: Vec<String> = log.ticks(0.0).into_iter().map(|(_, label)| label).collect();
        assert_eq!(labels, ["10⁻⁴", "10⁻³", "0.01", "0.1", "1"]);
        let linear = Axis::linear((0.0, 1.0), (0.0, 10.0));
        assert_eq!(linear.ticks(0.25).len(), 5);
        assert_eq!(linear.ticks(0.25)[3].1, "0.75");
    }

    #[test]
    fn words_are_escaped() {
        let mut svg = Svg::new(10.0, 10.0);
        svg.text([1.0, 1.0], Anchor::Start, 9.0, "a < b & c");
        assert!(svg.finish().contains(">a &lt; b &amp; c</text>"));
    }
}
