//! What the commands do.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use crate::build::{self, Built, Files, Source};
use crate::checkpoint::Checkpoint;
use crate::cli::{How, MOST_THREADS, RunArgs};
use crate::document::{self, Set};
use crate::error::{RunError, SceneError};
use crate::lock::Lock;
use crate::place::{Origin, Place};
use crate::progress::{Progress, Style};
use crate::run::{self, Job};
use crate::say;
use crate::scene::{Packing, Scene};
use crate::{auto, builtin, folder, limits, needs, page, progress, replace, report, signals};

/// Lists the built-in scenes.
pub(crate) fn list() -> Result<(), RunError> {
    for (name, text) in builtin::SCENES {
        let scene = Scene::parse(text, Path::new(name))?;
        say::line(format_args!("{name:<8} {}", scene.title));
    }
    Ok(())
}

/// Prints a built-in scene.
pub(crate) fn show(name: &str) -> Result<(), RunError> {
    let text = builtin::find(name).ok_or_else(|| unknown(name))?;
    say::product(text)
}

/// Writes the demo scene, or a sweep, to a file.
pub(crate) fn sample(file: Option<PathBuf>, sweep: bool, overwrite: bool) -> Result<(), RunError> {
    let (text, name, verb) = match sweep {
        true => (crate::sweep::SAMPLE, "sweep.toml", "sweep"),
        false => (builtin::find("demo").unwrap_or_default(), "scene.toml", "run"),
    };
    let path = file.unwrap_or_else(|| PathBuf::from(name));
    let written =
        if overwrite { fs::write(&path, text) } else { replace::create(&path, text.as_bytes()) };
    written.map_err(|source| match source.kind() {
        ErrorKind::AlreadyExists => RunError::Exists { path: path.clone() },
        _ => RunError::Write { path: path.clone(), source },
    })?;
    // A built-in scene goes before a file of its name.
    let hidden = !sweep && path.to_str().is_some_and(|name| builtin::find(name).is_some());
    let asked = if hidden { Path::new(".").join(&path) } else { path.clone() };
    let (path, asked) = (path.display(), asked.display());
    say::line(format_args!("wrote {path}; run it with: batch_screen {verb} {asked}"));
    Ok(())
}

fn unknown(name: &str) -> SceneError {
    SceneError::Unknown { name: name.to_owned(), known: builtin::names() }
}

/// A scene by file or built-in name.
struct Loaded {
    scene: Scene,
    text: String,
    /// Folder that its paths are relative to.
    base: PathBuf,
    /// Name for the output folder.
    name: String,
}

/// Text of a scene, by file or built-in name.
pub(crate) fn text(name: &str) -> Result<String, SceneError> {
    if let Some(text) = builtin::find(name) {
        return Ok(text.to_owned());
    }
    let path = Path::new(name);
    if !path.exists() {
        return Err(unknown(name));
    }
    let unreadable = |source| SceneError::Unreadable { file: path.to_path_buf(), source };
    document::decode(fs::read(path).map_err(unreadable)?, path)
}

fn load(name: &str, sets: &[Set]) -> Result<Loaded, SceneError> {
    let (path, text) = (Path::new(name), text(name)?);
    let mut origin = Origin::new(path, &text);
    let text = document::with(&text, &mut origin, sets)?;
    let scene = Scene::read(&text, origin)?;
    if builtin::find(name).is_some() {
        return Ok(Loaded { scene, text, base: PathBuf::new(), name: name.to_owned() });
    }
    let base = path.parent().map(Path::to_path_buf).unwrap_or_default();
    let stem = path.file_stem().map_or_else(|| "run".into(), |s| s.to_string_lossy().into_owned());
    Ok(Loaded { scene, text, base, name: stem })
}

/// The spheres where they are placed before they settle: enough to check a scene.
fn unsettled<'a>(base: &'a Path, stop: &'a AtomicBool) -> Source<'a> {
    let checkpoint_every = f64::INFINITY;
    Source { base, beds: None, threads: 1, style: Style::Silent, stop, checkpoint_every }
}

/// Checks a scene and says what follows from it.
pub(crate) fn check(
    name: &str,
    set: &[String],
    time: Option<f64>,
    dt: Option<f64>,
) -> Result<(), RunError> {
    let set = set.to_vec();
    let args = RunArgs { scene: name.to_owned(), set, time, dt, ..RunArgs::default() };
    let Loaded { scene, base, .. } = asked(&args)?;
    let built = build::build(&scene, &unsettled(&base, &AtomicBool::new(false)))?;
    crate::check::steps(&scene, built.settings.time_step)?;
    say::line(format_args!("{}", report::header(&scene, &built)));
    say::text(&limits::text(&limits::table(&scene, &built), built.settings.time_step));
    let limit = build::limit(&built);
    let share = 100.0 * built.settings.time_step / limit.time_step;
    let class = &scene.classes[limit.class].name;
    say::line(format_args!(
        "  limit        {:.3e} s, set by the {} of class {class}; the time step is {share:.0} % of it",
        limit.time_step, limit.term
    ));
    within_limit(&scene, &built)?;
    // Where a bed has to settle first, a run finds out what it overlaps then.
    if !matches!(scene.packing, Packing::Bin { .. }) {
        run::begins(&scene, built)?;
    }
    Ok(())
}

