//! What the program says of its input before it runs, beside the errors of single values.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

mod common;

use std::fs;

use common::{run, small, text};

const LOOSE: &str = "packing={from=\"random\", solid_fraction=0.2, clearance_mm=2}";
const REFUSE: &str = "liquid.outside_range=refuse";

#[test]
fn a_check_tells_steps_and_what_is_hardly_meant() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.toml"), small()).unwrap();
    for (options, wanted) in [
        (&["--time", "1", "--dt", "1e-6"][..], "1.000e-6 s, 1000000 steps to t = 1 s"),
        (&["--set", "screen.aperture_mm=4"], "no class can pass: the smallest has 5 mm"),
        (&["--set", "screen.aperture_mm=25"], "all classes fall through at once"),
        (&["--set", "output_interval=1e-6"], "output_interval = 1e-6 s is below the time step"),
        (&["--set", "contact.stiffness=100"], "contact.stiffness = 100 N/m is low"),
        (&["--set", "gravity=[0, 0, 0]", "--set", LOOSE], "nothing falls onto the screen"),
        (&["--set", "liquid.moisture_percent=0"], "liquid.moisture_percent is 0"),
        (&["--set", "time=1e-6"], "time = 1e-6 s is below half a step of 5e-6 s: nothing moves"),
        (&["--set", "motion.amplitude_mm=[0, 0, 0]"], "the screen stands still"),
        // 1 mm at 3000 Hz, where 3000 a minute was meant: 1e-3 (2 pi 3000)^2 m/s2.
        (&["--set", "motion.frequency=3000"], "shakes at up to 3.6e5 m/s2, 36219 times the weight"),
    ] {
        let done = run(folder.path(), &[&["check", "s.toml"], options].concat());
        let said = text(&done.stdout);
        assert!(done.status.success(), "{}", text(&done.stderr));
        assert!(said.contains(wanted), "`{wanted}` is not in: {said}");
        assert_eq!(said.matches("  note  ").count(), usize::from(options[0] == "--set"), "{said}");
    }
    let above = run(folder.path(), &["check", "s.toml", "--dt", "1e-3"]);
    assert_eq!(above.status.code(), Some(2));
    assert!(text(&above.stderr).contains("command line, --dt"), "{}", text(&above.stderr));
}

#[test]
fn files_that_are_no_text_say_so() {
    let folder = tempfile::tempdir().unwrap();
    let utf16: Vec<u8> = small().encode_utf16().flat_map(u16::to_le_bytes).collect();
    for (bytes, line) in [
        (b"title = \"a\"\ntime = 1 # \xe4\n".to_vec(), 2),
        (utf16.clone(), 1),
        ([&[0xff, 0xfe], &utf16[..]].concat(), 1),
    ] {
        fs::write(folder.path().join("s.toml"), bytes).unwrap();
        let done = run(folder.path(), &["check", "s.toml"]);
        let wanted = format!("s.toml, line {line}: is no UTF-8 text; allowed: TOML saved as UTF-8");
        assert!(text(&done.stderr).contains(&wanted), "{}", text(&done.stderr));
        assert_eq!(done.status.code(), Some(2));
    }
    // What cannot be read at all is no mistake in a scene.
    fs::create_dir(folder.path().join("d.toml")).unwrap();
    assert_eq!(run(folder.path(), &["check", "d.toml"]).status.code(), Some(1));
}

