//! Force over the gap of one bridge by every law, a panel each.

use std::f64::consts::PI;

use pendular_capillary::young_laplace::ExactBridge;
use pendular_capillary::{AnyCapillary, Bridge, CapillaryLaw, ForceCurve, Mate, Range};

use crate::chart::ChartError;
use drawing::{Anchor, Axis, Pen, Svg, panel};

const EXACT: Pen = Pen(190, 5.0, "");
const LAW: Pen = Pen(0, 1.6, "");
const OUTSIDE: Pen = Pen(0, 1.6, "5 3");
const COLUMNS: usize = 4;
const CELL: [f64; 2] = [220.0, 190.0];
const EDGE: [f64; 2] = [64.0, 62.0];
/// Points per curve.
const POINTS: u32 = 120;

/// W11 and R1 of Gladkyy & Schwarze (2014), Table 1.
pub(crate) fn cases() -> Result<[(String, Bridge); 2], ChartError> {
    let w11 = Mate::Sphere { radius: 2.381e-3 };
    let r1 = Mate::Sphere { radius: 35e-6 };
    let ten = [10f64.to_radians(); 2];
    Ok([
        ("w11".to_owned(), Bridge::new(2.381e-3, w11, 13.6e-12, [0.0; 2], 20.6e-3)?),
        ("r1".to_owned(), Bridge::new(19e-6, r1, 2e-19, ten, 27e-3)?),
    ])
}

pub(crate) fn draw(name: &str, bridge: &Bridge) -> Result<String, ChartError> {
    let exact = ExactBridge::new(bridge)?;
    let laws: Vec<AnyCapillary> = AnyCapillary::ALL
        .into_iter()
        .filter(|law| *law != AnyCapillary::YoungLaplace)
        .filter(|law| law.curve(bridge, Range::Extrapolate).is_ok())
        .collect();
    let count = laws.len();
    let rows = count.div_ceil(COLUMNS);
    let width = EDGE[0] + COLUMNS as f64 * CELL[0] + 10.0;
    let height = EDGE[1] + rows as f64 * CELL[1] + 45.0;
    let mut svg = Svg::new(width, height);
    head(&mut svg, name, bridge, &exact);
    let unit = 2.0 * PI * bridge.harmonic_radius() * bridge.surface_tension();
    let end = exact.rupture().distance;
    // Gaps that crowd at both ends, where the curves bend.
    let gaps = (0..=POINTS).map(|k| 0.5 - 0.5 * (PI * f64::from(k) / f64::from(POINTS)).cos());
    let gaps: Vec<f64> = gaps.map(|share| share * share.sqrt()).collect();
    let mut truth = Vec::new();
    for share in &gaps {
        truth.push((*share, exact.force(share * end)? / unit));
    }
    let lowest = truth.iter().fold(1.0, |low: f64, (_, force)| low.min(*force));
    let floor = 10f64.powf((0.6 * lowest).log10().floor());
    for (place, law) in laws.into_iter().enumerate() {
        let (column, row) = (place % COLUMNS, place / COLUMNS);
        let left = EDGE[0] + column as f64 * CELL[0];
        let top = EDGE[1] + row as f64 * CELL[1];
        let x = Axis::linear((0.0, 1.0), (left, left + CELL[0] - 16.0));
        let y = Axis::log((floor, 3.0), (top + CELL[1] - 30.0, top));
        let last = place + COLUMNS >= count;
        let x_label = if last { "S/S_rup" } else { "" };
        let y_label = if column == 0 { "F/(2πRσ)" } else { "" };
        panel(&mut svg, (&x, 0.25, x_label), (&y, 0.0, y_label));
        let curve = law.curve(bridge, Range::Extrapolate)?;
        let lawful = gaps.iter().map(|share| (*share, curve.force(share * end) / unit));
        let to_pixels = |(share, force): (f64, f64)| [x.at(share), y.at(force)];
        svg.polyline(&truth.iter().copied().map(to_pixels).collect::<Vec<_>>(), EXACT);
        let inside = law.validity().check(bridge).is_ok();
        let pen = if inside { LAW } else { OUTSIDE };
        svg.polyline(&lawful.map(to_pixels).collect::<Vec<_>>(), pen);
        svg.text([left + CELL[0] - 22.0, top + 16.0], Anchor::End, 12.0, law.name());
    }
    Ok(svg.finish())
}

fn head(svg: &mut Svg, name: &str, bridge: &Bridge, exact: &ExactBridge) {
    let [first, second] = bridge.contact_angles().map(f64::to_degrees);
    let title = format!(
        "{}: radii {:.4} and {:.4} mm, θ = {first:.0}° and {second:.0}°, V* = {:.2e}, S_rup = {:.3e} mm",
        name.to_uppercase(),
        bridge.radius() * 1e3,
        bridge.mate().radius() * 1e3,
        bridge.v_star(),
        exact.rupture().distance * 1e3,
    );
    svg.text([EDGE[0], 22.0], Anchor::Start, 14.0, &title);
    let key =
        "thick grey: exact bridge; black: the law, dashed where it is outside its stated range";
    svg.text([EDGE[0], 42.0], Anchor::Start, 12.0, key);
}
