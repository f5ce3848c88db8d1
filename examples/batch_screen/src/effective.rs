//! `scene.toml` of a run's folder: the scene as it was run, to be read, compared and run again.

use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use toml::{Table, Value};

use crate::build::Derived;
use crate::error::RunError;
use crate::run::Job;
use crate::scene::Scene;

const NAME: &str = "scene.toml";
/// How our files begin: a scene that somebody has written is never replaced by one.
const FIRST: &str = "# The scene as it was run";

/// Refuses a folder whose `scene.toml` is not of the run that it holds.
pub(crate) fn refuse(folder: &Path, holds_run: bool) -> Result<(), RunError> {
    let path = folder.join(NAME);
    match fs::read(&path) {
        Ok(bytes) if holds_run && bytes.starts_with(FIRST.as_bytes()) => Ok(()),
        Ok(_) => Err(RunError::SceneOfUser { path }),
        Err(source) if source.kind() == ErrorKind::NotFound => Ok(()),
        Err(source) => Err(RunError::Write { path, source }),
    }
}

/// Writes the scene of a run that begins.
pub(crate) fn write(
    scene: &Scene,
    derived: &Derived,
    job: &Job,
    allow_unstable: bool,
) -> Result<(), RunError> {
    let path = job.out.join(NAME);
    let fail = |source| RunError::Write { path: path.clone(), source };
    let values = toml::to_string(&values(scene, derived, job))
        .map_err(|e| fail(std::io::Error::other(e.to_string())))?;
    let head = format!(
        "{FIRST}: {}, with all that the command line and the program decided.\n\
         # Run it again with: batch_screen run {NAME}{}\n\n",
        job.source.replace(char::is_control, " "),
        options(job, allow_unstable)
    );
    fs::write(&path, head + &values).map_err(fail)
}

/// What no key of a scene can say.
fn options(job: &Job, allow_unstable: bool) -> String {
    let vtk = job.vtk.map_or(String::new(), |interval| format!(" --vtk {interval}"));
    let unstable = if allow_unstable { " --allow-unstable" } else { "" };
    format!("{vtk}{unstable}")
}

fn values(scene: &Scene, derived: &Derived, job: &Job) -> Table {
    let mut root = scene.document.clone();
    let mut put = |key: &str, value: Value| drop(root.insert(key.to_owned(), value));
    put("time", scene.time.into());
    // One that follows from the limit is found again: the bed settles at a step of its own then.
    if let Some(step) = scene.time_step {
        put("time_step", step.into());
    }
    // No scene and no option lets a larger one through.
    put("seed", i64::try_from(scene.seed).unwrap_or(i64::MAX).into());
    if let Some(Value::Table(liquid)) = root.get_mut("liquid") {
        for (key, value) in &job.decided {
            liquid.insert(key.clone(), value.clone().into());
        }
        let drag = if derived.implicit { "implicit" } else { "explicit" };
        liquid.insert("drag".into(), drag.into());
    }
    // Files are looked for from the scene's folder, which is another one now.
    let found = |path: &mut Value| {
        if let Some(name) = path.as_str() {
            *path = job.base.join(name).to_string_lossy().into_owned().into();
        }
    };
    if let Some(path) = root.get_mut("packing").and_then(|packing| packing.get_mut("path")) {
        found(path);
    }
    if let Some(Value::Array(parts)) = root.get_mut("parts") {
        parts.iter_mut().filter_map(|part| part.get_mut("stl")).for_each(found);
    }
    root
}