#[test]
fn a_part_from_a_file_is_told_and_named_where_it_overlaps_the_bed() {
    let folder = tempfile::tempdir().unwrap();
    let part = "\n[[parts]]\nname = \"lid\"\nstl = \"lid.stl\"\nmaterial = \"steel\"\n";
    let scene = format!("{}{part}", small());
    let line = scene[..scene.find("[[parts]]").unwrap()].matches('\n').count() + 1;
    fs::write(folder.path().join("s.toml"), &scene).unwrap();
    let lid = "solid lid\nfacet normal 0 0 1\nouter loop\nvertex -20 -20 10\nvertex 20 -20 10\n\
               vertex 0 20 10\nendloop\nendfacet\nendsolid lid\n";
    fs::write(folder.path().join("lid.stl"), lid).unwrap();
    let told = "part         lid: 1 triangle from lid.stl, 40.00 x 40.00 x 0.00 mm, x -20.00 to \
                20.00, y -20.00 to 20.00, z 10.00 to 10.00 mm";
    let check = run(folder.path(), &["check", "s.toml"]);
    assert!(text(&check.stdout).contains(told), "{}", text(&check.stdout));
    let place = format!("s.toml, line {line}: key `parts[0]`");
    for command in ["run", "check"] {
        let done = run(folder.path(), &[command, "s.toml", "--set", LOOSE, "--time", "0.001"]);
        assert!(text(&done.stdout).contains(told), "{}", text(&done.stdout));
        let said = text(&done.stderr);
        assert!(said.contains(&place), "{said}");
        assert!(said.contains("overlaps part `lid` by ") && said.contains("allowed: up to"));
        assert_eq!(done.status.code(), Some(2));
    }
    // Two of one name would be one.
    fs::write(folder.path().join("s.toml"), format!("{scene}{part}")).unwrap();
    let said = text(&run(folder.path(), &["check", "s.toml"]).stderr);
    assert!(said.contains("key `parts[1].name`: lid is not allowed"), "{said}");
}

#[test]
fn a_part_in_the_bed_is_found_before_the_bed_settles() {
    let folder = tempfile::tempdir().unwrap();
    let part = "\n[[parts]]\nname = \"fin\"\nstl = \"fin.stl\"\nmaterial = \"steel\"\n";
    // 24 spheres of 3.2 cm3 on 12.6 cm2: about two layers above the floor at 12 mm.
    fs::write(folder.path().join("s.toml"), format!("{}{part}", small())).unwrap();
    let fin = |low: f64, x: f64| {
        let high = low + 10.0;
        let stl = format!(
            "solid f\nfacet normal 1 0 0\nouter loop\nvertex {x} -5 {low}\nvertex {x} 5 {low}\n\
             vertex {x} 0 {high}\nendloop\nendfacet\nendsolid f\n"
        );
        fs::write(folder.path().join("fin.stl"), stl).unwrap();
    };
    fin(13.0, 2.0);
    for command in [&["check", "s.toml"][..], &["run", "s.toml"], &["needs", "s.toml"]] {
        let done = run(folder.path(), command);
        let said = text(&done.stderr);
        assert_eq!(done.status.code(), Some(2), "{said}");
        for words in ["key `parts[0]`: part `fin` reaches into the bed", "from 12.00 mm", "allowed"]
        {
            assert!(said.contains(words), "`{words}` is not in: {said}");
        }
        assert!(!said.contains("settling") && !folder.path().join("out").exists(), "{said}");
    }
    // Beside the frame it is none of the bed's business, and above the settled bed neither, though
    // the spheres are placed there before.
    for (low, x, told) in [(13.0, 25.0, false), (24.0, 2.0, true)] {
        fin(low, x);
        let done = run(folder.path(), &["check", "s.toml"]);
        assert!(done.status.success(), "{}", text(&done.stderr));
        let said = text(&done.stdout);
        assert_eq!(
            said.contains("part `fin` reaches into the space of the spheres"),
            told,
            "{said}"
        );
        let done = run(folder.path(), &["run", "s.toml", "--time", "0.001"]);
        assert!(done.status.success(), "{}", text(&done.stderr));
    }
}

