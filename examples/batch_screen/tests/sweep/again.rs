//! Sweeps into a folder that holds runs already, or that another sweep writes into.

use std::fs;
use std::process::Stdio;

use crate::common::{program, run, small, terminate, text};
use crate::{folder, table};

#[test]
fn a_sweep_that_is_stopped_goes_on_to_the_same_tables() {
    let sweep = "scene = \"small.toml\"\ntime = 0.6\nseeds = [1, 2]\n";
    let folder = folder(sweep);
    let quick = ["--threads", "1", "--checkpoint-every", "0.05"];
    let mut child = program()
        .current_dir(folder.path())
        .args(["sweep", "s.toml"])
        .args(quick)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let started = folder.path().join("out/s/base_seed=1/checkpoint.bin");
    while !started.exists() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    terminate(&child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let rows = table(folder.path());
    assert_eq!(rows["base_seed=1"]["status"], "interrupted");
    assert_eq!(rows["base_seed=2"]["status"], "waiting");
    let done = run(folder.path(), &["sweep", "s.toml", "--threads", "1"]);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(table(folder.path()).values().all(|row| row["status"] == "finished"));
    let whole = ["run", "small.toml", "--time", "0.6", "--seed", "1", "--out", "whole"];
    assert!(run(folder.path(), &whole).status.success());
    for name in ["retained.csv", "liquid.csv", "passages.csv", "energy.csv", "liquid_final.csv"] {
        let read = |at: &str| fs::read(folder.path().join(at).join(name)).unwrap();
        assert!(read("whole") == read("out/s/base_seed=1"), "{name} differs");
    }
}

#[test]
fn a_row_shows_its_settings_as_they_are_and_the_results_of_no_others() {
    let sweep = |row: &str| {
        format!("scene = \"small.toml\"\ntime = 0.001\n[[rows]]\nname = \"a\"\n{row}\n")
    };
    let folder = folder(&sweep("screen.aperture_mm = 7\nliquid.viscosity = 2e-3"));
    let args = ["sweep", "s.toml", "--threads", "1"];
    let done = run(folder.path(), &args);
    assert!(done.status.success(), "{}", text(&done.stderr));
    assert!(text(&done.stdout).contains("a: finished: fraction retained 1.0000, 0."), "{done:?}");
    assert!(!table(folder.path())["a"]["retained 5 mm"].is_empty());
    let cells = |row: &str, how: &[&str]| {
        fs::write(folder.path().join("s.toml"), sweep(row)).unwrap();
        let done = run(folder.path(), &[&args[..], how].concat());
        (done.status.code(), table(folder.path()).remove("a").unwrap())
    };
    // The folder holds the run with 7 mm.
    for how in [&[][..], &["--gather"]] {
        let (code, row) = cells("screen.aperture_mm = 6", how);
        assert_eq!((code, &*row["status"], &*row["exit"]), (Some(1), "failed", "1"), "{how:?}");
        assert_eq!((&*row["screen.aperture_mm"], &*row["liquid.viscosity"]), ("6", ""));
        for column in ["time_s", "retained", "retained 5 mm", "steps", "wall_time_s"] {
            assert_eq!(row[column], "", "{column}");
        }
    }
    // Without a folder it is the table that knows of the failure, as long as it is about this row.
    fs::remove_dir_all(folder.path().join("out/s/a")).unwrap();
    let (code, row) = cells("screen.aperture_mm = 6", &["--gather"]);
    assert_eq!((code, &*row["status"], &*row["exit"]), (Some(1), "failed", "1"));
    let (code, row) = cells("screen.aperture_mm = 7", &["--gather"]);
    assert_eq!((code, &*row["status"], &*row["message"]), (Some(0), "waiting", ""));
}

/// A triangle far from all spheres, as a file in mm.
fn triangle(x: f64) -> String {
    format!(
        "solid t\nfacet normal 0 0 1\nouter loop\nvertex {x} 0 -5\nvertex 31 0 -5\nvertex 30 1 -5\n\
         endloop\nendfacet\nendsolid t\n"
    )
}

#[test]
fn a_file_that_has_changed_between_two_calls_is_noticed() {
    let folder = folder("scene = \"small.toml\"\ntime = 0.001\nseeds = [1]\n");
    let at = |name: &str| folder.path().join(name);
    let scene = small().replace("\"packing.floor_height_mm\", ", "").replace("count = 16\n", "");
    let [second, packing, screen] = [
        scene.match_indices("[[classes]]").nth(1).unwrap().0,
        scene.find("[packing]").unwrap(),
        scene.find("[screen]").unwrap(),
    ];
    assert!(second < packing);
    let scene = format!(
        "{}[packing]\nfrom = \"file\"\npath = \"bed.csv\"\n\n[[parts]]\nname = \"lip\"\n\
         stl = \"lip.stl\"\nmaterial = \"steel\"\n\n{}",
        &scene[..second],
        &scene[screen..]
    );
    let bed = |z: f64| format!("id,x,y,z,radius,density\n0,0,0,{z},0.0025,1358\n");
    fs::write(at("small.toml"), scene).unwrap();
    fs::write(at("lip.stl"), triangle(32.0)).unwrap();
    fs::write(at("bed.csv"), bed(0.02)).unwrap();
    let args = ["sweep", "s.toml", "--threads", "1"];
    let done = run(folder.path(), &args);
    assert!(done.status.success(), "{}", text(&done.stderr));
    for (name, key, other, same) in [
        ("lip.stl", "parts[0].stl", triangle(33.0), triangle(32.0)),
        ("bed.csv", "packing.path", bed(0.021), bed(0.02)),
    ] {
        fs::write(at(name), other).unwrap();
        for how in [&[][..], &["--gather"], &["--only", "1"]] {
            let done = run(folder.path(), &[&args[..], how].concat());
            assert_eq!(done.status.code(), Some(1), "{how:?}: {}", text(&done.stderr));
            let told = text(&done.stderr) + &table(folder.path())["base_seed=1"]["message"];
            for word in [name, key, "has changed since", "remove the folder"] {
                assert!(told.contains(word), "{how:?}: `{word}` is not in: {told}");
            }
        }
        let row = table(folder.path()).remove("base_seed=1").unwrap();
        assert_eq!((&*row["status"], &*row["exit"], &*row["retained"]), ("failed", "1", ""));
        // As it was, it is that run again.
        fs::write(at(name), same).unwrap();
        let done = run(folder.path(), &args);
        assert!(text(&done.stdout).contains("1 runs, 1 of them done"), "{}", text(&done.stdout));
        assert_eq!(table(folder.path())["base_seed=1"]["status"], "finished");
    }
    // And without its folder it is run with what is there now.
    fs::write(at("bed.csv"), bed(0.021)).unwrap();
    fs::remove_dir_all(at("out/s/base_seed=1")).unwrap();
    let done = run(folder.path(), &args);
    assert!(done.status.success(), "{}", text(&done.stderr));
    let replay = fs::read_to_string(at("out/s/base_seed=1/replay.csv")).unwrap();
    assert!(replay.lines().nth(1).unwrap().contains("0.021"), "{replay}");
}

#[test]
fn two_sweeps_do_not_write_into_one_folder() {
    let folder = folder("scene = \"small.toml\"\ntime = 60\nseeds = [1, 2]\n");
    let args = ["sweep", "s.toml", "--threads", "1"];
    let mut first = program();
    let quiet = first.current_dir(folder.path()).args(args).stdout(Stdio::null());
    let mut first = quiet.stderr(Stdio::null()).spawn().unwrap();
    let started = folder.path().join("out/s/base_seed=1/checkpoint.bin");
    while !started.exists() && first.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(2));
    }
    let before = fs::read(folder.path().join("out/s/sweep.csv")).unwrap();
    for how in [&[][..], &["--gather"]] {
        let second = run(folder.path(), &[&args[..], how].concat());
        let said = text(&second.stderr);
        assert_eq!(second.status.code(), Some(2), "{how:?}: {said}");
        assert!(said.contains("out/s is being written by another run or sweep"), "{said}");
    }
    assert!(fs::read(folder.path().join("out/s/sweep.csv")).unwrap() == before);
    terminate(&first);
    assert_eq!(first.wait().unwrap().code(), Some(130));
    // Whoever has gone holds nothing.
    let third = run(folder.path(), &[&args[..], &["--gather"]].concat());
    assert!(third.status.success(), "{}", text(&third.stderr));
    assert_eq!(table(folder.path())["base_seed=1"]["status"], "interrupted");
}
