//! The live line of a run: a bar on a terminal, plain lines elsewhere, JSON for other programs.

use std::cell::Cell;
use std::fmt;
use std::path::Path;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use pendular::MeshWalls;
use pendular::dem::Simulation;
use serde_json::json;

use crate::cli::How;
use crate::makeup::Makeup;
use crate::say;
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
    /// A bar on a terminal, taken away when it is done: for what is only part of a command.
    Passing,
    /// No progress, but the results at the end.
    Quiet,
    /// Nothing: a run of many, or one whose results are thrown away.
    Silent,
}

impl Style {
    /// Whether there is room for notes on what is not as it should be.
    pub(crate) fn has_notes(self) -> bool {
        !matches!(self, Self::Passing | Self::Silent)
    }

    /// What the command line asks for.
    pub(crate) fn of(how: &How) -> Self {
        match (how.quiet, how.json) {
            (true, _) => Self::Quiet,
            (_, true) => Self::Json,
            _ => Self::People,
        }
    }
}

/// The last line for other programs: the run has come to its end.
pub(crate) fn done(tally: &Tally, retained: f64, folder: &Path, page: &Path) {
    let line = json!({
        "done": true,
        "time_s": tally.time,
        "above": tally.above.iter().sum::<u64>(),
        "collected": tally.collected.iter().sum::<u64>(),
        "fraction_retained": retained,
        "liquid_imbalance": tally.imbalance,
        "folder": folder,
        "report": page,
    });
    say::line(format_args!("{line}"));
}

/// How far a bed has settled.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Settled {
    /// Simulated time of the settling, s, and the longest it may take.
    pub(crate) time: f64,
    pub(crate) at_most: f64,
    pub(crate) step: u64,
    pub(crate) spheres: usize,
    /// Energy of motion over that of a fall by one radius, and below what the bed is at rest.
    pub(crate) motion: f64,
    pub(crate) at_rest: f64,
}

impl fmt::Display for Settled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { time, at_most, motion, at_rest, .. } = self;
        write!(f, "settling: t = {time:.3} of at most {at_most} s, ")?;
        write!(f, "motion {motion:.1e}, at rest below {at_rest:.0e}")
    }
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
        if !matches!(style, Style::People | Style::Passing) {
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

    /// Steps per second since the last renewal and wall time to `end`, s; nothing if that was only
    /// just now.
    fn renew(&self, step: u64, time: f64, end: f64) -> Option<(f64, f64)> {
        let (then, steps, before) = self.last.get();
        let passed = then.elapsed().as_secs_f64();
        if passed < RENEW {
            return None;
        }
        self.last.set((Instant::now(), step, time));
        let speed = step.saturating_sub(steps) as f64 / passed;
        Some((speed, passed * (end - time) / (time - before).max(1e-12)))
    }

    /// Renews the line while a bed settles, not too often.
    pub(crate) fn settle(&self, at: &Settled) {
        let Some((speed, _)) = self.renew(at.step, at.time, at.at_most) else { return };
        self.bar.set_position((1e6 * at.time) as u64);
        self.bar.set_message(format!("{at}, {speed:.0} steps/s"));
        self.settle_json(at);
    }

    /// A bed begins to settle or has done so.
    pub(crate) fn settled(&self, at: &Settled) {
        self.settle_row(at);
        self.settle_json(at);
    }

    /// How far a bed is: said where no bar can be seen.
    pub(crate) fn settle_row(&self, at: &Settled) {
        if self.style == Style::People && self.bar.is_hidden() {
            say::note(format_args!("{at}"));
        }
    }

    fn settle_json(&self, at: &Settled) {
        if self.style == Style::Json {
            let line = json!({
                "settling": true,
                "time_s": at.time,
                "end_s": at.at_most,
                "particles": at.spheres,
                "motion": at.motion,
                "at_rest_below": at.at_rest,
            });
            say::line(format_args!("{line}"));
        }
    }

    /// Renews the line, not too often.
    pub(crate) fn step<T: Makeup>(
        &self,
        simulation: &Simulation<T, MeshWalls>,
        collected: &[u64],
        end: f64,
    ) {
        let time = simulation.time();
        let Some((speed, left)) = self.renew(simulation.step(), time, end) else { return };
        let above = simulation.particles().len() as u64;
        let total = above + collected.iter().sum::<u64>();
        let alive = simulation.term().wet().map(crate::build::WetTerm::alive);
        match self.style {
            Style::Quiet | Style::Silent => {}
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
                say::line(format_args!("{line}"));
            }
            Style::People | Style::Passing => {
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
            say::note(format_args!(
                "t = {:.3} s: {above} above the screen, {bridges} bridges",
                tally.time
            ));
        }
    }

    /// Takes the line away.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}
