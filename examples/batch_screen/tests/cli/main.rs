//! The program as a user meets it: good runs, bad scenes, nothing lost.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

use std::fs;

#[path = "../common/mod.rs"]
mod common;
mod kept;
mod scenes;

use common::{TABLES, run, small, summary, text};

#[test]
fn lists_shows_and_checks_every_built_in_scene() {
    let folder = tempfile::tempdir().unwrap();
    let list = run(folder.path(), &["list"]);
    assert!(list.status.success());
    let names: Vec<String> = text(&list.stdout)
        .lines()
        .map(|line| line.split_whitespace().next().unwrap().to_owned())
        .collect();
    assert_eq!(names.len(), 19);
    for name in &names {
        let shown = run(folder.path(), &["show", name]);
        assert!(shown.status.success() && text(&shown.stdout).contains("[screen]"));
    }
    let check = run(folder.path(), &["check", "e18-02"]);
    let said = text(&check.stdout);
    assert!(check.status.success(), "{}", text(&check.stderr));
    assert!(said.contains("limit") && said.contains("2813 spheres"), "{said}");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "a check writes nothing");
}

#[test]
fn a_wet_run_writes_its_tables_and_keeps_its_liquid() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    let done = run(folder.path(), &["run", "small.toml", "--out", "one", "--threads", "1"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let summary = summary(&folder.path().join("one"));
    assert!(summary["liquid_imbalance"].as_f64().unwrap().abs() < 1e-12);
    assert_eq!(summary["escaped"], 0);
    assert!(summary["bridges"]["formed"].as_u64().unwrap() > 10);
    assert!(summary["largest_overlap"].as_f64().unwrap() < 0.05);
    let mut liquid = csv::Reader::from_path(folder.path().join("one/liquid.csv")).unwrap();
    let total = liquid.headers().unwrap().iter().position(|h| h == "total [m3]").unwrap();
    let totals: Vec<f64> =
        liquid.records().map(|row| row.unwrap()[total].parse().unwrap()).collect();
    assert_eq!(totals.len(), 9);
    assert!(totals.iter().all(|v| (v / totals[0] - 1.0).abs() < 1e-8));
    divisions(&folder.path().join("one"), &totals, &summary);
    headers_are_those_of_the_docs(&folder.path().join("one"));
    let percent = summary["time_split_percent"].as_object().unwrap();
    let all: f64 = percent.values().map(|v| v.as_f64().unwrap()).sum();
    assert!(percent.len() == 6 && (all - 100.0).abs() < 1e-9, "{percent:?}");
    assert!(text(&done.stdout).contains("wall time: neighbours"));
    let mut retained = csv::Reader::from_path(folder.path().join("one/retained.csv")).unwrap();
    let first = retained.records().next().unwrap().unwrap();
    assert_eq!(&first[0], "0.000000");
    assert!((1..=4).all(|k| (first[k].parse::<f64>().unwrap() - 1.0).abs() < 1e-12));
    // The same scene again, on two threads and from the kept bed, gives the same bytes.
    let again = run(folder.path(), &["run", "small.toml", "--out", "two", "--threads", "2"]);
    assert!(again.status.success(), "{}", text(&again.stderr));
    for table in ["retained.csv", "liquid.csv", "passages.csv", "replay.csv", "energy.csv"] {
        let read = |run: &str| fs::read(folder.path().join(run).join(table)).unwrap();
        assert!(read("one") == read("two"), "{table} differs");
    }
}

/// Every table has the header that `docs/tables.md` says.
fn headers_are_those_of_the_docs(folder: &std::path::Path) {
    let docs = include_str!("../../../../docs/tables.md");
    let rows: Vec<(&str, &str)> =
        docs.lines().filter_map(|line| line.strip_prefix("| `")?.split_once(".csv` | ")).collect();
    assert_eq!(rows.len(), TABLES.len());
    for (name, columns) in rows {
        let columns = columns.split(" | ").next().unwrap();
        let mut told = Vec::new();
        for column in columns.split('`').skip(1).step_by(2) {
            let each: &[&str] = match column {
                c if c.contains("CLASS") => &["5 mm", "7 mm", "10 mm"],
                c if c.contains("PART") => &["wires", "frame", "impact plate", "outlet"],
                _ => &[""],
            };
            let named = |n: &&str| column.replace("CLASS", n).replace("PART", n);
            told.extend(each.iter().map(named));
        }
        let table = fs::read_to_string(folder.join(format!("{name}.csv"))).unwrap();
        assert_eq!(table.lines().next().unwrap(), told.join(","), "{name}.csv");
    }
}

/// The liquid at the end adds up, and agrees with the last row of the split over time.
fn divisions(folder: &std::path::Path, totals: &[f64], summary: &serde_json::Value) {
    let mut table = csv::Reader::from_path(folder.join("liquid_final.csv")).unwrap();
    let rows: Vec<(String, String, [f64; 3])> =
        table.deserialize().map(|row| row.unwrap()).collect();
    let sum = |division: &str, k: usize| {
        let those = rows.iter().filter(|row| row.0 == division && row.1 != "all");
        those.map(|row| row.2[k]).sum::<f64>()
    };
    let of = |division: &str, place: &str| {
        rows.iter().find(|row| row.0 == division && row.1 == place).unwrap().2
    };
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-9 * totals[0], "{a} {b}");
    for division in ["apparatus", "coarse and screen", "fines"] {
        (0..2).for_each(|k| close(sum(division, k), of(division, "all")[k]));
    }
    let [all, bridges, share] = of("all", "all");
    close(all, totals[0]);
    close(bridges, summary["liquid_m3"]["bridges"].as_f64().unwrap());
    assert!((share - 1.0).abs() < 1e-9 && of("residuals", "all")[0].abs() < 1e-9 * all);
    let mut shared = csv::Reader::from_path(folder.join("liquid_shared.csv")).unwrap();
    let header = shared.headers().unwrap().clone();
    let last = shared.records().last().unwrap().unwrap();
    let cell = |name: &str| -> f64 {
        last[header.iter().position(|h| h == name).unwrap()].parse().unwrap()
    };
    close(of("coarse and screen", "wires")[0], cell("wires [m3]"));
    close(of("coarse and screen", "5 mm")[0], cell("above 5 mm [m3]"));
    let frame = of("apparatus", "feed bin")[0] + of("coarse and screen", "screen frame")[0];
    close(frame, cell("frame [m3]"));
    assert!(of("coarse and screen", "wires")[0] > 0.0 && bridges > 0.0);
}

