//! Moist batch screening: spheres with liquid on a vibrating wire screen.

mod auto;
mod budget;
mod build;
mod builtin;
mod check;
mod checkpoint;
mod cli;
mod commands;
mod error;
mod frames;
mod limits;
mod makeup;
mod needs;
mod packing;
mod page;
mod pilot;
mod progress;
mod report;
mod run;
mod scene;
mod screening;
mod tables;
mod tally;
mod vtk;

use std::process::ExitCode;

use clap::Parser;

use crate::cli::{Cli, Command};
use crate::error::RunError;

fn main() -> ExitCode {
    let cli = match Cli::parse() {
        Cli { command: None } => Cli::parse_from(["batch_screen", "run"]),
        cli => cli,
    };
    let Some(command) = cli.command else { return ExitCode::FAILURE };
    let done = match command {
        Command::List => commands::list(),
        Command::Show { name } => commands::show(&name),
        Command::Sample { file } => commands::sample(&file),
        Command::Check { scene } => commands::check(&scene),
        Command::Needs { scene, tolerance, time, beds, threads } => {
            commands::needs(&scene, tolerance, time, beds.as_deref(), threads)
        }
        Command::Run(args) => commands::run(&args),
        Command::Resume { folder, how } => commands::resume(&folder, &how),
        Command::Report { folder } => commands::report(&folder),
        Command::Compare { folders, out } => commands::compare(&folders, &out),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            // 2: the input is wrong; 3: the run went wrong; 130: stopped by a signal; 1: the rest.
            ExitCode::from(match error {
                RunError::Scene(_) => 2,
                RunError::Simulation(_) | RunError::Unstable { .. } => 3,
                RunError::Stopped { .. } => 130,
                _ => 1,
            })
        }
    }
}
