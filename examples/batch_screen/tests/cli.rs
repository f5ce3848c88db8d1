//! The program as a user meets it: good runs, bad scenes, nothing lost.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

use std::fs;

mod common;

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
    let docs = include_str!("../../../docs/tables.md");
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

/// Bad scenes: what is changed in a good one, where the error must point (at the change where
/// nothing is said), and what it must say.
const BAD: &[(&str, &str, &str, &[&str])] = &[
    (
        "aperture_mm = 8",
        "apperture_mm = 8",
        "",
        &["screen.apperture_mm", "allowed", "`aperture_mm`"],
    ),
    ("aperture_mm = 8", "aperture_mm = -8", "", &["screen.aperture_mm", "-8", "above 0"]),
    ("aperture_mm = 8", "aperture_mm = \"8\"", "", &["screen.aperture_mm", "allowed: a number"]),
    ("aperture_mm = 8", "aperture_mm = true", "", &["screen.aperture_mm", "allowed: a number"]),
    ("aperture_mm = 8", "aperture_mm = nan", "", &["screen.aperture_mm", "NaN"]),
    ("aperture_mm = 8", "aperture_mm = 8 8", "", &["aperture_mm"]),
    ("aperture_mm = 8", "", "[screen]", &["screen.aperture_mm", "missing"]),
    ("wire_diameter_mm = 2", "wire_diameter_mm = 0", "", &["screen.wire_diameter_mm"]),
    ("wires = \"cylinders\"", "wires = \"ropes\"", "", &["screen.wires", "cylinders", "mesh"]),
    ("diameter_mm = 5\n", "diameter_mm = 0\n", "", &["classes[0].diameter_mm"]),
    ("density = 1358", "density = inf", "", &["classes[0].density", "inf"]),
    ("count = 16", "mass_g = -1", "", &["classes[0].mass_g"]),
    ("count = 16", "count = -1", "", &["classes[0].count", "a whole number"]),
    ("count = 16", "count = 0", "", &["classes[0].count", "a whole number from 1"]),
    ("count = 16", "count = 9000000000", "", &["classes[0].count", "spheres", "1e8"]),
    ("count = 16", "mass_g = 0.01", "", &["classes[0].mass_g", "8.888e-2 g, the mass of one"]),
    ("name = \"5 mm\"", "name = \"\"", "", &["classes[0].name", "a name for the tables"]),
    ("name = \"5 mm\"", "name = \"total\"", "", &["classes[0].name", "such as `total`"]),
    ("name = \"5 mm\"", "name = \"5,mm\"", "", &["classes[0].name", "commas"]),
    ("name = \"5 mm\"", "name = \"5\\nmm\"", "", &["classes[0].name", "line ends"]),
    ("diameter_mm = 10\n", "diameter_mm = 320\n", "", &["classes[2]", "does not fit into the"]),
    ("density = 1358", "density = 1e999", "", &["classes[0].density", "allowed: a number up to"]),
    ("time_step = 5e-6", "time_step = 1e-300", "", &["`time_step`", "1e12 steps, a time step"]),
    ("time = 0.08", "time = 1e300", "", &["`time`", "2.0e305 steps", "1e12 steps, 5.0e6 s"]),
    ("output_interval = 0.01", "output_interval = 1e-99", "", &["output_interval", "8.0e-10 s"]),
    (
        "stiffness = 1e5",
        "stiffness = 1",
        "",
        &["contact.stiffness", "7 N/m", "guard.overlap_share"],
    ),
    ("seed = 1\n", "seed = 1\ngravity = [0, 0, 9.81]\n", "gravity", &["gravity[2]", "below 0"]),
    ("height_mm = 120", "height_mm = 1e300", "", &["screen.height_mm", "1e300", "at most 10000"]),
    ("density = 1000", "density = 1e-300", "", &["liquid.density", "1e-300", "1 to 100000"]),
    ("= 0.07275", "= 1e300", "surface_tension", &["liquid.surface_tension", "at most 1000"]),
    ("aperture_mm = 8", "aperture_mm = 500", "", &["screen.aperture_mm", "500 mm", "40 mm"]),
    (
        "aperture_mm = 8\nwire_diameter_mm = 2",
        "aperture_mm = 1e-9\nwire_diameter_mm = 1e-9",
        "",
        &["screen.aperture_mm", "10000 wires"],
    ),
    (
        "0.05, 1.0]",
        "0.05, 500]",
        "amplitude_mm = [",
        &["motion.amplitude_mm[2]", "500 mm", "120 mm"],
    ),
    ("[0.08, 0.05,", "[30, 0.05,", "amplitude_mm = [", &["motion.amplitude_mm", "below 20 mm"]),
    ("wires = \"cylinders\"", "wires = true", "", &["screen.wires", "`cylinders` or `mesh`"]),
    ("from = \"bin\"", "from = 3", "", &["packing.from", "`random`, `bin`, `file`"]),
    ("[liquid]", "[[liquid]]", "", &["`liquid`", "allowed: one table, `[liquid]`"]),
    ("count = 16", "", "[[classes]]", &["classes[0].mass_g", "count"]),
    ("count = 16", "count = 16\nmass_g = 1", "", &["classes[0]", "one of the two"]),
    ("name = \"7 mm\"", "name = \"5 mm\"", "", &["classes[1].name"]),
    ("material = \"POM\"", "material = \"PON\"", "", &["classes[0].material", "PON", "steel"]),
    (
        "capillary = \"tabulated\"",
        "capillary = \"lambda\"",
        "",
        &["liquid.capillary", "`lambda` is not allowed; allowed: rabinovich, lambert", ", auto"],
    ),
    ("normal_drag = \"pitois\"", "normal_drag = \"x\"", "", &["liquid.normal_drag", "pitois"]),
    ("rupture = \"tabulated\"", "rupture = \"w\"", "", &["liquid.rupture", "mikami"]),
    ("transfer = \"exact\"", "transfer = \"thirds\"", "", &["transfer", "parabola"]),
    ("contact_angle_deg = 40", "contact_angle_deg = 180", "", &["materials.POM", "179"]),
    ("restitution = 0.8038", "restitution = 1.5", "", &["contacts[0].restitution", "1"]),
    ("friction = 0.3725", "friction = -1", "", &["contacts[0].friction"]),
    ("[\"POM\", \"steel\"]", "[\"POM\", \"POM\"]", "[[contacts]]", &["contacts", "POM with steel"]),
    ("[\"POM\", \"steel\"]", "[\"POM\"]", "", &["contacts[1].between"]),
    ("moisture_percent = 5", "moisture_percent = -5", "", &["liquid.moisture_percent"]),
    ("surface_tension = 0.07275", "surface_tension = 0", "", &["liquid.surface_tension"]),
    ("stiffness = 1e5", "stiffness = 0", "", &["contact.stiffness"]),
    ("solid_fraction = 0.3", "solid_fraction = 0.7", "", &["packing.solid_fraction", "0.35"]),
    ("from = \"bin\"", "from = \"heap\"", "", &["packing", "random", "bin", "file"]),
    ("solid_fraction = 0.3", "fraction = 0.3", "", &["packing.fraction", "solid_fraction"]),
    ("seed = 1\n", "seed = 1.5\n", "", &["seed", "a whole number"]),
    (
        "seed = 1\n",
        "seed = 9223372036854775808\n",
        "",
        &["seed", "too large; allowed: a whole number up to 9223372036854775807"],
    ),
    ("output_interval = 0.01", "output_interval = 0", "", &["output_interval", "above 0"]),
    ("phase_deg = [90, 45, 0]", "phase_deg = [90, 45]", "", &["motion.phase_deg", "3"]),
    (
        "time_step = 5e-6",
        "time_step = 1e-3",
        "",
        &["time_step", "class 5 mm", "contact springs and dashpots", "run --allow-unstable"],
    ),
    ("height_mm = 120", "height_mm = 13", "solid_fraction", &["screen.height_mm"]),
    ("title = ", "tittle = ", "", &["tittle", "`title`"]),
    ("[motion]", "[motions]", "", &["motions", "`motion`"]),
    ("[packing]", "packing = {", "", &["column 11: the inline table", "not closed", "`}`"]),
    ("[90, 45, 0]", "[90, 45, 0", "phase_deg = ", &["column 13: the list", "not closed", "`]`"]),
];

