//! The folder of a run: it never takes the place of an earlier one, unless that is asked for.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::effective;
use crate::error::RunError;
use crate::lock;
use crate::say;
use crate::vtk::Series;

/// Files of a run; the last of them is there as soon as it has begun.
const OF_A_RUN: [&str; 3] = ["checkpoint.bin", "summary.json", "retained.csv"];

/// Refuses a folder that was asked for and holds a run, or is being written.
pub(crate) fn refuse(asked: Option<&Path>, overwrite: bool) -> Result<(), RunError> {
    let Some(folder) = asked else { return Ok(()) };
    lock::refuse(folder)?;
    let holds = holds_run(folder);
    if holds && !overwrite {
        return Err(RunError::HoldsRun { folder: folder.to_path_buf() });
    }
    effective::refuse(folder, holds)
}

/// Refuses a folder that cannot be written into, before a bed settles for it. Nothing is made there.
pub(crate) fn writable(folder: &Path) -> Result<(), RunError> {
    let there = folder.ancestors().find(|path| path.exists()).unwrap_or(Path::new("."));
    let fail = |source| RunError::Write { path: folder.to_path_buf(), source };
    tempfile::tempfile_in(there).map(drop).map_err(fail)
}

fn holds_run(folder: &Path) -> bool {
    OF_A_RUN.iter().any(|name| folder.join(name).exists())
}

/// The folder of a run that is about to begin: the one that was asked for, or else the usual one, or
/// if that is taken the next free one.
pub(crate) fn of_run(
    asked: Option<&Path>,
    usual: &Path,
    overwrite: bool,
) -> Result<PathBuf, RunError> {
    // Once more: while the bed settled another run may have begun there.
    refuse(asked, overwrite)?;
    match asked {
        Some(folder) => Ok(folder.to_path_buf()),
        // What is no run, such as the folder of kept beds, is none to be replaced.
        None if overwrite && holds_run(usual) => {
            refuse(Some(usual), overwrite)?;
            Ok(usual.to_path_buf())
        }
        None => {
            let folder = free(usual)?;
            if folder != usual {
                let (usual, folder) = (usual.display(), folder.display());
                say::note(format_args!("{usual} is there already: this run goes to {folder}"));
            }
            Ok(folder)
        }
    }
}

/// Makes a folder of this name, or where there is one, of the name with the first free number.
fn free(wanted: &Path) -> Result<PathBuf, RunError> {
    let fail = |path: &Path, source| RunError::Write { path: path.to_path_buf(), source };
    let parent = wanted.parent().unwrap_or(Path::new(""));
    fs::create_dir_all(parent).map_err(|source| fail(parent, source))?;
    let mut folder = wanted.to_path_buf();
    let mut number = 1_u64;
    // Made, not looked for: of two runs that start together each has a folder of its own.
    while let Err(source) = fs::create_dir(&folder) {
        if source.kind() != ErrorKind::AlreadyExists {
            return Err(fail(&folder, source));
        }
        number += 1;
        let mut name = wanted.file_name().unwrap_or_default().to_os_string();
        name.push(format!("-{number}"));
        folder = wanted.with_file_name(name);
    }
    Ok(folder)
}

/// Takes away what could be taken for part of the run that is to begin in a folder.
pub(crate) fn clear(folder: &Path) -> Result<(), RunError> {
    let whole = ["checkpoint.bin", "summary.json", "report.html"];
    let wet = ["liquid.csv", "liquid_shared.csv", "liquid_final.csv", "bridges.csv"];
    whole.iter().chain(&wet).try_for_each(|name| remove(folder.join(name)))?;
    let frames = folder.join("paraview");
    if frames.is_dir() {
        // What is no series of ours has no frames that we know of; its lists go all the same.
        let _ = Series::resume(&frames, f64::NEG_INFINITY);
        let lists = ["particles", "bridges", "walls"].map(|name| format!("{name}.pvd"));
        lists.iter().try_for_each(|name| remove(frames.join(name)))?;
    }
    Ok(())
}

fn remove(path: PathBuf) -> Result<(), RunError> {
    match fs::remove_file(&path) {
        Err(source) if source.kind() != ErrorKind::NotFound => {
            Err(RunError::Write { path, source })
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_counted_on_until_one_is_free() {
        let folder = tempfile::tempdir().unwrap();
        let wanted = folder.path().join("out/v1.5");
        let names: Vec<_> = (0..3).map(|_| free(&wanted).unwrap()).collect();
        let expected =
            ["v1.5", "v1.5-2", "v1.5-3"].map(|name| folder.path().join("out").join(name));
        assert_eq!(names, expected);
        // Whatever has the name keeps it.
        fs::remove_dir(&names[1]).unwrap();
        fs::write(&names[1], "a file").unwrap();
        assert!(free(&wanted).unwrap().ends_with("v1.5-4"));
    }

    #[test]
    fn a_run_is_known_by_any_of_its_files() {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("notes.txt"), "").unwrap();
        refuse(Some(folder.path()), false).unwrap();
        refuse(Some(&folder.path().join("missing")), false).unwrap();
        for name in OF_A_RUN {
            fs::write(folder.path().join(name), "").unwrap();
            let said = refuse(Some(folder.path()), false).unwrap_err().to_string();
            assert!(said.contains("--overwrite") && said.contains("resume"), "{said}");
            refuse(Some(folder.path()), true).unwrap();
            fs::remove_file(folder.path().join(name)).unwrap();
        }
    }
}
