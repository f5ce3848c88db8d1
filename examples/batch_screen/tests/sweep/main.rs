//! Sweeps: many runs, one table.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

mod again;
#[path = "../common/mod.rs"]
mod common;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use common::{run, small, text};
use tempfile::TempDir;

const SWEEP: &str = r#"
scene = "small.toml"
time = 0.005
seeds = [1, 2]

[grid]
"liquid.moisture_percent" = [2.5, 5]
liquid.capillary = ["lambert"]

[[rows]]
name = "long-step"
time_step = 1e-4

[[rows]]
"classes[0].count" = 9
"#;

fn folder(sweep: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    fs::write(folder.path().join("s.toml"), sweep).unwrap();
    folder
}

/// The table: run -> column -> cell.
fn table(folder: &Path) -> BTreeMap<String, BTreeMap<String, String>> {
    let mut reader = csv::Reader::from_path(folder.join("out/s/sweep.csv")).unwrap();
    let header = reader.headers().unwrap().clone();
    let row = |record: csv::StringRecord| {
        let cells = header.iter().zip(&record);
        cells.map(|(name, cell)| (name.to_owned(), cell.to_owned())).collect()
    };
    reader.records().map(|r| r.unwrap()).map(|r| (r[0].to_owned(), row(r))).collect()
}

#[test]
fn a_sweep_runs_side_by_side_and_a_run_that_fails_stops_no_other() {
    let folder = folder(SWEEP);
    let args = ["sweep", "s.toml", "--jobs", "2", "--threads", "1"];
    let done = run(folder.path(), &args);
    assert_eq!(done.status.code(), Some(1), "{}", text(&done.stderr));
    assert!(text(&done.stderr).contains("2 of 8 runs failed"));
    let rows = table(folder.path());
    assert_eq!(rows.len(), 8);
    for (name, row) in &rows {
        let failed = name.starts_with("long-step");
        assert_eq!(row["status"], if failed { "failed" } else { "finished" }, "{name}");
        assert_eq!(row["exit"], if failed { "2" } else { "0" });
        assert_eq!(row["message"].contains("above the limit"), failed, "{name}");
        assert_eq!(row["seed"], name[name.len() - 1..]);
        if !failed {
            let number = |column: &str| row[column].parse::<f64>().unwrap();
            assert!((number("retained") - 1.0).abs() < 1e-9 && number("retained 5 mm") > 0.9);
            assert!(number("liquid_imbalance").abs() < 1e-12 && number("time_s") == 0.005);
            assert!(number("wall_time_s") > 0.0 && number("steps") == 1000.0);
            assert!(folder.path().join("out/s").join(name).join("report.html").exists());
        }
    }
    let wet = &rows["liquid.capillary=lambert_liquid.moisture_percent=2.5_seed=1"];
    assert_eq!((&*wet["liquid.moisture_percent"], &*wet["liquid.capillary"]), ("2.5", "lambert"));
    let few = common::summary(&folder.path().join("out/s/classes.0.count=9_seed=2"));
    assert_eq!(few["derived"]["particles"]["5 mm"], 9);
    // What is done is left alone, what has failed is tried again, no row is lost.
    let one = folder.path().join("out/s/classes.0.count=9_seed=2/summary.json");
    let before = fs::metadata(&one).unwrap().modified().unwrap();
    fs::write(folder.path().join("s.toml"), SWEEP.replace("[2.5, 5]", "[2.5]")).unwrap();
    let again = run(folder.path(), &args);
    assert!(text(&again.stdout).contains("6 runs, 4 of them done"), "{}", text(&again.stdout));
    assert_eq!(fs::metadata(&one).unwrap().modified().unwrap(), before);
    let kept = table(folder.path());
    assert_eq!(kept.len(), 8);
    let gone = "liquid.capillary=lambert_liquid.moisture_percent=5_seed=1";
    assert_eq!(kept[gone], rows[gone]);
    // A folder that holds another run is not taken for this one.
    fs::write(folder.path().join("s.toml"), SWEEP.replace("0.005", "0.006")).unwrap();
    let other = run(folder.path(), &args);
    assert_eq!(other.status.code(), Some(1));
    assert!(table(folder.path())[gone]["message"].contains("another scene, seed or time"));
}

