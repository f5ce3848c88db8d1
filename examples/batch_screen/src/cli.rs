//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

pub(crate) use pendular::dem::MOST_THREADS;

/// What is no number; which numbers are allowed is said where they are used.
fn threads(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| format!("allowed: 1 to {MOST_THREADS}"))
}

fn from_one(text: &str) -> Result<usize, String> {
    text.parse().map_err(|_| "allowed: a whole number from 1".into())
}

/// What `compare` writes over, so that it cannot be a scene or a table.
fn page(name: &str) -> Result<PathBuf, String> {
    ending(name, "html")
}

fn drawing(name: &str) -> Result<PathBuf, String> {
    ending(name, "svg")
}

fn ending(name: &str, wanted: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(name);
    if path.extension().is_some_and(|end| end.eq_ignore_ascii_case(wanted)) {
        return Ok(path);
    }
    Err(format!("allowed: a name that ends in .{wanted}; a file of that name is replaced"))
}

/// Whole numbers of TOML end there: a seed stands in the scene that a run leaves behind.
fn seed(text: &str) -> Result<u64, String> {
    let number = text.parse::<i64>().ok().and_then(|seed| u64::try_from(seed).ok());
    number.ok_or_else(|| format!("allowed: a whole number from 0 to {}", i64::MAX))
}

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
    /// Writes the commented demo scene to a file, to start from.
    Sample {
        /// The file; `scene.toml` or `sweep.toml` where it is left out.
        file: Option<PathBuf>,
        /// Writes a commented sweep instead.
        #[arg(long)]
        sweep: bool,
        /// Replaces a file that exists.
        #[arg(long)]
        overwrite: bool,
    },
    /// Checks a scene and prints what follows from it, without running it.
    Check {
        /// A scene file or the name of a built-in scene.
        scene: String,
        /// Takes another value for a key of the scene, as in `run`.
        #[arg(long, value_name = "KEY=VALUE")]
        set: Vec<String>,
        /// Simulated time, s, instead of the scene's.
        #[arg(long, value_name = "S", allow_hyphen_values = true)]
        time: Option<f64>,
        /// Time step, s, instead of the scene's.
        #[arg(long, value_name = "S", allow_hyphen_values = true)]
        dt: Option<f64>,
    },
    /// Proposes the smallest scene that gives the same result, with evidence from short runs.
    Needs {
        /// A scene file or the name of a built-in scene.
        scene: String,
        /// Largest difference that does not matter: of the fraction retained and of the shares of
        /// the liquid; also the largest share of the impulse of a force that may be left out.
        #[arg(long, value_name = "X", default_value_t = 0.02, allow_hyphen_values = true)]
        tolerance: f64,
        /// Simulated time of each pilot run, s.
        #[arg(long, value_name = "S", default_value_t = 0.5, allow_hyphen_values = true)]
        time: f64,
        /// Folder of settled beds, to be used again; `out/beds` where it is left out.
        #[arg(long, value_name = "DIR")]
        beds: Option<PathBuf>,
        /// Threads. All cores where it is left out.
        #[arg(long, value_name = "N", value_parser = threads, allow_hyphen_values = true)]
        threads: Option<usize>,
    },
    /// Runs a scene.
    Run(RunArgs),
    /// Goes on with a run from its last checkpoint.
    Resume {
        /// Folder of the run.
        folder: PathBuf,
        #[command(flatten)]
        how: How,
    },
    /// Runs a scene many times with other values, into one table.
    Sweep(SweepArgs),
    /// Makes report.html from the tables of a run, whole or not.
    Report {
        /// Folder of the run.
        folder: PathBuf,
    },
    /// Overlays runs on one page.
    Compare {
        /// Folders of the runs.
        #[arg(required = true)]
        folders: Vec<PathBuf>,
        /// The page.
        #[arg(long, default_value = "compare.html", value_name = "FILE", value_parser = page)]
        out: PathBuf,
        /// Draws the fraction retained over time into an SVG file too.
        #[arg(long, value_name = "FILE", value_parser = drawing)]
        svg: Option<PathBuf>,
        /// What the drawing shows: `total` or the name of a class.
        #[arg(long, value_name = "NAME", default_value = "total", requires = "svg")]
        of: String,
    },
}