#[test]
fn bad_scenes_say_where_and_what_is_allowed_and_leave_results_alone() {
    let folder = tempfile::tempdir().unwrap();
    let kept = folder.path().join("out/bad/retained.csv");
    fs::create_dir_all(kept.parent().unwrap()).unwrap();
    fs::write(&kept, "earlier results").unwrap();
    let good = small();
    for (from, to, at, wanted) in BAD {
        let start = good.find(from).unwrap_or_else(|| panic!("the scene has no `{from}`"));
        let bad = good.replacen(from, to, 1);
        let start = if at.is_empty() { start } else { bad.find(at).unwrap() };
        let line = bad[..start].matches('\n').count() + 1;
        fs::write(folder.path().join("bad.toml"), bad).unwrap();
        let done = run(folder.path(), &["run", "bad.toml"]);
        let said = text(&done.stderr);
        assert_eq!(done.status.code(), Some(2), "{to}: {said}");
        let place = format!("bad.toml, line {line}: key `");
        assert!(said.contains(&place), "{to}: `{place}` is not in: {said}");
        for word in *wanted {
            assert!(said.contains(word), "{to}: `{word}` is not in: {said}");
        }
        assert_eq!(fs::read_to_string(&kept).unwrap(), "earlier results", "{to}");
    }
}

