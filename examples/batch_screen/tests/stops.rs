//! Runs that stop before their end: told to, or because their state cannot be.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

mod common;

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Output, Stdio};

use common::{program, run, small, summary, terminate, text};
use serde_json::Value;

const LOOSE: &str = "packing={from=\"random\", solid_fraction=0.2, clearance_mm=2}";

fn faulty(folder: &Path, out: &str, options: &[&str]) -> Output {
    let mut args = vec!["run", "small.toml", "--threads", "1", "--out", out];
    args.extend(options);
    if !options.contains(&"--time") {
        args.extend(["--time", "0.05"]);
    }
    run(folder, &args)
}

#[test]
fn a_state_that_cannot_be_stops_the_run_and_keeps_the_last_good_checkpoint() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    for (out, options, wanted) in [
        // The step is twelve hundred times the one that is refused otherwise.
        ("step", &["--dt", "1e-3", "--allow-unstable"][..], "time step"),
        ("overlap", &["--set", "guard.overlap_share=0.0012"], "guard.overlap_share"),
        ("speed", &["--set", "guard.speed=0.2"], "guard.speed"),
    ] {
        let done = faulty(folder.path(), out, options);
        let said = text(&done.stderr);
        assert_eq!(done.status.code(), Some(3), "{out}: {said}");
        for word in ["the run stopped at t = ", "particle ", " m", wanted, "what to do", "is kept"]
        {
            assert!(said.contains(word), "{out}: `{word}` is not in: {said}");
        }
        let out = folder.path().join(out);
        assert!(out.join("report.html").exists());
        let summary = summary(&out);
        let told = summary["stopped_by_guard"].as_str().unwrap();
        assert!(said.contains(told.split(": ").nth(1).unwrap()), "{told}: {said}");
        // The rows go on to the fault; the checkpoint lies before it and can be read.
        let rows = fs::read_to_string(out.join("retained.csv")).unwrap();
        assert!(rows.lines().count() > 2, "{rows}");
        let again = run(folder.path(), &["resume", out.to_str().unwrap()]);
        assert_eq!(again.status.code(), Some(3), "{}", text(&again.stderr));
    }
}

#[test]
fn the_checkpoint_before_a_fault_survives_it() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    // A checkpoint at every occasion: none of them is of the state that stops the run.
    let often = ["--set", LOOSE, "--set", "guard.speed=0.05", "--checkpoint-every", "1e-9"];
    let done = faulty(folder.path(), "often", &often);
    assert_eq!(done.status.code(), Some(3), "{}", text(&done.stderr));
    let stopped = summary(&folder.path().join("often"))["steps"].as_u64().unwrap();
    let again = run(folder.path(), &["resume", "often"]);
    assert_eq!(again.status.code(), Some(3), "{}", text(&again.stderr));
    let said = text(&again.stdout);
    let from = said.lines().find_map(|line| line.strip_prefix("going on from t = ")).unwrap();
    let from: f64 = from.trim_end_matches(" s").parse().unwrap();
    assert!(from > 0.0 && from < 5e-6 * stopped as f64, "{from}");
}

const FREE: [&str; 4] = ["--set", "guard.overlap_share=10", "--set", "guard.speed=1e3"];

