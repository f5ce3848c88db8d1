//! What a scene needs: the table of limits, laws left open, proposals.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

mod common;

use std::fs;
use std::path::Path;

use common::{program, run, text};

/// The demo with 40 spheres that start in the air.
fn small() -> String {
    let demo = text(&run(Path::new("."), &["show", "demo"]).stdout);
    let packing = demo.find("[packing]").unwrap();
    let screen = demo.find("[screen]").unwrap();
    let random = "[packing]\nfrom = \"random\"\nsolid_fraction = 0.2\nclearance_mm = 2\n\n";
    format!("{}{random}{}", &demo[..packing], &demo[screen..])
        .replace("count = 267", "count = 28")
        .replace("count = 99", "count = 8")
        .replace("count = 34", "count = 4")
        .replace("diameter_mm = 80 ", "diameter_mm = 40 ")
        .replace("time = 2.0", "time = 0.08")
        .replace("\"packing.floor_height_mm\", ", "")
}

#[test]
fn a_check_tells_stability_from_accuracy_and_who_sets_each_limit() {
    let said = text(&run(Path::new("."), &["check", "e18-02"]).stdout);
    let row = |term: &str| {
        let line = said.lines().find(|line| line.trim_start().starts_with(term));
        line.unwrap_or_else(|| panic!("no row {term} in\n{said}")).to_owned()
    };
    let springs = row("contact springs and dashpots");
    assert!(springs.contains("stability") && springs.contains("5 mm"), "{springs}");
    assert!(row("viscous drag").contains("stability"));
    for term in ["contact duration", "travel in the capillary range", "bridge stiffness"] {
        assert!(row(term).contains("accuracy"), "{term}");
    }
    assert!(row("travel of walls in it").contains("screen"));
    // All terms together allow less than any of them alone, and that is what decides.
    let step = |row: &str| {
        let number = row.split_whitespace().rev().nth(2).unwrap();
        number.parse::<f64>().unwrap_or_else(|_| panic!("no step in {row}"))
    };
    let all = row("all terms together");
    assert!(all.contains(" limit ") && step(&all) < step(&springs), "{all}\n{springs}");
    let told = row("limit        ");
    assert!(told.contains(all.split_whitespace().rev().nth(2).unwrap()), "{told}\n{all}");
    assert!(said.contains("Accuracy rows are advice"), "{said}");
    let cost = row("contact duration at 151 %");
    assert!(cost.contains("restitution"), "{cost}");
    assert!(!said.contains("bridge stiffness at"), "{said}");
}

#[test]
fn a_step_above_the_limit_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let refused = run(folder.path(), &["run", "demo", "--dt", "1e-3"]);
    assert_eq!(refused.status.code(), Some(2));
    let said = text(&refused.stderr);
    assert!(said.contains("contact springs and dashpots") && said.contains("5 mm"), "{said}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "nothing is written");
}

