//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Moist batch screening with the discrete element method.
///
/// Without a command it runs the built-in scene `demo`.
#[derive(Debug, Parser)]
#[command(version, about)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Lists the built-in scenes.
    List,
    /// Prints a built-in scene, to be changed and run.
    Show {
        /// Name of the scene.
        name: String,
    },
    /// Checks a scene and prints what follows from it, without running it.
    Check {
        /// A scene file or the name of a built-in scene.
        scene: String,
    },
    /// Runs a scene.
    Run(RunArgs),
}

#[derive(Debug, Args)]
pub(crate) struct RunArgs {
    /// A scene file or the name of a built-in scene.
    #[arg(default_value = "demo")]
    pub(crate) scene: String,
    /// Simulated time, s, instead of the scene's.
    #[arg(long, value_name = "S")]
    pub(crate) time: Option<f64>,
    /// Time step, s, instead of the scene's.
    #[arg(long, value_name = "S")]
    pub(crate) dt: Option<f64>,
    /// Threads; results do not depend on them. All cores where it is left out.
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,
    /// Folder for the results; `out/NAME` where it is left out.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Folder of settled beds, to be used again; `out/beds` where it is left out.
    #[arg(long, value_name = "DIR")]
    pub(crate) beds: Option<PathBuf>,
    /// Seed of the packing, instead of the scene's.
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
}

impl Default for RunArgs {
    fn default() -> Self {
        let scene = "demo".to_owned();
        Self { scene, time: None, dt: None, threads: None, out: None, beds: None, seed: None }
    }
}