#[test]
fn laws_that_refuse_are_held_against_angles_and_radii_before_the_run() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.toml"), small()).unwrap();
    for (sets, wanted) in [
        (
            &["materials.POM.contact_angle_deg=85"][..],
            "key `liquid.capillary`: `tabulated` at materials.POM.contact_angle_deg = 85 degrees is \
             not allowed; allowed: contact angles of 0 to 60 degrees",
        ),
        (&["liquid.capillary_wall=rabinovich"], "`liquid.capillary_wall`: `rabinovich` at"),
        (&["liquid.capillary=rabinovich-plane"], "allowed: a sphere and a wall"),
        (
            &[
                "liquid.capillary=soulie",
                "materials.POM.contact_angle_deg=10",
                "classes[2].diameter_mm=11",
            ],
            "`soulie` at a ratio of radii of 2.20 is not allowed",
        ),
    ] {
        let mut args = vec!["check", "s.toml", "--set", REFUSE];
        sets.iter().for_each(|set| args.extend(["--set", *set]));
        let done = run(folder.path(), &args);
        let said = text(&done.stderr);
        assert!(said.contains(wanted), "`{wanted}` is not in: {said}");
        assert_eq!(done.status.code(), Some(2));
        // Without bridges, or where they may lie outside, the same is fine.
        for free in ["liquid.moisture_percent=0", "liquid.outside_range=extrapolate"] {
            let done = run(folder.path(), &[&args[..], &["--set", free]].concat());
            assert!(done.status.success(), "{}", text(&done.stderr));
        }
    }
}

#[test]
fn a_bridge_that_a_law_refuses_is_told_with_its_bodies_and_the_law() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.toml"), small()).unwrap();
    let mut args = vec!["run", "s.toml", "--time", "0.001"];
    for set in [LOOSE, REFUSE, "liquid.capillary=lambert", "liquid.moisture_percent=60"] {
        args.extend(["--set", set]);
    }
    let done = run(folder.path(), &args);
    let said = text(&done.stderr);
    assert_eq!(done.status.code(), Some(3), "{said}");
    for word in ["between particle ", " mm) and particle ", "capillary lambert", "V/R^3"] {
        assert!(said.contains(word), "`{word}` is not in: {said}");
    }
    let message = said.lines().find(|line| line.contains("the run stopped at")).unwrap();
    assert_eq!(message.matches("t = ").count(), 1, "{message}");
}

/// A scene of one class, which has 5 % of liquid in equal films.
fn one_class() -> String {
    let scene = small();
    let [second, packing] =
        [scene.match_indices("[[classes]]").nth(1).unwrap().0, scene.find("[packing]").unwrap()];
    format!("{}{}", &scene[..second], &scene[packing..])
}

#[test]
fn laws_whose_range_the_first_bridges_miss_are_named_before_the_run() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.toml"), one_class()).unwrap();
    let check = |sets: &[&str]| {
        let set = sets.iter().flat_map(|set| ["--set", set]);
        let args: Vec<&str> = ["check", "s.toml"].into_iter().chain(set).collect();
        let done = run(folder.path(), &args);
        assert!(done.status.success(), "{}", text(&done.stderr));
        text(&done.stdout).lines().filter(|line| line.contains("V*")).collect::<String>()
    };
    // By hand: liquid on a sphere 0.05 (4/3) pi r^3 1358/1000, of which (1 - sqrt(3)/2)/2 from each
    // of two spheres goes into a bridge of R = r: V* = 3.81e-2. A wall gives none, R = 2 r: 2.38e-3
    // at the frame; at a wire, (1/6)(1/2.5) of a sphere's liquid: 2.37e-3.
    let none = check(&[]);
    assert!(none.is_empty(), "{none}");
    let few = check(&["liquid.capillary=rabinovich"]);
    for words in ["liquid.capillary = \"rabinovich\"", " 0 to 0.01;", "3.81e-2 (5 mm with 5 mm)"] {
        assert!(few.contains(words), "`{words}` is not in: {few}");
    }
    assert!(few.contains("are extrapolated and counted") && !few.contains("wall"), "{few}");
    let wall = check(&["liquid.capillary_wall=rabinovich", "liquid.moisture_percent=25"]);
    for words in ["liquid.capillary_wall = \"rabinovich\"", "dry", "1.19e-2 (5 mm with"] {
        assert!(wall.contains(words), "`{words}` is not in: {wall}");
    }
    // The rupture laws have ranges too; Mikami's is another one at walls.
    let many =
        ["liquid.moisture_percent=70", "liquid.rupture=mikami", "liquid.rupture_wall=mikami"];
    let said = check(&many);
    assert!(said.contains("liquid.rupture = \"mikami\" holds for V* = V/R^3 of 0.0001 to 0.1"));
    assert!(said.contains("liquid.rupture_wall = \"mikami\" holds for V* = V/R^3 of 1e-6 to 0.03"));
    // What is announced happens: the first bridge stops a run that refuses.
    let sets = ["liquid.capillary=lambert", "liquid.moisture_percent=20", REFUSE];
    assert!(check(&sets).contains("the run stops at the first outside (liquid.outside_range)"));
    let set = sets.iter().flat_map(|set| ["--set", set]);
    let args: Vec<&str> = ["run", "s.toml", "--time", "0.01"].into_iter().chain(set).collect();
    let done = run(folder.path(), &args);
    assert_eq!(done.status.code(), Some(3), "{}", text(&done.stderr));
    assert!(text(&done.stderr).contains("V/R^3"), "{}", text(&done.stderr));
}