#[test]
fn a_dry_run_has_no_liquid_tables() {
    let folder = tempfile::tempdir().unwrap();
    let dry = small();
    let dry = &dry[..dry.find("[liquid]").unwrap()];
    fs::write(folder.path().join("dry.toml"), dry).unwrap();
    let done = run(folder.path(), &["run", "dry.toml", "--time", "0.03"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(folder.path().join("out/dry/retained.csv").exists());
    assert!(!folder.path().join("out/dry/liquid.csv").exists());
    // One with a liquid but none of it has them, full of plain zeros.
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    let none = ["run", "small.toml", "--time", "0.03", "--set", "liquid.moisture_percent=0"];
    let done = run(folder.path(), &none);
    assert!(done.status.success(), "{}", text(&done.stderr));
    for name in
        ["liquid.csv", "liquid_shared.csv", "liquid_final.csv", "energy.csv", "summary.json"]
    {
        let text = fs::read_to_string(folder.path().join("out/small").join(name)).unwrap();
        assert!(!text.contains("-0.0"), "{name}: {text}");
    }
    assert!(!text(&done.stdout).contains("-0"), "{}", text(&done.stdout));
    assert_eq!(summary(&folder.path().join("out/small"))["time_s"], 0.03);
}

#[test]
fn a_viscous_scene_runs_at_the_step_of_its_contacts() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    let check = |set: &[&str]| {
        let both = [&["check", "small.toml", "--set", "liquid.viscosity=10.0"], set].concat();
        text(&run(folder.path(), &both).stdout)
    };
    let said = check(&[]);
    assert!(said.contains("drag         implicit") && !said.contains("viscous drag"), "{said}");
    let said = check(&["--set", "liquid.drag=explicit"]);
    assert!(said.contains("drag         explicit, as asked for"), "{said}");
    assert!(said.contains("set by the viscous drag"), "{said}");
    let short = ["run", "small.toml", "--time", "0.02", "--set", "liquid.viscosity=10.0"];
    let ran = run(folder.path(), &short);
    assert!(ran.status.success(), "{}", text(&ran.stderr));
    assert!(!text(&ran.stdout).contains("most passes"), "{}", text(&ran.stdout));
    let finer = ["--set", "liquid.viscosity=1e6", "--set", "liquid.drag_tolerance=1e-9"];
    let ran = run(folder.path(), &[&short[..], &["--out", "finer"], &finer].concat());
    let summary = &common::summary(&folder.path().join("finer"))["drag_passes_since_resume"];
    let said = format!("{} of {} steps", summary["steps_at_most_passes"], summary["steps"]);
    assert!(text(&ran.stdout).contains(&said), "{said}: {}", text(&ran.stdout));
    let refused = run(folder.path(), &[&short[..], &["--set", "liquid.drag=explicit"]].concat());
    assert!(text(&refused.stderr).contains("viscous drag"), "{}", text(&refused.stderr));
    let unknown = run(folder.path(), &["check", "small.toml", "--set", "liquid.drag=partly"]);
    let said = text(&unknown.stderr);
    assert!(said.contains("partly") && said.contains("implicit"), "{said}");
}
