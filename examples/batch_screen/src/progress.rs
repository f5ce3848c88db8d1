//! The live line of a run.

use std::cell::Cell;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};
use pendular::MeshWalls;
use pendular::dem::Simulation;

use crate::makeup::Makeup;
use crate::tally::Tally;

/// Time between renewals of the line, s.
const RENEW: f64 = 0.2;

/// A bar on the terminal; silent where there is none.
pub(crate) struct Progress {
    bar: ProgressBar,
    last: Cell<f64>,
}

impl Progress {
    /// A bar over `time` s of simulated time.
    pub(crate) fn new(time: f64) -> Self {
        let bar = ProgressBar::new((1e6 * time).round() as u64);
        let template = "{bar:28} {percent:>3} %  {msg}";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Self { bar, last: Cell::new(0.0) }
    }

    /// Renews the line, not too often.
    pub(crate) fn step<T: Makeup>(
        &self,
        simulation: &Simulation<T, MeshWalls>,
        passed: &[u64],
        end: f64,
        start: Instant,
    ) {
        let elapsed = start.elapsed().as_secs_f64();
        if elapsed - self.last.get() < RENEW {
            return;
        }
        self.last.set(elapsed);
        let time = simulation.time();
        let above = simulation.particles().len() as u64;
        let total = above + passed.iter().sum::<u64>();
        let bridges = simulation
            .term()
            .wet()
            .map_or(String::new(), |wet| format!("{} bridges, ", wet.alive()));
        let speed = simulation.step() as f64 / elapsed;
        let left = elapsed * (end - time) / time.max(1e-12);
        self.bar.set_position((1e6 * time) as u64);
        self.bar.set_message(format!(
            "t = {time:.3} of {end} s, {above} of {total} above, {bridges}{speed:.0} steps/s, \
             {left:.0} s left"
        ));
    }

    /// A row of results was written: said where no bar can be seen.
    pub(crate) fn row(&self, tally: &Tally) {
        if self.bar.is_hidden() {
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
