//! What a run leaves behind: its scene, and earlier runs that it does not replace.

use std::fs;

use crate::common::{TABLES, run, small, summary, text};

#[test]
fn the_scene_as_it_was_run_is_kept_and_runs_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let scene = small().replace("capillary = \"tabulated\"", "capillary = \"auto\"");
    fs::create_dir(at("in")).unwrap();
    fs::write(at("in/small.toml"), scene).unwrap();
    let given = ["--time", "0.02", "--dt", "4e-6", "--seed", "4", "--set", "liquid.viscosity=2e-3"];
    let first = run(folder.path(), &[&["run", "in/small.toml", "--out", "a"], &given[..]].concat());
    assert!(first.status.success(), "{}", text(&first.stderr));
    let kept = fs::read_to_string(at("a/scene.toml")).unwrap();
    let values: toml::Table = kept.parse().unwrap();
    assert_eq!(values["time"].as_float(), Some(0.02));
    assert_eq!(values["time_step"].as_float(), Some(4e-6));
    assert_eq!(values["seed"].as_integer(), Some(4));
    let liquid = &values["liquid"];
    assert_eq!(liquid["viscosity"].as_float(), Some(2e-3));
    assert_ne!(liquid["capillary"].as_str(), Some("auto"));
    assert_eq!(liquid["drag"].as_str(), Some("explicit"));
    let again = run(folder.path(), &["run", "a/scene.toml", "--out", "b"]);
    assert!(again.status.success(), "{}", text(&again.stderr));
    let bytes = |run: &str, name: &str| fs::read(at(run).join(name)).unwrap();
    TABLES.iter().for_each(|name| assert!(bytes("a", name) == bytes("b", name), "{name}"));
    let table = |run: &str| text(&bytes(run, "scene.toml")).parse::<toml::Table>().unwrap();
    assert_eq!(table("a"), table("b"));
    // The page and a comparison have it too.
    assert!(text(&bytes("a", "report.html")).contains("[\"liquid.viscosity\",0.002]"));
    // Whoever keeps a scene of that name in a folder does not lose it.
    fs::write(at("in/scene.toml"), small()).unwrap();
    for overwrite in [&[][..], &["--overwrite"]] {
        let done = run(folder.path(), &[&["run", "demo", "--out", "in"], overwrite].concat());
        assert_eq!(done.status.code(), Some(2));
        assert!(text(&done.stderr).contains("in/scene.toml is no scene of an earlier run"));
    }
    assert_eq!(fs::read_to_string(at("in/scene.toml")).unwrap(), small());
}

#[test]
fn the_largest_seed_runs_again_from_the_kept_scene() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    let loose = "packing={from=\"random\", solid_fraction=0.2, clearance_mm=2}";
    let short = ["--time", "0.001", "--set", loose, "--seed", "9223372036854775807", "--out", "a"];
    let first = run(folder.path(), &[&["run", "small.toml"], &short[..]].concat());
    assert!(first.status.success(), "{}", text(&first.stderr));
    let again = run(folder.path(), &["run", "a/scene.toml", "--out", "b"]);
    assert!(again.status.success(), "{}", text(&again.stderr));
    let replay = |run: &str| fs::read(folder.path().join(run).join("replay.csv")).unwrap();
    assert!(replay("a") == replay("b"));
}

#[test]
fn files_of_a_scene_are_found_again_from_the_folder_of_its_run() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("in")).unwrap();
    let bed = "id,x,y,z,radius,density\n0,0,0,0.02,0.0025,1358\n";
    fs::write(folder.path().join("in/bed.csv"), bed).unwrap();
    let scene = small().replace("\"packing.floor_height_mm\", ", "");
    fs::write(folder.path().join("in/s.toml"), scene).unwrap();
    let packing = "packing={from=\"file\", path=\"bed.csv\"}";
    let classes = "classes=[{name=\"5 mm\", material=\"POM\", diameter_mm=5, density=1358}]";
    let from = ["--set", packing, "--set", classes, "--time", "0.001"];
    let first = run(folder.path(), &[&["run", "in/s.toml", "--out", "a"], &from[..]].concat());
    assert!(first.status.success(), "{}", text(&first.stderr));
    let again = run(folder.path(), &["run", "a/scene.toml", "--out", "b"]);
    assert!(again.status.success(), "{}", text(&again.stderr));
}

/// Every file of a folder with its bytes.
fn contents(folder: &std::path::Path) -> Vec<(std::ffi::OsString, Vec<u8>)> {
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let mut all: Vec<_> =
        files.map(|file| (file.file_name(), fs::read(file.path()).unwrap())).collect();
    all.sort();
    all
}