#[test]
fn every_row_and_every_line_of_json_says_how_a_run_ended_and_where_it_is() {
    let folder = folder(SWEEP);
    let json = |args: &[&str]| {
        let done =
            run(folder.path(), &[&["sweep", "s.toml", "--json", "--threads", "1"], args].concat());
        let lines = text(&done.stdout);
        let objects = lines.lines().map(|line| serde_json::from_str(line).unwrap());
        (done.status.code(), objects.collect::<Vec<serde_json::Value>>())
    };
    let (code, lines) = json(&[]);
    assert_eq!((code, lines.len()), (Some(1), 9));
    let docs = include_str!("../../../../docs/tables.md");
    let docs = docs.split_once("`sweep --json` prints").unwrap().1;
    let documented = |line: &serde_json::Value, when: &str| {
        let row = docs.lines().find(|row| row.starts_with(&format!("| {when} |"))).unwrap();
        for key in line.as_object().unwrap().keys() {
            assert!(row.contains(&format!("`{key}`")), "{key} is not in: {row}");
        }
    };
    let rows = table(folder.path());
    for (k, line) in lines[..8].iter().enumerate() {
        documented(line, "a run ends");
        let row = &rows[line["run"].as_str().unwrap()];
        assert_eq!((&*row["folder"], &*row["status"]), {
            (line["folder"].as_str().unwrap(), line["status"].as_str().unwrap())
        });
        assert_eq!(row["exit"], line["exit"].to_string());
        let failed = line["exit"] == 2;
        assert_eq!(folder.path().join(&row["folder"]).join("summary.json").exists(), !failed);
        assert_eq!((&line["done"], &line["runs"]), (&(k + 1).into(), &8.into()));
    }
    documented(&lines[8], "the last line");
    let end = |runs: u64| {
        serde_json::json!({
            "table": "out/s/sweep.csv", "runs": 8,
            "finished": runs, "failed": 8 - runs, "interrupted": 0, "waiting": 0,
        })
    };
    assert_eq!(lines[8], end(6));
    // What is done has no line: two are tried again, and a table alone has the last line only.
    assert_eq!(json(&[]).1.len(), 3);
    assert_eq!(json(&["--gather"]), (Some(1), vec![end(6)]));
}

#[test]
fn commands_for_a_cluster_run_as_they_are_printed() {
    let sweep = "scene = \"small.toml\"\ntime = 0.002\nseeds = [3]\n[grid]\n\
                 \"liquid.viscosity\" = [1e-3, 2e-3]\n";
    let folder = folder(sweep);
    let list = run(folder.path(), &["sweep", "s.toml", "--emit", "list", "--threads", "1"]);
    let list = text(&list.stdout);
    assert_eq!(list.lines().count(), 2);
    for line in list.lines() {
        let done = Command::new("sh").current_dir(folder.path()).args(["-c", line]).output();
        let done = done.unwrap();
        assert!(done.status.success(), "{}", text(&done.stderr));
    }
    assert!(!folder.path().join("out/s/sweep.csv").exists());
    let gather = run(folder.path(), &["sweep", "s.toml", "--gather"]);
    assert!(gather.status.success(), "{}", text(&gather.stderr));
    let rows = table(folder.path());
    assert_eq!(rows.len(), 2);
    assert!(rows.values().all(|row| row["status"] == "finished" && row["seed"] == "3"));
    // The script of the job array, run as one of its tasks.
    fs::remove_dir_all(folder.path().join("out/s/liquid.viscosity=0.002_seed=3")).unwrap();
    let slurm = run(folder.path(), &["sweep", "s.toml", "--emit", "slurm", "--threads", "1"]);
    let script = text(&slurm.stdout);
    assert!(script.starts_with("#!/bin/bash\n") && script.contains("#SBATCH --array=1-2\n"));
    let task = Command::new("bash")
        .current_dir(folder.path())
        .args(["-c", &script])
        .envs([("SLURM_ARRAY_TASK_ID", "2"), ("SLURM_CPUS_PER_TASK", "1")])
        .output()
        .unwrap();
    assert!(task.status.success(), "{}", text(&task.stderr));
    assert!(folder.path().join("out/s/liquid.viscosity=0.002_seed=3/report.html").exists());
}