#[test]
fn a_file_without_a_key_and_values_in_other_units_are_told() {
    let folder = tempfile::tempdir().unwrap();
    for empty in ["", "# a title\n\n"] {
        fs::write(folder.path().join("s.toml"), empty).unwrap();
        let done = run(folder.path(), &["run", "s.toml"]);
        let said = text(&done.stderr);
        assert_eq!(done.status.code(), Some(2), "{said}");
        assert!(said.contains("s.toml, line 1: there is no key in the file"), "{said}");
        assert!(said.contains("`batch_screen sample`"), "{said}");
    }
    fs::write(folder.path().join("s.toml"), small()).unwrap();
    // Millinewton per metre, g/cm3, mPa s, GPa, radians.
    for (set, wanted) in [
        ("liquid.surface_tension=72.75", "liquid.surface_tension = 72.75 is in N/m: what there is"),
        ("classes[1].density=2.65", "classes[1].density = 2.65 is in kg/m3: what there is has 20"),
        ("liquid.viscosity=1e6", "liquid.viscosity = 1000000 is in Pa s: what there is"),
        ("materials.POM.youngs_modulus=3.1", "materials.POM.youngs_modulus = 3.1 is in Pa"),
        ("materials.POM.contact_angle_deg=0.7", "in degrees, not in radians"),
    ] {
        let done = run(folder.path(), &["check", "s.toml", "--set", set, "--dt", "1e-9"]);
        let said = text(&done.stdout);
        assert!(done.status.success(), "{}", text(&done.stderr));
        let notes = said.lines().filter(|line| line.contains("  note  "));
        assert_eq!(notes.filter(|line| line.contains(wanted)).count(), 1, "{set}: {said}");
    }
    for scene in ["s.toml", "demo", "e18-01", "e18-18"] {
        let said = text(&run(folder.path(), &["check", scene]).stdout);
        assert!(!said.contains("what there is has"), "{said}");
    }
}

/// A built-in scene goes before a file of its name.
#[test]
fn a_sample_by_the_name_of_a_built_in_scene_says_how_it_runs() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (file, asked) in [("demo", "./demo"), ("mine.toml", "mine.toml")] {
        let said = text(&run(folder, &["sample", file]).stdout);
        assert!(said.ends_with(&format!("run it with: batch_screen run {asked}\n")), "{said}");
        let path = folder.join(file);
        let own =
            std::fs::read_to_string(&path).unwrap().replace("title = \"Demo", "title = \"Own");
        std::fs::write(&path, own).unwrap();
        let checked = run(folder, &["check", asked]);
        assert!(text(&checked.stdout).starts_with("Own"), "{}", text(&checked.stderr));
    }
}

/// Half a scene or half a job script is worse than none.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_where_the_text_is_all_there_is() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("s.toml"), "scene = \"demo\"\ntime = 0.01\n").unwrap();
    for args in [&["show", "demo"][..], &["sweep", "s.toml", "--emit", "slurm"]] {
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let mut program = common::program();
        let done = program.current_dir(folder.path()).args(args).stdout(full).output().unwrap();
        let said = text(&done.stderr);
        assert!(done.status.code() == Some(1) && said.contains("stdout"), "{args:?}: {said}");
    }
}
