//! Many runs of one scene with other values: side by side, taken up again, in one table.

mod emit;
mod plan;
mod table;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use self::plan::{Plan, Planned};
use self::table::{Sheet, Status};
use crate::build::Files;
use crate::checkpoint::Checkpoint;
use crate::cli::{Emit, How, RunArgs, SweepArgs};
use crate::commands;
use crate::error::{RunError, SceneError};
use crate::lock::Lock;
use crate::place::Place;
use crate::progress::Style;
use crate::say;
use crate::scene::Scene;

/// A commented sweep file to start from.
pub(crate) const SAMPLE: &str = include_str!("sample.toml");

/// What a folder holds of a run.
enum Found {
    Nothing,
    /// Not at its end.
    Part,
    /// Done, with its page.
    Whole,
}

/// A sweep that is being carried out.
struct Sweep<'a> {
    plan: &'a Plan,
    args: &'a SweepArgs,
    out: &'a Path,
    beds: PathBuf,
    how: How,
    stop: Arc<AtomicBool>,
}

/// Runs a sweep, or prints the commands for it.
pub(crate) fn sweep(args: &SweepArgs) -> Result<(), RunError> {
    let plan = Plan::read(&args.file)?;
    let out = args.out.clone().unwrap_or_else(|| Path::new("out").join(&plan.name));
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let jobs = jobs(args.jobs)?;
    let threads = commands::count_threads(args.how.threads.or(Some((cores / jobs).max(1))))?;
    match args.emit {
        Some(Emit::List) => say::product(&emit::list(&plan, args, &out, threads))?,
        Some(Emit::Slurm) => say::product(&emit::slurm(&plan, args, &out, threads))?,
        None => {
            let beds = args.beds.clone().unwrap_or_else(|| out.join("beds"));
            let how = How { threads: Some(threads), ..args.how.clone() };
            let stop = crate::signals::stop_flag();
            let sweep = Sweep { plan: &plan, args, out: &out, beds, how, stop };
            std::fs::create_dir_all(&out)
                .map_err(|source| RunError::Write { path: out.clone(), source })?;
            return match args.only {
                Some(number) => sweep.one(number),
                None => sweep.all(jobs),
            };
        }
    }
    Ok(())
}

fn jobs(asked: usize) -> Result<usize, SceneError> {
    if asked > 0 {
        return Ok(asked);
    }
    let (place, key) = (Place::option("--jobs"), "jobs".to_owned());
    let allowed = "a whole number from 1".to_owned();
    Err(SceneError::Value { place, key, value: asked.to_string(), allowed })
}

