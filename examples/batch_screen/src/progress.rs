//! The live line of a run: a bar on a terminal, plain lines elsewhere, JSON for other programs.

use std::cell::Cell;
use std::io::Write;
use std::path::Path;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use pendular::MeshWalls;
use pendular::dem::Simulation;
use serde_json::json;

use crate::makeup::Makeup;
use crate::tally::Tally;

/// Time between renewals of the line, s.
const RENEW: f64 = 0.2;

/// How progress is told.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// A bar on a terminal, else a line for each row of the results, both on stderr.
    People,
    /// A JSON object a line on stdout.
    Json,
    /// Nothing.
    Quiet,
}

/// The last line for other programs: the run has come to its end.
pub(crate) fn done(tally: &Tally, folder: &Path, page: &Path) {
    let line = json!({
        "done": true,
        "time_s": tally.time,
        "above": tally.above.iter().sum::<u64>(),
        "collected": tally.collected.iter().sum::<u64>(),
        "liquid_imbalance": tally.imbalance,
        "folder": folder,
        "report": page,
    });
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// Tells how far a run is.
pub(crate) struct Progress {
    style: Style,
    bar: ProgressBar,
    /// Wall time, steps and simulated time at the last renewal: the speed is a recent one.
    last: Cell<(Instant, u64, f64)>,
}

impl Progress {
    /// Over `time` s of simulated time.
    pub(crate) fn new(time: f64, style: Style) -> Self {
        let bar = ProgressBar::new((1e6 * time).round() as u64);
        if style != Style::People {
            bar.set_draw_target(ProgressDrawTarget::hidden());
        }
        let template = "{bar:28} {percent:>3} %  {msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Self { style, bar, last: Cell::new((Instant::now(), 0, 0.0)) }
    }

    /// Takes the speed from here on: what a run did before it was taken up again does not count.
    pub(crate) fn begin(&self, steps: u64, time: f64) {
        self.last.set((Instant::now(), steps, time));
        self.bar.set_position((1e6 * time) as u64);
    }

    /// Renews the line, not too often.
    pub(crate) fn step<T: Makeup>(
        &self,
        simulation: &Simulation<T, MeshWalls>,
        collected: &[u64],
        end: f64,
    ) {
        let (then, steps, before) = self.last.get();
        let passed = then.elapsed().as_secs_f64();
        if passed < RENEW {
            return;
        }
        let time = simulation.time();
        self.last.set((Instant::now(), simulation.step(), time));
        let speed = simulation.step().saturating_sub(steps) as f64 / passed;
        let left = passed * (end - time) / (time - before).max(1e-12);
        let above = simulation.particles().len() as u64;
        let total = above + collected.iter().sum::<u64>();
        let alive = simulation.term().wet().map(crate::build::WetTerm::alive);
        match self.style {
            Style::Quiet => {}
            Style::Json => {
                let line = json!({
                    "time_s": time,
                    "end_s": end,
                    "above": above,
                    "particles": total,
                    "bridges": alive,
                    "steps_per_s": speed,
                    "left_s": left,
                });
                // Whoever reads along may have gone: that is no reason to end the run.
                let _ = writeln!(std::io::stdout(), "{line}");
            }
            Style::People => {
                let bridges = alive.map_or(String::new(), |n| format!("{n} bridges, "));
                self.bar.set_position((1e6 * time) as u64);
                self.bar.set_message(format!(
                    "t = {time:.3} of {end} s, {above} of {total} above, {bridges}\
                     {speed:.0} steps/s, {left:.0} s left"
                ));
            }
        }
    }

    /// A row of results was written: said where no bar can be seen.
    pub(crate) fn row(&self, tally: &Tally) {
        if self.style == Style::People && self.bar.is_hidden() {
            let above: u64 = tally.above.iter().sum();
            let bridges = tally.alive();
            eprintln!("t = {:.3} s: {above} above the screen, {bridges} bridges", tally.time);
        }
    }

    /// Takes the line away.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
