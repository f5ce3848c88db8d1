//! Evaluates every law of the workspace on CSV tables, and charts their error against their cost.

mod advise;
mod chart;
mod cli;
mod contact;
mod force;
mod laws;
mod rupture;
mod status;
mod table;
mod transfer;

use std::io::{self, BufWriter, Write};
use std::process::ExitCode;

use clap::Parser;
use pendular_capillary::advise::AdviseError;

use crate::chart::ChartError;
use crate::cli::{Cli, Command};
use crate::table::TableError;

fn main() -> ExitCode {
    let cli = Cli::parse();
    match run(cli.command) {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever reads our output has seen enough.
        Err(Fault::Table(TableError::Write(error)))
            if error.kind() == io::ErrorKind::BrokenPipe =>
        {
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            // 2: the input is wrong; 1: it cannot be read or the results cannot be written.
            let malformed = match &error {
                Fault::Table(error) => error.is_malformed(),
                Fault::Advise(_) => true,
                Fault::Chart(_) => false,
            };
            ExitCode::from(if malformed { 2 } else { 1 })
        }
    }
}

/// Why a command failed.
#[derive(Debug, thiserror::Error)]
enum Fault {
    #[error(transparent)]
    Table(#[from] TableError),
    #[error(transparent)]
    Chart(#[from] ChartError),
    #[error(transparent)]
    Advise(#[from] AdviseError),
}

/// Runs a command from stdin to stdout. Rows before a fault are written before it is told.
fn run(command: Command) -> Result<(), Fault> {
    let input = io::stdin().lock();
    let mut output = BufWriter::new(io::stdout().lock());
    let done = match command {
        Command::Force { law, strict } => force::run(law, strict, input, &mut output),
        Command::Rupture { law, strict } => rupture::run(law, strict, input, &mut output),
        Command::Transfer { method, strict } => transfer::run(method, strict, input, &mut output),
        Command::Contact { model } => contact::run(model, input, &mut output),
        Command::Laws => laws::run(&mut output),
        Command::Advise(question) => {
            let answer = advise::run(&question, &mut output).and_then(|answer| {
                output.flush()?;
                Ok(answer)
            });
            return Ok(answer.map_err(TableError::Write)??);
        }
        Command::Chart { out } => return Ok(chart::run(&out, &mut output)?),
    };
    output.flush().map_err(TableError::Write)?;
    Ok(done?)
}