/// Refuses a time step above the stability limit.
fn within_limit(scene: &Scene, built: &Built) -> Result<(), SceneError> {
    let limit = build::limit(built);
    let time_step = built.settings.time_step;
    if time_step <= limit.time_step {
        return Ok(());
    }
    let (allowed, term) = (limit.time_step, limit.term);
    let class = scene.classes[limit.class].name.clone();
    let place = scene.origin.place("time_step");
    Err(SceneError::TimeStep { place, time_step, allowed, class, term })
}

/// Proposes the smallest scene that gives the same result.
pub(crate) fn needs(
    name: &str,
    tolerance: f64,
    time: f64,
    beds: Option<&Path>,
    threads: Option<usize>,
) -> Result<(), RunError> {
    let Loaded { mut scene, base, .. } = load(name, &[])?;
    crate::check::share("--tolerance", tolerance)?;
    crate::check::interval("--time", time)?;
    let kept = Path::new("out").join("beds");
    let beds = Some(beds.unwrap_or(&kept));
    let (threads, stop) = (count_threads(threads)?, AtomicBool::new(false));
    let source = Source { beds, threads, style: Style::People, ..unsettled(&base, &stop) };
    let decided = auto::decide(&scene, &source)?;
    auto::apply(&mut scene, &decided);
    needs::needs(scene, &source, time, tolerance, &|text| say::line(format_args!("{text}")))
}

/// Runs a scene.
pub(crate) fn run(args: &RunArgs) -> Result<(), RunError> {
    run_until(args, Style::of(&args.how), signals::stop_flag())
}

/// What `--set` says, one `KEY=VALUE` each.
fn sets(all: &[String]) -> Result<Vec<Set>, SceneError> {
    all.iter().map(|set| Set::parse(set)).collect()
}

/// The scene that the command line asks for.
fn asked(args: &RunArgs) -> Result<Loaded, SceneError> {
    let mut loaded = load(&args.scene, &sets(&args.set)?)?;
    let scene = &mut loaded.scene;
    scene.time = args.time.unwrap_or(scene.time);
    scene.time_step = args.dt.or(scene.time_step);
    scene.seed = args.seed.unwrap_or(scene.seed);
    let given = [("time", args.time.is_some()), ("time_step", args.dt.is_some())];
    for ((key, _), option) in given.iter().zip(["--time", "--dt"]).filter(|(given, _)| given.1) {
        scene.origin.give(key, Place::option(option));
    }
    crate::check::check(scene)?;
    args.vtk.map_or(Ok(()), |interval| crate::check::vtk(scene, interval))?;
    Ok(loaded)
}

/// Runs a scene until its end, or until `stop` is set.
pub(crate) fn run_until(
    args: &RunArgs,
    style: Style,
    stop: Arc<AtomicBool>,
) -> Result<(), RunError> {
    let Loaded { mut scene, text, base, name } = asked(args)?;
    folder::refuse(args.out.as_deref(), args.overwrite)?;
    let usual = Path::new("out").join(&name);
    folder::writable(args.out.as_deref().unwrap_or(&usual))?;
    let beds = args.beds.clone().unwrap_or_else(|| Path::new("out").join("beds"));
    let threads = threads(&args.how)?;
    // Refused before the bed is settled, which can take minutes.
    crate::check::interval("--checkpoint-every", args.how.checkpoint_every)?;
    let loose = build::build(&scene, &unsettled(&base, &stop))?;
    crate::check::steps(&scene, loose.settings.time_step)?;
    if !args.allow_unstable {
        within_limit(&scene, &loose)?;
    }
    let source = Source {
        base: &base,
        beds: Some(&beds),
        threads,
        style,
        stop: &stop,
        checkpoint_every: args.how.checkpoint_every,
    };
    let decided = auto::decide(&scene, &source)?;
    auto::apply(&mut scene, &decided);
    crate::check::laws(&scene)?;
    let mut built = build::build(&scene, &source)?;
    built.settings.allow_unstable = args.allow_unstable;
    let base = fs::canonicalize(if base.as_os_str().is_empty() { Path::new(".") } else { &base })
        .map_err(|source| RunError::Write { path: base.clone(), source })?;
    let out = folder::of_run(args.out.as_deref(), &usual, args.overwrite)?;
    let lock = Lock::take(&out)?;
    let job = Job {
        out,
        source: args.scene.clone(),
        text,
        base,
        vtk: args.vtk,
        checkpoint_every: args.how.checkpoint_every,
        stop,
        decided,
    };
    let done = finish(&scene, built, &job, None, style);
    if done.is_err() {
        // A run that could not begin leaves no empty folder; one with files in it stays.
        lock.leave(args.out.is_none());
    }
    done
}

/// Goes on with a run from its last checkpoint.
pub(crate) fn resume(folder: &Path, how: &How) -> Result<(), RunError> {
    resume_until(folder, how, Style::of(how), signals::stop_flag())
}