impl Sweep<'_> {
    /// Runs one run only and leaves the table alone, for those who run them side by side.
    fn one(&self, number: usize) -> Result<(), RunError> {
        let runs = &self.plan.runs;
        let Some(run) = number.checked_sub(1).and_then(|k| runs.get(k)) else {
            let (place, key) = (Place::option("--only"), String::from("only"));
            let (value, allowed) = (number.to_string(), format!("1 to {}", runs.len()));
            return Err(SceneError::Value { place, key, value, allowed }.into());
        };
        match self.found(run)? {
            Found::Whole => Ok(()),
            found => self.go(run, &found, Style::of(&self.how)),
        }
    }

    /// Runs all that is not done yet. Nobody else does so in this folder meanwhile; those who run
    /// one only leave the table alone, and each run's folder has a lock of its own.
    fn all(&self, jobs: usize) -> Result<(), RunError> {
        let _lock = Lock::take(self.out)?;
        let mut sheet = Sheet::new(self.out, self.plan)?;
        let mut left = Vec::new();
        for (row, run) in self.plan.runs.iter().enumerate() {
            let folder = self.out.join(&run.name);
            match self.found(run) {
                Ok(Found::Whole) => sheet.note(row, &folder, Status::Finished, Some(0), ""),
                Ok(Found::Part) if self.args.gather => {
                    match table::summary(&folder)["stopped_by_guard"].as_str() {
                        Some(why) => sheet.note(row, &folder, Status::Failed, Some(3), why),
                        None => sheet.note(row, &folder, Status::Interrupted, None, ""),
                    }
                }
                Ok(_) => left.push(row),
                Err(error) => {
                    let code = Some(error.code());
                    sheet.note(row, &folder, Status::Failed, code, &error.to_string());
                }
            }
        }
        sheet.write()?;
        let done = self.plan.runs.len() - left.len();
        if !self.args.gather {
            self.tell(&format!("{} runs, {done} of them done", self.plan.runs.len()));
            sheet = self.side_by_side(&left, sheet, jobs)?;
        }
        self.end(&sheet);
        let (failed, waiting) = (sheet.count(Status::Failed), sheet.count(Status::Waiting));
        if self.stop.load(Ordering::Relaxed) {
            return Err(RunError::SweepStopped {
                waiting: waiting + sheet.count(Status::Interrupted),
            });
        }
        if failed > 0 {
            return Err(RunError::Sweep { failed, runs: self.plan.runs.len() });
        }
        Ok(())
    }

    /// Says where the table is, and how many runs stand how.
    fn end(&self, sheet: &Sheet) {
        let table = self.out.join("sweep.csv");
        if !self.how.json {
            say::line(format_args!("table in {}", table.display()));
            return;
        }
        let mut line = serde_json::json!({ "table": table, "runs": self.plan.runs.len() });
        for status in [Status::Finished, Status::Failed, Status::Interrupted, Status::Waiting] {
            line[status.name()] = sheet.count(status).into();
        }
        say::line(format_args!("{line}"));
    }

    fn side_by_side(&self, left: &[usize], sheet: Sheet, jobs: usize) -> Result<Sheet, RunError> {
        let next = AtomicUsize::new(0);
        let sheet = Mutex::new((sheet, None));
        let work = || {
            while let Some(&row) = left.get(next.fetch_add(1, Ordering::Relaxed)) {
                if self.stop.load(Ordering::Relaxed) {
                    break;
                }
                let run = &self.plan.runs[row];
                let done = self.safely(run);
                let mut held = sheet.lock().unwrap_or_else(PoisonError::into_inner);
                let (sheet, failed) = &mut *held;
                self.book(sheet, row, run, done);
                *failed = sheet.write().err().or(failed.take());
            }
        };
        std::thread::scope(|scope| {
            (0..jobs.min(left.len())).for_each(|_| drop(scope.spawn(work)));
        });
        let (sheet, failed) = sheet.into_inner().unwrap_or_else(PoisonError::into_inner);
        failed.map_or(Ok(sheet), Err)
    }

    /// One run; what goes wrong in it, whatever it is, ends no other.
    fn safely(&self, run: &Planned) -> Result<(), (u8, String)> {
        let go = || self.go(run, &self.found(run)?, Style::Silent);
        match catch_unwind(AssertUnwindSafe(go)) {
            Ok(done) => done.map_err(|error| (error.code(), error.to_string())),
            Err(_) => Err((101, "the run broke down; its message is on stderr".to_owned())),
        }
    }

    fn book(&self, sheet: &mut Sheet, row: usize, run: &Planned, done: Result<(), (u8, String)>) {
        let folder = self.out.join(&run.name);
        let (status, code, message) = match done {
            Ok(()) => (Status::Finished, 0, String::new()),
            Err((130, message)) => (Status::Interrupted, 130, message),
            Err((code, message)) => (Status::Failed, code, message),
        };
        sheet.note(row, &folder, status, Some(code), &message);
        let tail = match status {
            Status::Finished => {
                let number = |name: &str| sheet.cell(row, name).parse().unwrap_or(f64::NAN);
                let (retained, time) = (number("retained"), number("wall_time_s"));
                format!("fraction retained {retained:.4}, {time:.1} s")
            }
            _ => message,
        };
        let done = self.plan.runs.len() - sheet.count(Status::Waiting);
        let all = self.plan.runs.len();
        if self.how.json {
            let line = serde_json::json!({
                "run": run.name, "folder": folder, "status": status.name(), "exit": code,
                "message": tail, "done": done, "runs": all,
            });
            say::line(format_args!("{line}"));
        }
        self.tell(&format!("[{done}/{all}] {}: {}: {tail}", run.name, status.name()));
    }

    fn tell(&self, text: &str) {
        if !(self.how.quiet || self.how.json) {
            say::line(format_args!("{text}"));
        }
    }

    /// What the folder of a run holds; an error where it is something else.
    fn found(&self, run: &Planned) -> Result<Found, RunError> {
        let folder = self.out.join(&run.name);
        if !folder.join("checkpoint.bin").exists() {
            return Ok(Found::Nothing);
        }
        let checkpoint = Checkpoint::read(&folder)?;
        let same = checkpoint.scene == run.text
            && checkpoint.seed == run.seed
            && checkpoint.time.to_bits() == run.time.to_bits();
        if !same {
            return Err(RunError::OtherRun { folder });
        }
        self.same_files(run, &checkpoint, &folder)?;
        let at_end = checkpoint.core.time(checkpoint.time_step);
        let done = at_end > run.time - 0.75 * checkpoint.time_step;
        let page = folder.join("report.html").exists();
        Ok(if done && page { Found::Whole } else { Found::Part })
    }

    /// Refuses what was run with files that the scene names and that have changed since.
    fn same_files(
        &self,
        run: &Planned,
        checkpoint: &Checkpoint,
        folder: &Path,
    ) -> Result<(), RunError> {
        let path = Path::new(&self.plan.scene);
        let scene = Scene::parse(&run.text, path)?;
        let now = Files::of(&scene, path.parent().unwrap_or(Path::new("")))?;
        checkpoint.files.other(&scene, &now).map_or(Ok(()), |(key, file)| {
            let (folder, file) = (folder.to_path_buf(), file.clone());
            Err(RunError::OtherFile { folder, key, file })
        })
    }

    fn go(&self, run: &Planned, found: &Found, style: Style) -> Result<(), RunError> {
        let folder = self.out.join(&run.name);
        if matches!(found, Found::Part | Found::Whole) {
            return commands::resume_until(&folder, &self.how, style, Arc::clone(&self.stop));
        }
        let args = RunArgs {
            scene: self.plan.scene.clone(),
            time: Some(run.time),
            out: Some(folder),
            beds: Some(self.beds.clone()),
            seed: Some(run.seed),
            set: run.sets.iter().map(|set| format!("{}={}", set.key, set.value)).collect(),
            how: self.how.clone(),
            // What has no checkpoint has barely begun: it is begun anew.
            overwrite: true,
            ..RunArgs::default()
        };
        commands::run_until(&args, style, Arc::clone(&self.stop))
    }
}