#[test]
fn options_of_the_command_line_change_the_scene_and_are_named() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("small.toml"), small()).unwrap();
    for (option, value, wanted) in [
        ("--set", "liquid.viscosity=-1", "command line, --set: key `liquid.viscosity`"),
        ("--set", "liquid.capilary=x", "command line, --set: key `liquid.capilary`"),
        ("--set", "classes[9].count=3", "below 3"),
        ("--set", "liquid", "`liquid` has no value; allowed: KEY=VALUE, such as"),
        (
            "--set",
            "packing={from=\"random\"",
            "key `packing`: `{from=\"random\"`, column 1: the inline table",
        ),
        ("--set", "packing=3", "a table with the key `from`"),
        ("--set", "time_step=1e-3", "`run --allow-unstable` goes above"),
        ("--set", "screen=5", "key `screen`: invalid type: integer `5`; allowed: a table"),
        ("--set", "classes={}", "allowed: `[[classes]]`, for each entry"),
        ("--time", "-1", "command line, --time: key `time`"),
        ("--time", "1e300", "command line, --time: key `time`"),
        ("--dt", "-1e-6", "command line, --dt: key `time_step`"),
        ("--vtk", "1e-99", "command line, --vtk: key `vtk`"),
        ("--threads", "-1", "allowed: 1 to 1024"),
        ("--seed", "-1", "allowed: a whole number from 0"),
        ("--seed", "9223372036854775808", "a whole number from 0 to 9223372036854775807"),
        ("--set", "seed=9223372036854775808", "key `seed`"),
        ("--dt", "1e-3", "command line, --dt: key `time_step`"),
    ] {
        let done = run(folder.path(), &["run", "small.toml", option, value]);
        let said = text(&done.stderr);
        assert_eq!(done.status.code(), Some(2), "{value}: {said}");
        assert!(said.contains(wanted), "{value}: `{wanted}` is not in: {said}");
    }
    let dry = ["run", "small.toml", "--time", "0.001", "--set", "classes[0].count=9", "--out", "o"];
    assert!(run(folder.path(), &dry).status.success());
    assert_eq!(summary(&folder.path().join("o"))["derived"]["particles"]["5 mm"], 9);
    // What was set is part of the run: it is there again when the run goes on.
    let again = run(folder.path(), &["resume", "o"]);
    assert!(again.status.success(), "{}", text(&again.stderr));
}

