//! Moist batch screening: spheres with liquid on a vibrating wire screen.

mod assumed;
mod auto;
mod budget;
mod build;
mod builtin;
mod check;
mod checkpoint;
mod cli;
mod commands;
mod document;
mod effective;
mod error;
mod evidence;
mod folder;
mod forms;
mod frames;
mod guard;
mod limits;
mod liquid_final;
mod lock;
mod makeup;
mod needs;
mod notes;
mod packing;
mod page;
mod pilot;
mod place;
mod progress;
mod replace;
mod report;
mod run;
mod say;
mod scene;
#[cfg(test)]
mod scene_docs;
mod screening;
mod signals;
mod spent;
mod sweep;
mod tables;
mod tally;
mod unclosed;
mod vtk;

use std::io::Write;
use std::process::ExitCode;

use clap::Parser;

use crate::cli::{Cli, Command};

fn main() -> ExitCode {
    let cli = match Cli::parse() {
        Cli { command: None } => Cli::parse_from(["batch_screen", "run"]),
        cli => cli,
    };
    let Some(command) = cli.command else { return ExitCode::FAILURE };
    signals::survive_full_files();
    let done = match command {
        Command::List => commands::list(),
        Command::Show { name } => commands::show(&name),
        Command::Sample { file, sweep, overwrite } => commands::sample(file, sweep, overwrite),
        Command::Check { scene, set, time, dt } => commands::check(&scene, &set, time, dt),
        Command::Needs { scene, tolerance, time, beds, threads } => {
            commands::needs(&scene, tolerance, time, beds.as_deref(), threads)
        }
        Command::Run(args) => commands::run(&args),
        Command::Resume { folder, how } => commands::resume(&folder, &how),
        Command::Sweep(args) => sweep::sweep(&args),
        Command::Report { folder } => commands::report(&folder),
        Command::Compare { folders, out, svg, of } => {
            commands::compare(&folders, &out, svg.as_deref().map(|svg| (svg, of.as_str())))
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::from(error.code())
        }
    }
}