/// The checkpoint of a folder that nobody else writes into from now on.
fn taken(folder: &Path) -> Result<(Checkpoint, Lock), RunError> {
    // Where there is no run to go on with, nothing is made.
    Checkpoint::read(folder)?;
    let lock = Lock::take(folder)?;
    // Once more: until it was locked a run may have gone on.
    Ok((Checkpoint::read(folder)?, lock))
}

/// Refuses to go on with other parts than a run began with.
fn same_parts(scene: &Scene, checkpoint: &Checkpoint) -> Result<(), SceneError> {
    let now = Files::of_parts(scene, &checkpoint.base)?;
    checkpoint.files.other_part(scene, &now).map_or(Ok(()), |(key, file)| {
        Err(scene.at(&key, SceneError::OtherFile { file: file.clone() }))
    })
}

/// Goes on with a run until its end, or until `stop` is set.
pub(crate) fn resume_until(
    folder: &Path,
    how: &How,
    style: Style,
    stop: Arc<AtomicBool>,
) -> Result<(), RunError> {
    crate::check::interval("--checkpoint-every", how.checkpoint_every)?;
    let (checkpoint, _lock) = taken(folder)?;
    let mut scene = Scene::parse(&checkpoint.scene, Path::new(&checkpoint.source))?;
    scene.time = checkpoint.time;
    scene.time_step = Some(checkpoint.time_step);
    scene.seed = checkpoint.seed;
    auto::apply(&mut scene, &checkpoint.decided);
    let (class, files) = (checkpoint.class.clone(), checkpoint.files.clone());
    let mut built = build::again(&scene, &checkpoint.base, threads(how)?, class, files)?;
    built.settings.allow_unstable = checkpoint.allow_unstable;
    let finished = checkpoint.is_finished();
    if !finished {
        same_parts(&scene, &checkpoint)?;
    }
    match style {
        Style::People | Style::Quiet if finished => say::line(format_args!(
            "{} has finished already, at t = {:.4} s: there was nothing to be done",
            folder.display(),
            checkpoint.at()
        )),
        Style::People => {
            say::line(format_args!("going on from t = {:.4} s", checkpoint.at()));
        }
        _ => {}
    }
    let job = Job {
        out: folder.to_path_buf(),
        source: checkpoint.source.clone(),
        text: checkpoint.scene.clone(),
        base: checkpoint.base.clone(),
        vtk: checkpoint.vtk,
        checkpoint_every: how.checkpoint_every,
        stop,
        decided: checkpoint.decided.clone(),
    };
    finish(&scene, built, &job, Some(checkpoint), style)
}

fn finish(
    scene: &Scene,
    built: Built,
    job: &Job,
    from: Option<Checkpoint>,
    style: Style,
) -> Result<(), RunError> {
    let begins = !from.as_ref().is_some_and(Checkpoint::is_finished);
    if style == Style::People && begins {
        say::line(format_args!("{}", report::header(scene, &built)));
        if !job.decided.is_empty() {
            say::line(format_args!("  decided      {}", auto::text(&job.decided)));
        }
    }
    let derived = built.derived.clone();
    let outcome = run::run(scene, built, job, from, &Progress::new(scene.time, style));
    if let Err(RunError::Guard { .. }) = &outcome {
        // The page shows how it came to that; the fault is what there is to say.
        let _ = page::report(&job.out);
    }
    let outcome = outcome?;
    let results = matches!(style, Style::People | Style::Quiet);
    if results {
        say::line(format_args!("{}", report::table(scene, &derived, &outcome)));
    }
    let page = page::report(&job.out)?;
    if results {
        say::line(format_args!("results in {}, report in {}", job.out.display(), page.display()));
    }
    if style == Style::Json {
        let (retained, _) = report::retained_at_end(scene, &derived, &outcome);
        progress::done(&outcome.tally, retained, &job.out, &page);
    }
    Ok(())
}

/// Makes the report of a run.
pub(crate) fn report(folder: &Path) -> Result<(), RunError> {
    say::line(format_args!("{}", page::report(folder)?.display()));
    Ok(())
}

/// Overlays runs on one page.
pub(crate) fn compare(
    folders: &[PathBuf],
    out: &Path,
    drawing: Option<(&Path, &str)>,
) -> Result<(), RunError> {
    if let Some((path, column)) = drawing {
        page::drawing(folders, column, path)?;
        say::line(format_args!("{}", path.display()));
    }
    page::compare(folders, out)?;
    say::line(format_args!("{}", out.display()));
    Ok(())
}

fn threads(how: &How) -> Result<usize, SceneError> {
    count_threads(how.threads)
}

pub(crate) fn count_threads(asked: Option<usize>) -> Result<usize, SceneError> {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = asked.unwrap_or(cores);
    if (1..=MOST_THREADS).contains(&threads) {
        return Ok(threads);
    }
    Err(SceneError::Value {
        place: Place::option("--threads"),
        key: "threads".into(),
        value: threads.to_string(),
        allowed: format!("1 to {MOST_THREADS}"),
    })
}
