//! Every formula against numbers that were computed apart from this repository.
//!
//! `tables/formulas.csv`: the published formulas with their errata applied, in mpmath with 40
//! digits, written to 17. The bridges have unequal radii and angles, planes, and gap 0.

use crate::run::{HEADER, one, table, value};

const TABLE: &str = include_str!("tables/formulas.csv");

/// Column names and rows of the reference.
fn reference() -> (Vec<&'static str>, Vec<Vec<&'static str>>) {
    let mut lines = TABLE.lines().map(|line| line.split(',').collect::<Vec<_>>());
    (lines.next().unwrap(), lines.collect())
}

fn input() -> String {
    let (_, rows) = reference();
    let bridges = rows.iter().map(|row| row[..7].join(","));
    std::iter::once(HEADER.to_owned()).chain(bridges).collect::<Vec<_>>().join("\n")
}

/// Compares a run with a column of the reference; an empty cell must have no value.
fn check(args: &[&str], name: &str) {
    let (names, rows) = reference();
    let column = names.iter().position(|other| *other == name).unwrap();
    let answers = table(args, &input());
    assert_eq!(answers.len(), rows.len());
    for (answer, row) in answers.iter().zip(rows) {
        assert_eq!(answer[..7], row[..7], "the row is repeated as it was");
        if row[column].is_empty() {
            assert_eq!(answer[7..], ["", "no-value"], "{name} {row:?}");
            continue;
        }
        let (got, want): (f64, f64) = (answer[7].parse().unwrap(), row[column].parse().unwrap());
        assert!((got / want - 1.0).abs() < 2e-13, "{name} {row:?}: {got} {want}");
        assert!(["ok", "extrapolated"].contains(&answer[8].as_str()));
    }
}

#[test]
fn every_force_formula() {
    for name in [
        "rabinovich",
        "lambert",
        "willett-full",
        "willett-reduced",
        "weigert",
        "soulie",
        "bagheri",
        "rabinovich-plane",
        "rabinovich-plane-small-gap",
    ] {
        check(&["force", "--law", name], name);
    }
}

#[test]
fn every_rupture_formula() {
    for name in ["lian", "willett", "willett-unequal", "mikami"] {
        check(&["rupture", "--law", name], name);
    }
}

/// The parabola's seven equations, errata applied, solved by mpmath's `findroot` for the two
/// half-filling angles.
#[test]
fn the_parabola() {
    for (row, share) in [
        ("2.5e-3,5e-3,40,40,0.07,2e-9,0", 0.37837706481571066),
        ("5e-3,2.5e-3,40,40,0.07,2e-9,0", 0.62162293518428934),
        ("2.5e-3,inf,15,45,0.07,1e-9,0", 0.75681623140536746),
        ("1e-3,1.3e-3,35,42,0.07,2e-11,0", 0.54851081684330428),
    ] {
        for args in [&["transfer"][..], &["transfer", "--method", "parabola"]] {
            assert!((value(args, row) - share).abs() < 1e-11, "{row}");
        }
    }
    // No root with an open neck: wet plane, small volume.
    let none = one(&["transfer"], "2.5e-3,inf,15,5,0.07,1e-11,0");
    assert_eq!(none, (String::new(), "no-solution".to_owned()));
}

/// By hand: 2 π R σ with R = 1 mm, σ = 0.07 N/m; 4 π r σ on a plane.
#[test]
fn contact_by_hand() {
    let sphere = value(&["force", "--law", "lambert"], "1e-3,1e-3,0,0,0.07,1e-12,0");
    let plane = value(&["force", "--law", "rabinovich-plane"], "1e-3,,0,0,0.07,1e-12,0");
    assert!((sphere / 4.398229715025711e-4 - 1.0).abs() < 1e-14);
    assert!((plane / 8.796459430051422e-4 - 1.0).abs() < 1e-14);
}

/// Bodies that overlap are in contact.
#[test]
fn overlap_reads_as_contact() {
    for law in ["lambert", "willett-full", "weigert", "tabulated", "young-laplace"] {
        let at =
            |gap: &str| one(&["force", "--law", law], &format!("1e-3,2e-3,20,20,0.07,1e-11,{gap}"));
        assert_eq!(at("-1e-5"), at("0"), "{law}");
    }
}
