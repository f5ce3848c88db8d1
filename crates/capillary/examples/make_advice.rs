//! Measures the error of every law against the exact bridge, and its cost, for `advise`.
//!
//! `cargo run --release -p pendular-capillary --example make_advice -- [errors|costs]` from the
//! repository's root; without a word it makes both. It takes a minute, and wants a machine that
//! does nothing else while it measures costs. After a law was added run it and commit the files.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use pendular_capillary::{AnyCapillary, Bridge, CapillaryLaw, ForceCurve, Range, advise};

const FOLDER: &str = "crates/capillary/src/advise";

fn main() -> Result<(), Box<dyn Error>> {
    let what = std::env::args().nth(1);
    if what.as_deref() != Some("costs") {
        let errors = advise::measure_errors()?;
        std::fs::write(format!("{FOLDER}/errors.bin"), &errors)?;
        println!("errors.bin: {} bytes", errors.len());
    }
    if what.as_deref() != Some("errors") {
        let mut costs = format!("# law,ns per force,ns per curve; measured on {}\n", machine());
        for law in AnyCapillary::ALL {
            let (force, curve) = cost(law)?;
            costs += &format!("{law},{force:.1},{curve:.0}\n");
        }
        std::fs::write(format!("{FOLDER}/costs.csv"), &costs)?;
        print!("{costs}");
    }
    Ok(())
}

/// Nanoseconds per force and per curve: the least of several rounds.
fn cost(law: AnyCapillary) -> Result<(f64, f64), Box<dyn Error>> {
    let bridges = law.examples();
    let mut curves = Vec::new();
    for bridge in &bridges {
        curves.push((law.curve(bridge, Range::Strict)?, 0.3 * span(bridge)));
    }
    let slow = law == AnyCapillary::YoungLaplace;
    let (forces, folds) = if slow { (200, 20) } else { (200_000, 2000) };
    let gap = |span: f64, k: usize| span * ((k * 7919) % 1024) as f64 / 1024.0;
    let works: Vec<(_, Vec<f64>)> = curves
        .iter()
        .map(|&(curve, span)| (curve, (0..256).map(|k| gap(span, k)).collect()))
        .collect();
    let force = works.iter().map(|(curve, gaps)| least(forces, |k| curve.force(gaps[k & 255])));
    let force = force.sum::<f64>() / works.len() as f64;
    let curve = least(folds, |k| {
        let bridge = black_box(&bridges[k % bridges.len()]);
        law.curve(bridge, Range::Strict).map_or(0.0, |curve| curve.force(0.0))
    });
    Ok((force, curve))
}

/// A length of the order of the rupture distance.
fn span(bridge: &Bridge) -> f64 {
    bridge.volume().cbrt()
}

fn least(count: usize, work: impl Fn(usize) -> f64) -> f64 {
    let round = |_| {
        let start = Instant::now();
        for k in 0..count {
            black_box(work(k));
        }
        start.elapsed().as_secs_f64() * 1e9 / count as f64
    };
    (0..9).map(round).fold(f64::INFINITY, f64::min)
}

/// The processor's name where the system tells it.
fn machine() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = text.lines().find_map(|line| line.strip_prefix("model name")?.split(": ").nth(1));
    name.unwrap_or("an unnamed processor").replace(',', " ")
}