#[test]
fn a_run_takes_the_place_of_another_only_when_asked_to() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    let loose = "packing={from=\"random\", solid_fraction=0.2, clearance_mm=2}";
    let again = |time: &str, options: &[&str]| {
        let short = ["run", "small.toml", "--set", loose, "--time", time];
        run(folder.path(), &[&short[..], options].concat())
    };
    let at = |name: &str| folder.path().join("out").join(name);
    assert!(again("0.001", &[]).status.success());
    let first = contents(&at("small"));
    // Without --out each run has a folder of its own.
    let second = again("0.002", &["--quiet"]);
    assert!(
        text(&second.stderr).contains("out/small is there already: this run goes to out/small-2")
    );
    assert!(text(&second.stdout).contains("results in out/small-2"), "{}", text(&second.stdout));
    assert_eq!(summary(&at("small-2"))["time_s"], 0.002);
    // With it, one that holds a run is refused, before anything is touched.
    let refused = again("0.003", &["--out", "out/small"]);
    let said = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{said}");
    for way in ["holds a run already", "--overwrite", "resume out/small`", "another --out"] {
        assert!(said.contains(way), "`{way}` is not in: {said}");
    }
    assert!(contents(&at("small")) == first);
    // Where it is asked for, the earlier run goes, with what only it had.
    let series = at("small").join("paraview/walls.pvd");
    let vtk = ["--vtk", "0.001", "--overwrite", "--out", "out/small"];
    assert!(again("0.003", &vtk).status.success() && series.exists());
    assert!(fs::read_dir(at("small").join("paraview")).unwrap().count() > 6);
    assert_eq!(summary(&at("small"))["time_s"], 0.003);
    assert!(again("0.004", &["--overwrite"]).status.success());
    assert_eq!(summary(&at("small"))["time_s"], 0.004);
    assert!(!series.exists() && !at("small-3").exists());
    assert_eq!(fs::read_dir(at("small").join("paraview")).unwrap().count(), 0);
    // A folder that holds no run is none to be replaced, nor is a file that is no page.
    fs::copy(at("small").join("scene.toml"), folder.path().join("beds.toml")).unwrap();
    fs::create_dir_all(at("beds")).unwrap();
    let beds = contents(&at("beds"));
    assert!(run(folder.path(), &["run", "beds.toml", "--overwrite"]).status.success());
    assert!(contents(&at("beds")) == beds && at("beds-2").join("summary.json").exists());
    let scene = fs::read(folder.path().join("beds.toml")).unwrap();
    for option in ["--out", "--svg"] {
        let refused = run(folder.path(), &["compare", "out/small", option, "beds.toml"]);
        assert_eq!(refused.status.code(), Some(2), "{}", text(&refused.stderr));
    }
    assert_eq!(fs::read(folder.path().join("beds.toml")).unwrap(), scene);
}

#[test]
#[cfg(target_os = "linux")]
fn what_cannot_be_written_is_found_before_the_bed_settles_and_leaves_no_half_files() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    for place in [["--out", "/proc/no-such"], ["--beds", "/proc/self"]] {
        let done = run(folder.path(), &[&["run", "small.toml"], &place[..]].concat());
        let said = text(&done.stderr);
        assert_eq!(done.status.code(), Some(1), "{said}");
        assert!(said.contains("cannot write /proc/") && !said.contains("settling"), "{said}");
    }
    // A limit of 24 kB on every file: the replay does not fit.
    let limited = |command: &str| {
        let command =
            format!("ulimit -f 24; exec {} {command}", env!("CARGO_BIN_EXE_batch_screen"));
        let mut shell = std::process::Command::new("bash");
        shell.current_dir(folder.path()).args(["-c", &command]).output().unwrap()
    };
    let loose = "packing={from=\"random\", solid_fraction=0.2, clearance_mm=2}";
    let done = limited(&format!("run small.toml --set '{loose}' --out full"));
    let said = text(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write full/replay.csv"), "{said}");
    let names = fs::read_dir(folder.path().join("full")).unwrap().map(|e| e.unwrap().file_name());
    let half: Vec<_> = names.filter(|name| name.to_string_lossy().contains(".part")).collect();
    assert!(half.is_empty(), "{half:?}");
    // With room again it goes on, to what a run that always had it gives.
    let resumed = run(folder.path(), &["resume", "full"]);
    assert!(resumed.status.success(), "{}", text(&resumed.stderr));
    assert!(
        run(folder.path(), &["run", "small.toml", "--set", loose, "--out", "a"]).status.success()
    );
    let bytes = |run: &str, name: &str| fs::read(folder.path().join(run).join(name)).unwrap();
    TABLES.iter().for_each(|name| assert!(bytes("a", name) == bytes("full", name), "{name}"));
}
