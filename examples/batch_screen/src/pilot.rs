//! Short runs whose results are thrown away: evidence for decisions about a scene.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use cpu_time::ProcessTime;

use crate::build::{self, Source};
use crate::error::RunError;
use crate::progress::{Progress, Style};
use crate::run::{self, Job, Outcome};
use crate::scene::Scene;
use crate::tables::retained;

/// What a pilot run has shown.
#[derive(Debug)]
pub(crate) struct Pilot {
    /// Fraction retained.
    pub(crate) retained: f64,
    /// And that of each class.
    pub(crate) classes: Vec<f64>,
    /// Spheres of each class at the start.
    pub(crate) counts: Vec<u64>,
    /// Shares of all liquid: on walls, collected with the fines, in bridges.
    pub(crate) liquid: [f64; 3],
    /// Processor time of the run, s: what other programs do meanwhile does not count.
    pub(crate) seconds: f64,
    pub(crate) outcome: Outcome,
}

impl Pilot {
    /// Largest difference to another pilot in what a screening is asked for.
    pub(crate) fn differs(&self, other: &Self) -> f64 {
        let liquid = self.liquid.iter().zip(&other.liquid).map(|(a, b)| (a - b).abs());
        liquid.fold((self.retained - other.retained).abs(), f64::max)
    }
}

/// Runs a scene for its time; tables go to a folder that is removed at the end.
pub(crate) fn fly(scene: &Scene, source: &Source<'_>) -> Result<Pilot, RunError> {
    let built = build::build(scene, source)?;
    let folder = tempfile::tempdir()
        .map_err(|source| RunError::Write { path: std::env::temp_dir(), source })?;
    let job = Job {
        out: folder.path().to_path_buf(),
        source: String::from("pilot"),
        text: String::new(),
        base: PathBuf::new(),
        vtk: None,
        checkpoint_every: f64::MAX,
        stop: Arc::new(AtomicBool::new(false)),
        decided: Vec::new(),
    };
    let derived = built.derived.clone();
    let begun = ProcessTime::now();
    let style = if source.style == Style::Passing { Style::Passing } else { Style::Silent };
    let outcome = run::run(scene, built, &job, None, &Progress::new(scene.time, style))?;
    let seconds = begun.elapsed().as_secs_f64();
    let density = scene.liquid.as_ref().map_or(0.0, |liquid| liquid.density);
    let (retained, classes) = retained(&outcome.tally, &outcome.start, &derived.masses, density);
    let tally = &outcome.tally;
    let share = |volume: f64| if derived.liquid > 0.0 { volume / derived.liquid } else { 0.0 };
    let liquid = [tally.parts.iter().sum(), tally.fines.iter().sum(), tally.bridges].map(share);
    Ok(Pilot { retained, classes, counts: derived.counts, liquid, seconds, outcome })
}
