//! Moist batch screening: spheres with liquid on a vibrating wire screen.

mod build;
mod builtin;
mod check;
mod cli;
mod error;
mod makeup;
mod packing;
mod page;
mod progress;
mod report;
mod run;
mod scene;
mod screening;
mod tables;
mod tally;
mod vtk;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;

use crate::build::Source;
use crate::cli::{Cli, Command, RunArgs};
use crate::error::{RunError, SceneError};
use crate::progress::Progress;
use crate::scene::Scene;

fn main() -> ExitCode {
    let cli = Cli::parse();
    let done = match cli.command.unwrap_or_else(|| Command::Run(RunArgs::default())) {
        Command::List => list(),
        Command::Show { name } => show(&name),
        Command::Check { scene } => check_scene(&scene),
        Command::Run(args) => run_scene(&args),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            // 2: the input is wrong; 3: the run went wrong; 1: the results cannot be written.
            ExitCode::from(match error {
                RunError::Scene(_) => 2,
                RunError::Simulation(_) => 3,
                RunError::Write { .. } => 1,
            })
        }
    }
}

fn list() -> Result<(), RunError> {
    for (name, text) in builtin::SCENES {
        let scene = Scene::parse(text, Path::new(name))?;
        println!("{name:<8} {}", scene.title);
    }
    Ok(())
}

fn show(name: &str) -> Result<(), RunError> {
    let text = builtin::find(name).ok_or_else(|| unknown(name))?;
    print!("{text}");
    Ok(())
}

fn unknown(name: &str) -> SceneError {
    SceneError::Unknown { name: name.to_owned(), known: builtin::names() }
}

/// The scene, the folder its paths are relative to, and its name for the output folder.
fn load(name: &str) -> Result<(Scene, PathBuf, String), SceneError> {
    if let Some(text) = builtin::find(name) {
        let scene = Scene::parse(text, Path::new(name))?;
        return Ok((scene, PathBuf::new(), name.to_owned()));
    }
    let path = Path::new(name);
    if !path.exists() {
        return Err(unknown(name));
    }
    let scene = Scene::read(path)?;
    let base = path.parent().map(Path::to_path_buf).unwrap_or_default();
    let stem = path.file_stem().map_or_else(|| "run".into(), |s| s.to_string_lossy().into_owned());
    Ok((scene, base, stem))
}

fn check_scene(name: &str) -> Result<(), RunError> {
    let (scene, base, _) = load(name)?;
    let source = Source { base: &base, beds: None, threads: 1 };
    let built = build::build(&scene, &source)?;
    println!("{}", report::header(&scene, &built));
    let limit = build::limit(&built);
    let share = 100.0 * built.settings.time_step / limit.time_step;
    let class = &scene.classes[limit.class].name;
    println!(
        "  limit        {:.3e} s, set by the {} of class {class}; the time step is {share:.0} % of it",
        limit.time_step, limit.term
    );
    if share > 100.0 {
        let source = pendular::dem::SimulationError::TimeStep {
            time_step: built.settings.time_step,
            allowed: limit.time_step,
            class: limit.class,
            radius: 0.5e-3 * scene.classes[limit.class].diameter_mm,
            term: limit.term,
        };
        return Err(SceneError::Simulation(source).into());
    }
    Ok(())
}

fn run_scene(args: &RunArgs) -> Result<(), RunError> {
    let (mut scene, base, name) = load(&args.scene)?;
    scene.time = args.time.unwrap_or(scene.time);
    scene.time_step = args.dt.or(scene.time_step);
    scene.seed = args.seed.unwrap_or(scene.seed);
    check::check(&scene, Path::new("command line"))?;
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = args.threads.unwrap_or(cores).max(1);
    let out = args.out.clone().unwrap_or_else(|| Path::new("out").join(&name));
    let beds = args.beds.clone().unwrap_or_else(|| Path::new("out").join("beds"));
    let source = Source { base: &base, beds: Some(&beds), threads };
    let built = build::build(&scene, &source)?;
    println!("{}", report::header(&scene, &built));
    let (settings, derived) = (built.settings, built.derived.clone());
    let parts: Vec<String> = built.walls.0.parts().iter().map(|part| part.name.clone()).collect();
    let outcome = run::run(&scene, built, &out, &Progress::new(scene.time))?;
    println!("{}", report::table(&scene, &derived, &outcome));
    let path = out.join("summary.json");
    report::summary(&path, &scene, &args.scene, &settings, &derived, &outcome, &parts)?;
    println!("results in {}", out.display());
    Ok(())
}