#[test]
fn spheres_that_leave_through_walls_stop_the_run() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    // A frame far away from where it should be, and gravity to the side.
    let triangle = "solid far\nfacet normal 0 0 1\nouter loop\nvertex 0 0 -500\nvertex 1 0 -500\n\
                    vertex 0 1 -500\nendloop\nendfacet\nendsolid far\n";
    fs::write(folder.path().join("far.stl"), triangle).unwrap();
    let far = "parts=[{name=\"frame\", stl=\"far.stl\", material=\"steel\"}]";
    let aside = "gravity=[-60, 0, 0]";
    let soft = "contact.stiffness=100";
    for (out, sets, wanted) in [
        ("out-of-it", &[far, aside][..], "has left the apparatus at (-0.0"),
        ("frame", &[soft, "gravity=[-900, 0, 0]"], "has left through the frame"),
        ("wires", &[soft, "gravity=[0, 0, -900]"], "has left through the wires"),
    ] {
        let mut options = FREE.to_vec();
        options.extend(["--set", LOOSE]);
        sets.iter().for_each(|set| options.extend(["--set", *set]));
        let done = faulty(folder.path(), out, &options);
        let said = text(&done.stderr);
        assert_eq!(done.status.code(), Some(3), "{out}: {said}");
        assert!(said.contains(wanted) && said.contains(" mm)"), "{out}: {said}");
    }
    // A run does not go on with another part than it began with.
    fs::write(folder.path().join("far.stl"), triangle.replace("-500", "-400")).unwrap();
    let resumed = program().current_dir(&folder).args(["resume", "out-of-it"]).output().unwrap();
    let said = text(&resumed.stderr);
    assert_eq!(resumed.status.code(), Some(2), "{said}");
    assert!(said.contains("`parts[0].stl`: far.stl is not what it was"), "{said}");
    fs::write(folder.path().join("far.stl"), triangle).unwrap();
    // The same, where it is meant.
    let count = ["--set", LOOSE, "--set", far, "--set", aside, "--set", "guard.escapes=count"];
    let done = faulty(folder.path(), "counted", &count);
    assert!(done.status.success(), "{}", text(&done.stderr));
    // They are in no collecting bin: they count as retained, and their liquid is not the fines'.
    let summary = summary(&folder.path().join("counted"));
    assert!(summary["escaped"].as_u64().unwrap() > 0);
    assert!(text(&done.stdout).contains("and count as retained"), "{}", text(&done.stdout));
    for class in ["5 mm", "7 mm", "10 mm"] {
        let of = |key: &str| summary[key][class].as_f64().unwrap();
        let count = summary["derived"]["particles"][class].as_f64().unwrap();
        assert_eq!(of("above") + of("escaped_by_class") + of("collected"), count, "{class}");
        let retained = summary["fraction_retained"]["by_class"][class].as_f64().unwrap();
        let there = (of("above") + of("escaped_by_class")) / count;
        assert!((retained - there).abs() < 0.05, "{class}: {retained} {there}");
        let liquid = |place: &str| summary["liquid_m3"][place][class].as_f64().unwrap();
        assert!((liquid("fines") > 0.0) == (of("collected") > 0.0), "{class}");
        assert!(liquid("above") > 0.0, "{class}");
    }
}

/// Starts a run and waits until it says `wanted` on stderr, which stays open.
fn until(folder: &Path, args: &[&str], wanted: &str) -> (Child, impl BufRead + use<>) {
    let mut child = program()
        .current_dir(folder)
        .args(args)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut said = BufReader::new(child.stderr.take().unwrap());
    let mut line = String::new();
    while !line.contains(wanted) {
        line.clear();
        assert!(said.read_line(&mut line).unwrap() > 0, "it never said {wanted}");
    }
    (child, said)
}

#[test]
fn a_folder_is_written_by_one_run_at_a_time() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    let short = ["run", "small.toml", "--set", LOOSE, "--out", "o"];
    let args = [&short[..], &["--time", "60"]].concat();
    let mut child = program().current_dir(folder.path()).args(&args).spawn().unwrap();
    while !folder.path().join("o/checkpoint.bin").exists() {
        assert!(child.try_wait().unwrap().is_none(), "it ended before it was asked to");
        std::thread::sleep(std::time::Duration::from_millis(3));
    }
    let overwrite = [&short[..], &["--overwrite", "--time", "0.001"]].concat();
    for args in [&overwrite[..], &short, &["resume", "o"]] {
        let refused = run(folder.path(), args);
        let said = text(&refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{args:?}: {said}");
        assert!(said.contains("o is being written by another run"), "{args:?}: {said}");
    }
    // Killed, it has no more say in it.
    child.kill().unwrap();
    child.wait().unwrap();
    let done = run(folder.path(), &overwrite);
    assert!(done.status.success(), "{}", text(&done.stderr));
    // Where there is nothing to go on with, nothing is made.
    fs::create_dir(folder.path().join("empty")).unwrap();
    assert_eq!(run(folder.path(), &["resume", "empty"]).status.code(), Some(1));
    assert_eq!(fs::read_dir(folder.path().join("empty")).unwrap().count(), 0);
}