const FILE: &str = "[packing]\nfrom = \"file\"\npath = \"bed.csv\"\n\n";

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

#[test]
fn missing_and_broken_files() {
    let folder = tempfile::tempdir().unwrap();
    let unknown = run(folder.path(), &["run", "nothing"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("e18-18"));
    let good = small().replace("\"packing.floor_height_mm\", ", "");
    let start = good.find("[packing]").unwrap();
    let end = good.find("[screen]").unwrap();
    // One class, whose spheres the file of the packing counts.
    let second = good.match_indices("[[classes]]").nth(1).unwrap().0;
    let classes = good[..second].replace("count = 16\n", "");
    let with_file = |set: &str| format!("{classes}{set}{FILE}{}", &good[end..]);
    let with =
        |packing: &str, rest: &str| format!("{}{packing}{}{rest}", &good[..start], &good[end..]);
    fs::write(folder.path().join("s.toml"), with_file("")).unwrap();
    let missing = run(folder.path(), &["check", "s.toml"]);
    assert_eq!(missing.status.code(), Some(2));
    assert!(text(&missing.stderr).contains("bed.csv"));
    for (bed, wanted) in [
        ("id,x,y,z,radius\n", "the header is"),
        ("id,x,y,z,radius,density\n1,0,0,a,0.0025,1358\n", "line 2"),
        ("id,x,y,z,radius,density\n1,0,0,0.05,0.003,1358\n", "no class has radius"),
        ("id,x,y,z,radius,density\n1,0,0,nan,0.0025,1358\n", "z = `nan`"),
        ("id,x,y,z,radius,density\n1,0,0,1e308,0.0025,1358\n", "outside the frame"),
        ("id,x,y,z,radius,density\n", "no particle"),
        (
            "id,x,y,z,radius,density\n1,0,0,0.05,0.0025,1358\n1,0,0,0.06,0.0025,1358\n",
            "bed.csv, line 3: id 1 is there twice",
        ),
    ] {
        fs::write(folder.path().join("bed.csv"), bed).unwrap();
        let said = text(&run(folder.path(), &["check", "s.toml"]).stderr);
        assert!(said.contains(wanted) && said.contains("bed.csv"), "{said}");
    }
    let overlapping = "id,x,y,z,radius,density\n1,0,0,0.05,0.0025,1358\n2,0,0,0.054,0.0025,1358\n";
    fs::write(folder.path().join("bed.csv"), overlapping).unwrap();
    let said = text(&run(folder.path(), &["run", "s.toml"]).stderr);
    assert!(said.contains("overlaps particle ") && said.contains("s.toml, line "), "{said}");
    assert!(!folder.path().join("out/s").exists(), "a run that could not begin leaves nothing");
    fs::write(folder.path().join("s.toml"), with_file("count = 3\n")).unwrap();
    let said = text(&run(folder.path(), &["check", "s.toml"]).stderr);
    assert!(said.contains("classes[0].count") && said.contains("the 2 that"), "{said}");
    fs::write(folder.path().join("broken.stl"), "solid x\nfacet nonsense").unwrap();
    let part = "\n[[parts]]\nname = \"frame\"\nstl = \"broken.stl\"\nmaterial = \"steel\"\n";
    let random = "[packing]\nfrom = \"random\"\nsolid_fraction = 0.2\nclearance_mm = 2\n\n";
    fs::write(folder.path().join("s.toml"), with(random, part)).unwrap();
    let said = text(&run(folder.path(), &["check", "s.toml"]).stderr);
    assert!(said.contains("broken.stl"), "{said}");
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
    let refused = run(folder.path(), &[&short[..], &["--set", "liquid.drag=explicit"]].concat());
    assert!(text(&refused.stderr).contains("viscous drag"), "{}", text(&refused.stderr));
    let unknown = run(folder.path(), &["check", "small.toml", "--set", "liquid.drag=partly"]);
    let said = text(&unknown.stderr);
    assert!(said.contains("partly") && said.contains("implicit"), "{said}");
}