/// What a run takes.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct RunArgs {
    /// A scene file or the name of a built-in scene.
    #[arg(default_value = "demo")]
    pub(crate) scene: String,
    /// Simulated time, s, instead of the scene's.
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub(crate) time: Option<f64>,
    /// Time step, s, instead of the scene's.
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub(crate) dt: Option<f64>,
    /// Folder for the results, which must not hold a run. `out/NAME` where it is left out, or if
    /// that is taken the first free one of `out/NAME-2`, `out/NAME-3`, ...
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replaces the run that the folder holds; without --out that is `out/NAME`.
    #[arg(long)]
    pub(crate) overwrite: bool,
    /// Folder of settled beds, to be used again; `out/beds` where it is left out.
    #[arg(long, value_name = "DIR")]
    pub(crate) beds: Option<PathBuf>,
    /// Seed of the packing, instead of the scene's.
    #[arg(long, value_name = "N", value_parser = seed, allow_hyphen_values = true)]
    pub(crate) seed: Option<u64>,
    /// Takes another value for a key of the scene, such as `liquid.moisture_percent=10` or
    /// `classes[0].count=50`; may be given more than once.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(crate) set: Vec<String>,
    /// Runs above the stability limit too, for studies of it.
    #[arg(long)]
    pub(crate) allow_unstable: bool,
    /// Writes ParaView files into the folder `paraview`, every S seconds of simulated time.
    #[arg(long, value_name = "S", allow_hyphen_values = true)]
    pub(crate) vtk: Option<f64>,
    #[command(flatten)]
    pub(crate) how: How,
}

/// What a sweep takes.
#[derive(Debug, Args)]
pub(crate) struct SweepArgs {
    /// The sweep file; `sample --sweep` writes one.
    pub(crate) file: PathBuf,
    /// Folder for the table and the runs; `out/NAME` where it is left out.
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Folder of settled beds, to be used again; `beds` beside the runs where it is left out.
    #[arg(long, value_name = "DIR")]
    pub(crate) beds: Option<PathBuf>,
    /// Runs side by side; the cores are shared among them.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 1,
        value_parser = from_one,
        allow_hyphen_values = true
    )]
    pub(crate) jobs: usize,
    /// Prints the commands for a cluster's job array, or one a line, instead of running.
    #[arg(long, value_enum, conflicts_with_all = ["only", "gather"])]
    pub(crate) emit: Option<Emit>,
    /// Runs the N-th run only, from 1, and leaves the table alone.
    #[arg(long, value_name = "N", conflicts_with = "gather", value_parser = from_one,
        allow_hyphen_values = true)]
    pub(crate) only: Option<usize>,
    /// Runs nothing: makes the table of what there is.
    #[arg(long)]
    pub(crate) gather: bool,
    #[command(flatten)]
    pub(crate) how: How,
}

/// Commands to print.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Emit {
    /// A script for sbatch, with a job array.
    Slurm,
    /// A command a line.
    List,
}

/// How a run is carried out.
#[derive(Debug, Clone, Default, Args)]
pub(crate) struct How {
    /// Threads; results do not depend on them. All cores where it is left out.
    #[arg(long, value_name = "N", value_parser = threads, allow_hyphen_values = true)]
    pub(crate) threads: Option<usize>,
    /// Wall time between checkpoints, s.
    #[arg(long, value_name = "S", default_value_t = 300.0, allow_hyphen_values = true)]
    pub(crate) checkpoint_every: f64,
    /// Tells no progress, only the results at the end.
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Tells progress and the end as a JSON object a line.
    #[arg(long, conflicts_with = "quiet")]
    pub(crate) json: bool,
}