#[test]
fn laws_left_open_are_decided_before_the_run_and_written_down() {
    let folder = tempfile::tempdir().unwrap();
    let open = small()
        .replace("capillary = \"tabulated\"", "capillary = \"auto\"")
        .replace("tangential_drag = \"popov\"", "tangential_drag = \"auto\"")
        .replace("dynamic_rupture = \"pitois\"", "dynamic_rupture = \"auto\"");
    fs::write(folder.path().join("open.toml"), open).unwrap();
    let done = run(folder.path(), &["run", "open.toml", "--out", "one"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(text(&done.stdout).contains("decided"), "{}", text(&done.stdout));
    let summary = fs::read_to_string(folder.path().join("one/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    let decided = summary["decided"].as_object().unwrap();
    let keys: Vec<&str> = decided.keys().map(String::as_str).collect();
    assert_eq!(keys, ["capillary", "dynamic_rupture", "tangential_drag"]);
    // The cheaper closed forms are off by more than 5 % somewhere among these bridges.
    assert_eq!(decided["capillary"], "tabulated");
    let budget = summary["budget"].as_array().unwrap();
    let share = |force: &str| {
        budget
            .iter()
            .find(|row| row["force"] == force)
            .map(|row| row["impulse_percent"].as_f64().unwrap())
    };
    let shares = ["normal contact", "tangential contact", "rolling friction", "capillary force"];
    let known: f64 = shares.iter().filter_map(|force| share(force)).sum();
    let drags: f64 = ["viscous normal", "viscous tangential"].iter().filter_map(|f| share(f)).sum();
    assert!((known + drags - 100.0).abs() < 0.05, "{known} {drags}");
    assert!(share("normal contact").unwrap() > share("capillary force").unwrap());
}

#[test]
fn needs_proposes_with_evidence() {
    let folder = tempfile::tempdir().unwrap();
    // Wide enough for all, so that a short run has its passages.
    let wide =
        small().replace("aperture_mm = 8", "aperture_mm = 12").replace("time = 0.08", "time = 2");
    fs::write(folder.path().join("small.toml"), wide).unwrap();
    let done = run(folder.path(), &["needs", "small.toml", "--tolerance", "0.5", "--time", "0.4"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let said = text(&done.stdout);
    assert!(said.contains("differ by chance alone"), "{said}");
    // With so wide a tolerance every force is small, and a longer step is always tried.
    for change in ["normal_drag = \"none\"", "rolling_friction = 0", "time_step = "] {
        assert!(said.contains(change), "{change} in\n{said}");
    }
    assert!(said.contains("rule: a change is taken if it differs"), "{said}");
    let heading = said.lines().find(|line| line.trim_start().starts_with("change ")).unwrap();
    assert!(["5 mm", "7 mm", "10 mm"].iter().all(|class| heading.contains(class)), "{heading}");
    // What is proposed is a line that other commands take, and the tables above allow it.
    if let Some(line) = said.lines().find_map(|line| line.split_once("`check`: ")) {
        let sets: Vec<&str> = line.1.split('\'').filter(|word| word.contains('=')).collect();
        assert!(!sets.is_empty(), "{said}");
        let args = sets.iter().flat_map(|set| ["--set", set]);
        let check: Vec<&str> = ["check", "small.toml"].into_iter().chain(args).collect();
        let done = run(folder.path(), &check);
        assert!(done.status.success(), "{sets:?}: {}", text(&done.stderr));
    } else {
        assert!(said.contains("nothing can be left out"), "{said}");
    }
    for wrong in ["-1", "nan", "2"] {
        let bad = run(folder.path(), &["needs", "small.toml", "--tolerance", wrong]);
        assert_eq!(bad.status.code(), Some(2));
        assert!(text(&bad.stderr).contains("tolerance"));
        assert!(text(&bad.stderr).contains("above 0, at most 1"));
    }
}

#[test]
fn needs_proposes_nothing_where_too_little_has_passed() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small().replace("time = 0.08", "time = 2"))
        .unwrap();
    // The spheres fall for 0.02 s and more. With this tolerance everything else would be left out.
    for (time, seen) in [("0.01", "none of the 36 spheres"), ("0.5", "of the 36 spheres")] {
        let args = ["needs", "small.toml", "--tolerance", "0.9", "--time", time];
        let done = run(folder.path(), &args);
        let said = text(&done.stdout);
        assert!(done.status.success(), "{}", text(&done.stderr));
        for words in ["too little to go by", seen, "nothing is proposed", "up to the scene's 2 s"] {
            assert!(said.contains(words), "`{words}` is not in: {said}");
        }
        assert_eq!(said.contains(" bridges formed"), time == "0.01", "{said}");
        for words in ["proposed, for", "take it", "nothing can be left out", "rule:"] {
            assert!(!said.contains(words), "`{words}` is in: {said}");
        }
    }
}

#[test]
fn what_settles_is_told_before_the_table_of_needs() {
    let folder = tempfile::tempdir().unwrap();
    let few = common::small().replace("aperture_mm = 8", "aperture_mm = 12");
    fs::write(folder.path().join("s.toml"), few.replace("time = 0.08", "time = 2")).unwrap();
    // Both streams in one file, as on a terminal.
    let both = fs::File::create(folder.path().join("said")).unwrap();
    let args = ["needs", "s.toml", "--tolerance", "0.5", "--time", "0.7", "--beds", "beds"];
    let mut child = program();
    let child = child.current_dir(folder.path()).args(args).stdout(both.try_clone().unwrap());
    assert!(child.stderr(both).status().unwrap().success());
    let said = fs::read_to_string(folder.path().join("said")).unwrap();
    let (before, after) = said.split_once("pilot runs of 0.7 s").unwrap();
    assert!(before.contains("settling 24 spheres") && !after.contains("settling"), "{said}");
    assert!(after.contains("rule:"), "{said}");
    // More than one bed has settled: those of the twins have steps of their own.
    assert!(fs::read_dir(folder.path().join("beds")).unwrap().count() > 1);
}