/// What is changed in a good sweep, and what the error must say.
const BAD: &[(&str, &str, &[&str])] = &[
    (
        "scene = \"small.toml\"",
        "scene = \"none.toml\"",
        &["line 2", "`scene`", "none.toml", "e18-18"],
    ),
    ("seeds = [1, 2]", "seeds = [1, -2]", &["line 4", "seeds", "a whole number"]),
    ("seeds = [1, 2]", "seed = [1, 2]", &["line 4", "`seed`", "`seeds`"]),
    ("seeds = [1, 2]", "seeds = [1, 1]", &["a second run", "seed=1"]),
    ("time = 0.005", "time = 0", &["line 3", "`time`", "above 0"]),
    ("[grid]", "[grid]\n\"time\" = [0.001, 0.002]", &["line 7", "`time`", "0.001", "left out"]),
    ("[grid]", "[grid]\n\"seed\" = [3, 4]", &["line 7", "`seed`", "`seeds`", "left out"]),
    ("[2.5, 5]", "[]", &["line 7", "grid.liquid.moisture_percent", "a list"]),
    ("[2.5, 5]", "5", &["line 7", "a list"]),
    ("[2.5, 5]", "[2.5, -5]", &["line 7", "`liquid.moisture_percent`", "-5", "0 to 100"]),
    ("moisture_percent", "moisture", &["line 7", "`liquid.moisture`", "`moisture_percent`"]),
    ("[\"lambert\"]", "[\"lamb\"]", &["line 8", "`liquid.capillary`", "lambert"]),
    ("name = \"long-step\"", "name = \"a/b\"", &["line 11", "rows[0].name", "letters"]),
    ("classes[0].count", "classes[7].count", &["line 15", "classes[7].count", "below 3"]),
    ("time_step = 1e-4", "time_step = \"x\"", &["line 12", "time_step", "a number"]),
    ("[grid]", "[gird]", &["line 6", "gird", "`grid`"]),
    ("[grid]", "[grid", &["line 6", "TOML"]),
];

#[test]
fn bad_sweeps_say_where_and_what_is_allowed_before_anything_runs() {
    let folder = folder(SWEEP);
    for (from, to, wanted) in BAD {
        assert!(SWEEP.contains(from), "the sweep has no `{from}`");
        fs::write(folder.path().join("s.toml"), SWEEP.replacen(from, to, 1)).unwrap();
        let done = run(folder.path(), &["sweep", "s.toml"]);
        let said = text(&done.stderr);
        assert_eq!(done.status.code(), Some(2), "{to}: {said}");
        for word in *wanted {
            assert!(said.contains(word) && said.contains("s.toml"), "{to}: `{word}`: {said}");
        }
        assert!(!folder.path().join("out").exists(), "{to}");
    }
}

#[test]
fn a_seed_that_a_row_sets_stands_in_the_column_of_seeds() {
    let folder = folder("scene = \"small.toml\"\ntime = 0.001\n[[rows]]\nname = \"a\"\nseed = 7\n");
    let done = run(folder.path(), &["sweep", "s.toml", "--gather", "--quiet"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert_eq!(text(&done.stdout), "table in out/s/sweep.csv\n");
    let header = fs::read_to_string(folder.path().join("out/s/sweep.csv")).unwrap();
    let header: Vec<&str> = header.lines().next().unwrap().split(',').collect();
    assert_eq!(header.iter().filter(|name| **name == "seed").count(), 1, "{header:?}");
    assert_eq!(table(folder.path())["a"]["seed"], "7");
}

#[test]
fn no_jobs_and_no_threads_are_refused() {
    let folder = folder(SWEEP);
    for (option, allowed) in [("--jobs", "a whole number from 1"), ("--threads", "1 to 1024")] {
        for emit in [&[][..], &["--emit", "list"]] {
            let done = run(folder.path(), &[&["sweep", "s.toml", option, "0"], emit].concat());
            let said = text(&done.stderr);
            assert_eq!(done.status.code(), Some(2), "{said}");
            assert!(said.contains(option) && said.contains(allowed), "{said}");
        }
    }
    assert!(!folder.path().join("out").exists());
}

#[test]
fn the_sample_is_a_good_sweep() {
    let folder = folder("");
    let wrote = run(folder.path(), &["sample", "--sweep", "mine.toml"]);
    assert!(wrote.status.success() && text(&wrote.stdout).contains("batch_screen sweep mine.toml"));
    let list = run(folder.path(), &["sweep", "mine.toml", "--emit", "list"]);
    assert!(list.status.success(), "{}", text(&list.stderr));
    assert_eq!(text(&list.stdout).lines().count(), 16);
    // A file that is there is left alone, unless it is to be replaced.
    fs::write(folder.path().join("mine.toml"), "changed").unwrap();
    let sample = ["sample", "--sweep", "mine.toml"];
    let twice = run(folder.path(), &sample);
    let said = text(&twice.stderr);
    assert_eq!(twice.status.code(), Some(2), "{said}");
    assert!(said.contains("mine.toml exists already") && said.contains("--overwrite"), "{said}");
    let now = || fs::read_to_string(folder.path().join("mine.toml")).unwrap();
    assert_eq!(now(), "changed");
    assert!(run(folder.path(), &[&sample[..], &["--overwrite"]].concat()).status.success());
    assert!(now().contains("[grid]"));
}