#[test]
fn a_run_goes_on_when_nobody_reads_what_it_says() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    for args in [
        &["list"][..],
        &["check", "small.toml"],
        &["run", "small.toml", "--time", "0.005", "--set", LOOSE, "--out", "o"],
        &["run", "small.toml", "--time", "0.005", "--set", LOOSE, "--json"],
    ] {
        let mut child = program()
            .current_dir(folder.path())
            .args(args)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // As `head` does when it has its lines.
        drop((child.stdout.take(), child.stderr.take()));
        assert_eq!(child.wait().unwrap().code(), Some(0), "{args:?}");
    }
    assert!(folder.path().join("o/report.html").exists());
}

#[test]
fn a_bed_that_is_not_at_rest_in_time_says_so() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    let quick = ["--set", "packing.settle_at_most=0.11"];
    let done = faulty(folder.path(), "moving", &quick);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(text(&done.stderr).contains("still moves after 0.11 s"));
    let done = faulty(folder.path(), "settled", &["--set", "packing.settle_at_most=2"]);
    assert!(!text(&done.stderr).contains("still moves"), "{}", text(&done.stderr));
}

#[test]
fn a_kept_bed_that_was_damaged_settles_again() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    let bed = || fs::read_dir(folder.path().join("beds")).unwrap().next().unwrap().unwrap().path();
    let go = |out: &str| {
        let done = faulty(folder.path(), out, &["--beds", "beds", "--time", "0.01"]);
        assert!(done.status.success(), "{}", text(&done.stderr));
        (text(&done.stderr), fs::read(folder.path().join(out).join("replay.csv")).unwrap())
    };
    let (_, first) = go("a");
    let kept = fs::read_to_string(bed()).unwrap();
    let cut: String = kept.split_inclusive('\n').take(13).collect();
    fs::write(bed(), cut).unwrap();
    let (said, again) = go("b");
    assert!(said.contains("spheres of ") && said.contains("the bed settles again"), "{said}");
    assert!(first == again && fs::read_to_string(bed()).unwrap() == kept);
    assert!(!go("c").0.contains("settle"), "it is kept");
}

#[test]
fn settling_is_told_and_quiet_hides_progress_alone() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    let go = |out: &str, options: &[&str]| {
        // A bed of its own each time.
        let done = faulty(folder.path(), out, &[&["--beds", out][..], options].concat());
        assert!(done.status.success(), "{}", text(&done.stderr));
        (text(&done.stdout), text(&done.stderr))
    };
    let (_, said) = go("people", &[]);
    let rows = said.lines().filter(|line| line.starts_with("settling: t = ")).count();
    assert!(said.contains("settling: t = 0.000 of at most 2 s") && rows > 10, "{said}");
    let (out, said) = go("json", &["--json"]);
    let lines: Vec<Value> = out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(said, "", "what is for people stays away");
    let settling: Vec<&Value> = lines.iter().take_while(|line| line["settling"] == true).collect();
    assert_eq!(settling[0]["time_s"], 0.0);
    let last = settling.last().unwrap();
    let number = |key: &str| last[key].as_f64().unwrap();
    assert!(number("motion") < number("at_rest_below") && number("time_s") > 0.1, "{last}");
    assert_eq!(last["particles"], 24);
    let done = lines.last().unwrap();
    let retained = &summary(&folder.path().join("json"))["fraction_retained"]["total"];
    assert_eq!((&done["done"], &done["fraction_retained"]), (&Value::Bool(true), retained));
    let (out, said) = go("quiet", &["--quiet"]);
    assert_eq!(said, "");
    assert!(out.starts_with("after 0.050 s\n") && out.contains("fraction retained"), "{out}");
    assert!(out.ends_with("results in quiet, report in quiet/report.html\n"), "{out}");
}

#[test]
fn a_bed_that_settles_can_be_stopped_and_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let run = ["run", "demo", "--beds", "beds"];
    let (mut child, _said) = until(folder.path(), &run, "settling 400 spheres");
    terminate(&child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let kept: Vec<_> = fs::read_dir(folder.path().join("beds")).unwrap().collect();
    assert_eq!(kept.len(), 1);
    assert!(!folder.path().join("out").exists(), "the run itself has not begun");
    let (mut child, _said) =
        until(folder.path(), &run, "going on with the settling of the bed from t = 0.0");
    child.kill().unwrap();
    child.wait().unwrap();
}
