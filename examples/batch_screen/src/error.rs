//! What can be wrong with a run.

use std::path::PathBuf;

use crate::page::PageError;
use crate::place::Place;

/// What is wrong with a scene.
#[derive(Debug, thiserror::Error)]
pub(crate) enum SceneError {
    #[error("cannot read {}: {source}", file.display())]
    Unreadable { file: PathBuf, source: std::io::Error },
    #[error("{place}: is no UTF-8 text; allowed: TOML saved as UTF-8")]
    NotText { place: Place },
    #[error(
        "{place}: there is no key in the file; allowed: a scene, such as `batch_screen sample` writes"
    )]
    Empty { place: Place },
    #[error("cannot write {}: {source}", file.display())]
    Unwritable { file: PathBuf, source: std::io::Error },
    #[error("{place}: key `{key}`: {message}")]
    Syntax { place: Place, key: String, message: String },
    #[error("{place}: key `{key}`: {value} is not allowed; allowed: {allowed}")]
    Value { place: Place, key: String, value: String, allowed: String },
    #[error("{place}: key `{key}`: {source}")]
    At { place: Place, key: String, source: Box<SceneError> },
    #[error(
        "command line, --set: `{argument}` has no {missing}; allowed: KEY=VALUE, such as \
         liquid.viscosity=2e-3"
    )]
    SetForm { argument: String, missing: &'static str },
    #[error("no built-in scene and no file is called `{name}`; built in: {known}")]
    Unknown { name: String, known: String },
    #[error("{}, line {line}: {message}", file.display())]
    Csv { file: PathBuf, line: u64, message: String },
    #[error(
        "{place}: key `time_step`: {time_step:.3e} s is above the limit {allowed:.3e} s that class \
         {class} sets through the {term}; allowed: up to the limit; for studies of it, \
         `run --allow-unstable` goes above"
    )]
    TimeStep { place: Place, time_step: f64, allowed: f64, class: String, term: &'static str },
    #[error(
        "stopped as asked while the bed was settling, at t = {time:.4} s of it; the same command \
         goes on from there"
    )]
    Settling { time: f64 },
    #[error("{} is not what it was when the run began; allowed: the same file", file.display())]
    OtherFile { file: PathBuf },
    #[error(
        "part `{part}` reaches into the bed, which fills the frame from {:.2} mm to at least {:.2} mm \
         above the wire axes at the start; allowed: a part outside that space",
        1e3 * floor, 1e3 * top
    )]
    PartInBed { part: String, floor: f64, top: f64 },
    #[error(transparent)]
    Checkpoint(#[from] crate::checkpoint::CheckpointError),
    #[error("the particles do not fit: {message}")]
    Packing { message: String },
    #[error(
        "{first} overlaps {second} by {:.4} mm at the start; allowed: up to {:.4} mm",
        1e3 * overlap, 1e3 * allowed
    )]
    StartOverlap { first: String, second: String, overlap: f64, allowed: f64 },
    #[error("walls: {0}")]
    Walls(#[from] pendular::walls::WallError),
    #[error("particles: {0}")]
    Particles(#[from] pendular::dem::ParticleError),
    #[error("contact: {0}")]
    Contact(#[from] pendular::contact::ContactError),
    #[error("liquid: {0}")]
    Liquid(#[from] pendular::WetError),
    #[error("{0}")]
    Simulation(#[from] pendular::dem::SimulationError),
}

/// Why a run ended early.
#[derive(Debug, thiserror::Error)]
pub(crate) enum RunError {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error("cannot write {}: {source}", path.display())]
    Write { path: PathBuf, source: std::io::Error },
    #[error(
        "{} exists already and is left as it is; allowed: a name that is free, or --overwrite",
        path.display()
    )]
    Exists { path: PathBuf },
    #[error(
        "command line, --out: {0} holds a run already, which is left as it is; allowed: another --out, \
         --overwrite to replace that run, or `batch_screen resume {0}` to go on with it",
        folder.display()
    )]
    HoldsRun { folder: PathBuf },
    #[error(
        "{} is being written by another run or sweep; allowed: another folder, or this one once that \
         has ended",
        folder.display()
    )]
    Busy { folder: PathBuf },
    #[error(
        "{} is no scene of an earlier run and is left as it is: a run writes a file of that name; \
         allowed: another --out",
        path.display()
    )]
    SceneOfUser { path: PathBuf },
    #[error("cannot go on with {}: {source}", path.display())]
    Table { path: PathBuf, source: std::io::Error },
    #[error(transparent)]
    Checkpoint(#[from] crate::checkpoint::CheckpointError),
    #[error(transparent)]
    Page(#[from] PageError),
    #[error(transparent)]
    ParaView(#[from] crate::vtk::VtkError),
    #[error("stopped as asked; go on with: batch_screen resume {}", folder.display())]
    Stopped { folder: PathBuf },
    #[error(
        "the run stopped at t = {time:.6} s: the packing has become stiffer than the time step allows: \
         {time_step:.3e} s is above {allowed:.3e} s, set by the {term} of class {class}; run it again \
         with a smaller time step"
    )]
    Unstable { time: f64, time_step: f64, allowed: f64, class: String, term: &'static str },
    #[error("{failed} of {runs} runs failed; sweep.csv says why")]
    Sweep { failed: usize, runs: usize },
    #[error("stopped as asked with {waiting} runs to go; the same command goes on with them")]
    SweepStopped { waiting: usize },
    #[error(
        "{} holds a run of another scene, seed or time: remove it, or choose another --out",
        folder.display()
    )]
    OtherRun { folder: PathBuf },
    #[error(
        "{} holds a run of another {}, which has changed since (key `{key}`): remove the folder, to run \
         it again, or choose another --out",
        folder.display(), file.display()
    )]
    OtherFile { folder: PathBuf, key: String, file: PathBuf },
    #[error(
        "the run stopped at t = {:.6} s: {}\n  what to do: {}\n  the tables in {} hold what was \
         until then; the last checkpoint, of t = {saved:.6} s, is kept",
        fault.time, fault.what, fault.advice, folder.display()
    )]
    Guard { fault: crate::guard::Fault, folder: PathBuf, saved: f64 },
}

impl RunError {
    /// The program's exit code. 2: the input is wrong; 3: the run went wrong; 130: stopped by a
    /// signal; 1: the rest.
    pub(crate) fn code(&self) -> u8 {
        match self {
            Self::Scene(SceneError::Settling { .. }) => 130,
            Self::Scene(SceneError::Unreadable { .. } | SceneError::Unwritable { .. }) => 1,
            Self::Scene(_) | Self::Exists { .. } => 2,
            Self::HoldsRun { .. } | Self::Busy { .. } | Self::SceneOfUser { .. } => 2,
            Self::Page(PageError::Column { .. } | PageError::Nothing) => 2,
            Self::Guard { .. } | Self::Unstable { .. } => 3,
            Self::Stopped { .. } | Self::SweepStopped { .. } => 130,
            _ => 1,
        }
    }
}
