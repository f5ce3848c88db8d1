//! Scenes and options that are wrong: where and what is allowed.

use std::fs;

use crate::common::{run, small, summary, text};

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
