//! `contact` and `laws`.

use crate::run::{cells, run, table};

const HEADER: &str = "e_star,r_star,yield_pressure,displacement_max,steps";

/// Force on a branch at a step.
fn force(rows: &[Vec<String>], branch: &str, displacement: f64) -> f64 {
    let at = |row: &&Vec<String>| {
        let place: f64 = row[6].parse().unwrap();
        row[5] == branch && (place - displacement).abs() < 1e-12
    };
    let row = rows.iter().find(at).unwrap();
    assert_eq!(row[8], "ok");
    row[7].parse().unwrap()
}

/// Krull, Strohner & Antonyuk (2025), (7), (9) to (12), (15) to (18), in mpmath with 25 digits.
#[test]
fn elastic_plastic_loading_and_unloading() {
    let input = format!("{HEADER}\n2.6e9,1e-4,27e6,1e-6,100\n");
    let rows = table(&["contact", "--model", "elastic-plastic"], &input);
    assert_eq!(rows.len(), 202);
    for (branch, displacement, expected) in [
        ("loading", 1e-8, 3.4666666666666667e-5),
        ("loading", 2e-8, 9.805214032453459e-5),
        ("loading", 0.5e-6, 0.0060235341487535781),
        ("loading", 1e-6, 0.012996051625153131),
        ("unloading", 1e-6, 0.012996051625153131),
        ("unloading", 0.9e-6, 0.0073598422601064772),
        ("unloading", 0.8e-6, 0.0029129932306884116),
        ("unloading", 0.3e-6, 0.0),
    ] {
        let got = force(&rows, branch, displacement);
        assert!((got - expected).abs() <= 1e-12 * expected, "{branch} {displacement}: {got}");
    }
}

/// By hand: 4/3 · 1e9 · √(1e-4 · 1e-18) N at 1 µm, on both branches; no yield pressure is needed.
#[test]
fn hertz_is_elastic() {
    let rows =
        table(&["contact", "--model", "hertz-mindlin"], &format!("{HEADER}\n1e9,1e-4,,2e-6,2\n"));
    for branch in ["loading", "unloading"] {
        assert!((force(&rows, branch, 1e-6) / 0.013333333333333334 - 1.0).abs() < 1e-14);
    }
}

#[test]
fn bad_contacts_get_a_status() {
    let rows = [
        "1e9,1e-4,,1e-6,2",
        "1e9,0,1e6,1e-6,2",
        "1e9,1e-4,1e6,1e-6,2.5",
        "1e9,1e-4,1e6,0,2",
        "1e9,1e-4,1e6,1e-6,1e12",
    ];
    let input = format!("{HEADER}\n{}\n1e9,1e-4,1e6,1e-6,1\n", rows.join("\n"));
    let answers = table(&["contact", "--model", "elastic-plastic"], &input);
    assert_eq!(answers.len(), rows.len() + 4);
    let status: Vec<&str> = answers.iter().take(rows.len()).map(|row| row[8].as_str()).collect();
    assert_eq!(status, ["not-a-number", "invalid", "invalid", "invalid", "invalid"]);
}

#[test]
fn laws_lists_every_name_with_range_and_source() {
    let output = run(&["laws"], "");
    let text = String::from_utf8(output.stdout).unwrap();
    let rows = cells(&text);
    let names = |command: &str| {
        let of = rows.iter().filter(|row| row[0] == command);
        of.map(|row| row[1].clone()).collect::<Vec<_>>()
    };
    for name in [
        "rabinovich",
        "lambert",
        "willett-full",
        "willett-reduced",
        "weigert",
        "soulie",
        "bagheri",
        "rabinovich-plane",
        "tabulated",
        "young-laplace",
    ] {
        assert!(names("force").iter().any(|other| other == name), "{name}");
    }
    for name in ["lian", "willett", "willett-unequal", "mikami", "tabulated", "young-laplace"] {
        assert!(names("rupture").iter().any(|other| other == name), "{name}");
    }
    assert_eq!(names("transfer"), ["parabola", "exact", "tabulated"]);
    let full = text.lines().find(|line| line.contains("willett-full")).unwrap();
    assert!(full.contains("0.0001,0.3,0,50,") && full.contains("Langmuir 16, 9396"), "{full}");
}
