//! What can be wrong with a run.

use std::path::PathBuf;

/// What is wrong with a scene.
#[derive(Debug, thiserror::Error)]
pub(crate) enum SceneError {
    #[error("cannot read {}: {source}", file.display())]
    Unreadable { file: PathBuf, source: std::io::Error },
    #[error("cannot write {}: {source}", file.display())]
    Unwritable { file: PathBuf, source: std::io::Error },
    #[error("{}: key `{key}`: {message}", file.display())]
    Syntax { file: PathBuf, key: String, message: String },
    #[error("{}: key `{key}`: {value} is not allowed; allowed: {allowed}", file.display())]
    Value { file: PathBuf, key: String, value: String, allowed: String },
    #[error("no built-in scene and no file is called `{name}`; built in: {known}")]
    Unknown { name: String, known: String },
    #[error("{}, line {line}: {message}", file.display())]
    Csv { file: PathBuf, line: u64, message: String },
    #[error(
        "time step {time_step:.3e} s is above the limit {allowed:.3e} s that class {class} sets \
         through the {term}"
    )]
    TimeStep { time_step: f64, allowed: f64, class: String, term: &'static str },
    #[error("the particles do not fit: {message}")]
    Packing { message: String },
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
    #[error("cannot go on with {}: {source}", path.display())]
    Table { path: PathBuf, source: std::io::Error },
    #[error(transparent)]
    Checkpoint(#[from] crate::checkpoint::CheckpointError),
    #[error(transparent)]
    Page(#[from] crate::page::PageError),
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
    #[error("the run stopped: {0}")]
    Simulation(pendular::dem::SimulationError),
}
