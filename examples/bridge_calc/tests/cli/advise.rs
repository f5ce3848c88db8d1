//! `advise`: the answer keeps its promise on bridges that were not measured.

use crate::run::{HEADER, run, table};

const SPHERES: [&str; 10] = [
    "advise",
    "--v-star",
    "1e-3,1e-2",
    "--theta-deg",
    "0,20",
    "--ratio",
    "1,2",
    "--gap",
    "0,0.75",
    "--tolerance",
];

fn ask(question: &[&str], tolerance: &str) -> String {
    let args: Vec<&str> = question.iter().copied().chain([tolerance]).collect();
    let output = run(&args, "");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The named law's force against the exact one, both by this program, at places between those that
/// were measured.
#[test]
fn the_named_law_is_as_good_as_said() {
    let mut rows = HEADER.to_owned();
    // Radii 1 and 1.6 mm: R = 1.230769 mm, so V* = 2.3e-3 and 7e-3; gaps inside 0.75 of rupture.
    for (volume, gap) in [("4.288e-12", "0.9e-4"), ("1.305e-11", "1.7e-4"), ("1.305e-11", "2e-5")] {
        for angles in ["3,17", "17,3", "12,12"] {
            rows += &format!("\n1e-3,1.6e-3,{angles},0.0728,{volume},{gap}");
        }
    }
    let forces = |law: &str| {
        let answers = table(&["force", "--law", law], &rows);
        answers.into_iter().map(|row| row[7].parse::<f64>().unwrap()).collect::<Vec<f64>>()
    };
    let exact = forces("young-laplace");
    let mut named = Vec::new();
    for tolerance in ["1e-8", "1e-3", "0.1", "0.5"] {
        let said = ask(&SPHERES, tolerance);
        let law = said.split(':').next().unwrap().to_owned();
        let allowed: f64 = tolerance.parse().unwrap();
        for (force, exact) in forces(&law).iter().zip(&exact) {
            assert!((force / exact - 1.0).abs() <= allowed, "{said}");
        }
        named.push(law);
    }
    assert_eq!(named[..2], ["young-laplace", "tabulated"]);
    assert!(!named[2..].contains(&"young-laplace".to_owned()), "{named:?}");
}

#[test]
fn none_is_said() {
    let said = ask(&SPHERES, "1e-12");
    assert!(said.starts_with("none: ") && said.contains("young-laplace"), "{said}");
}

#[test]
fn planes_and_single_values() {
    let said = ask(
        &[
            "advise",
            "--v-star",
            "0.01",
            "--theta-deg",
            "40,45",
            "--ratio",
            "plane",
            "--gap",
            "0,0.98",
            "--tolerance",
        ],
        "2e-3",
    );
    assert!(said.starts_with("tabulated: "), "{said}");
}

#[test]
fn questions_beyond_the_measurements_are_refused() {
    for (place, value) in [(2, "1e-12,1"), (2, "1e-2,1e-3"), (4, "0,80"), (6, "0.5,1"), (8, "0,2")]
    {
        let mut args = SPHERES.to_vec();
        args[place] = value;
        args.push("0.1");
        let output = run(&args, "");
        assert_eq!(output.status.code(), Some(2), "{value}");
        assert!(!output.stderr.is_empty());
    }
}
