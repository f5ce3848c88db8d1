//! Runs that are killed go on to the same bytes; what cannot be gone on from says why.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

use std::fs;

mod common;

use common::{TABLES, program, run, small, summary, text};

#[test]
fn a_killed_run_goes_on_to_the_same_bytes() {
    killed("liquid.viscosity=0.001");
}

/// A liquid as viscous as this one makes the drags implicit, and they remember their impulses.
#[test]
fn a_killed_run_with_implicit_drags_goes_on_to_the_same_bytes() {
    let summary = killed("liquid.viscosity=10.0");
    assert_eq!(summary["drag"], "implicit");
}

fn killed(set: &str) -> serde_json::Value {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    let out = ["run", "small.toml", "--vtk", "0.03", "--set", set, "--out"];
    let whole = run(folder.path(), &[&out[..], &["whole"]].concat());
    assert!(whole.status.success(), "{}", text(&whole.stderr));
    // Killed at three moments, the first before any row; each time it is taken up where it was.
    let quick = ["--checkpoint-every", "0.02", "--threads", "1"];
    let mut args = [&out[..], &["cut"]].concat();
    for rows in [0, 3, 6] {
        let mut child = program()
            .current_dir(folder.path())
            .args(&args)
            .args(quick)
            .stdout(std::process::Stdio::null())
            .stderr(std::process::Stdio::null())
            .spawn()
            .unwrap();
        let table = folder.path().join("cut/retained.csv");
        let written = || fs::read_to_string(&table).map_or(0, |t| t.lines().count());
        // Killed before its first checkpoint, a run has nothing to go on from.
        let started = || folder.path().join("cut/checkpoint.bin").exists();
        while (written() <= rows || !started()) && child.try_wait().unwrap().is_none() {
            std::thread::sleep(std::time::Duration::from_millis(3));
        }
        child.kill().unwrap();
        child.wait().unwrap();
        // What a killed run has left can be looked at.
        let page = run(folder.path(), &["report", "cut"]);
        assert!(page.status.success(), "{}", text(&page.stderr));
        args = vec!["resume", "cut"];
    }
    let last = run(folder.path(), &["resume", "cut"]);
    assert!(last.status.success(), "{}", text(&last.stderr));
    // After that there is nothing left to do, which is said, however little else is.
    for quiet in [&["resume", "cut"][..], &["resume", "cut", "--quiet"]] {
        let last = run(folder.path(), quiet);
        let said = text(&last.stdout);
        assert!(last.status.success(), "{}", text(&last.stderr));
        assert!(said.starts_with("cut has finished already, at t = 0.0800 s"), "{said}");
        assert!(said.contains("results in cut"), "{said}");
    }
    for table in TABLES {
        let read = |run: &str| fs::read(folder.path().join(run).join(table)).unwrap();
        assert!(read("whole") == read("cut"), "{table} differs");
    }
    let frames = |run: &str| {
        let list = fs::read_dir(folder.path().join(run).join("paraview")).unwrap();
        let mut all: Vec<_> = list
            .map(|entry| entry.unwrap())
            .map(|entry| (entry.file_name(), fs::read(entry.path()).unwrap()))
            .collect();
        all.sort();
        all
    };
    assert!(frames("whole").len() > 6 && frames("whole") == frames("cut"));
    for key in ["liquid_imbalance", "least_limit_s", "largest_overlap", "fraction_retained"] {
        let said = |run: &str| summary(&folder.path().join(run))[key].clone();
        assert_eq!(said("whole"), said("cut"), "{key}");
    }
    assert!(folder.path().join("cut/report.html").exists());
    summary(&folder.path().join("cut"))
}

#[test]
fn checkpoints_that_cannot_be_used_say_why() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    let none = run(folder.path(), &["resume", "nowhere"]);
    assert_eq!(none.status.code(), Some(1));
    assert!(text(&none.stderr).contains("no checkpoint to go on from"));
    let nan = ["run", "small.toml", "--checkpoint-every", "nan"];
    assert_eq!(run(folder.path(), &nan).status.code(), Some(2));
    let done = run(folder.path(), &["run", "small.toml", "--time", "0.01", "--out", "a"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let file = folder.path().join("a/checkpoint.bin");
    let good = fs::read(&file).unwrap();
    for (change, wanted) in [
        (vec![1, 2, 3], "no checkpoint of this program"),
        (good[..good.len() - 9].to_vec(), "checksum"),
        ([&good[..8], &[9, 0, 0, 0], &good[12..]].concat(), "version 9"),
    ] {
        fs::write(&file, change).unwrap();
        let said = text(&run(folder.path(), &["resume", "a"]).stderr);
        assert!(said.contains(wanted), "{said}");
    }
    // A table that is missing is told before any other is touched.
    fs::write(&file, &good).unwrap();
    fs::remove_file(folder.path().join("a/bridges.csv")).unwrap();
    let retained = fs::read(folder.path().join("a/retained.csv")).unwrap();
    let said = text(&run(folder.path(), &["resume", "a"]).stderr);
    assert!(said.contains("bridges.csv"), "{said}");
    assert_eq!(fs::read(folder.path().join("a/retained.csv")).unwrap(), retained);
}
