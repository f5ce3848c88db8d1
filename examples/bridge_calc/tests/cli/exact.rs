//! The exact bridge and its table against solvers that are not this one.

use crate::run::{one, value};

const EXACT: &[&str] = &["force", "--law", "young-laplace"];
const TABLE: &[&str] = &["force", "--law", "tabulated"];

/// Two independent solvers, ten digits: `data/young_laplace_reference.csv`.
const FORCES: [(&str, f64); 6] = [
    ("0.002381,0.002381,0,0,0.0206,1.36e-11,0.000120544793052", 3.906676002e-5),
    ("0.002381,0.002381,0,0,0.0206,1.36e-11,0.000229035106799", 1.266063478e-5),
    ("0.002381,0.001191,0,0,0.0206,2.53e-11,0.000142715364925", 4.404941623e-5),
    ("1.9e-05,3.5e-05,10,10,0.027,2e-19,3.11133482281e-07", 1.313258674e-7),
    ("0.002381,inf,0,0,0.0206,1.624e-10,0.000260290668566", 9.45157702e-5),
    ("0.002381,,0,0,0.0206,1.624e-10,0.000494552270275", 3.215192459e-5),
];

#[test]
fn forces() {
    for (row, force) in FORCES {
        let (exact, table) = (value(EXACT, row), value(TABLE, row));
        assert!((exact / force - 1.0).abs() < 1e-9, "{row}: {exact}");
        assert!((table / force - 1.0).abs() < 1e-3, "{row}: {table}");
    }
}

#[test]
fn the_order_of_the_bodies_is_free() {
    let (a, b) = ("1.7e-3,2.9e-3,12,33,0.07,4e-11,1e-4", "2.9e-3,1.7e-3,33,12,0.07,4e-11,1e-4");
    for law in [EXACT, TABLE] {
        assert!((value(law, a) / value(law, b) - 1.0).abs() < 1e-9);
    }
    for method in ["exact", "tabulated"] {
        let share = |row| value(&["transfer", "--method", method], row);
        assert!((share(a) + share(b) - 1.0).abs() < 1e-9);
    }
}

/// No bridge beyond rupture, one just before it; the table's force fades out and says so.
#[test]
fn rupture_ends_the_force() {
    let row = |gap: f64| format!("1e-3,1.5e-3,20,40,0.07,1e-11,{gap:e}");
    let end = value(&["rupture", "--law", "young-laplace"], &row(0.0));
    assert_eq!(one(EXACT, &row(0.9999 * end)).1, "ok");
    assert_eq!(one(EXACT, &row(1.0001 * end)), (String::new(), "ruptured".to_owned()));
    assert_eq!(one(TABLE, &row(0.99 * end)).1, "ok");
    let (force, status) = one(TABLE, &row(1.01 * end));
    assert!(status == "extrapolated" && force.parse::<f64>().unwrap() > 0.0);
    let strict = one(&["force", "--law", "tabulated", "--strict"], &row(1.01 * end));
    assert_eq!(strict, (String::new(), "ruptured".to_owned()));
    let table = value(&["rupture", "--law", "tabulated"], &row(0.0));
    assert!((table / end - 1.0).abs() < 1e-3);
}

/// A solver of other make (shooting in arc length) gave two digits of these shares: glass on steel
/// at V/r³ = 0.01, 0.1, 0.3, POM on steel at 1e-3 and 3e-3, and spheres 1 % apart at 40°.
#[test]
fn shares() {
    for (row, share) in [
        ("1,inf,15,45,0.07,0.01,0", 0.80),
        ("1,inf,15,45,0.07,0.1,0", 0.68),
        ("1,inf,15,45,0.07,0.3,0", 0.28),
        ("1,inf,40,45,0.07,1e-3,0", 0.61),
        ("1,inf,40,45,0.07,3e-3,0", 0.34),
        ("1.01,1,40,40,0.07,1.0150374e-3,0", 0.544),
    ] {
        let exact = value(&["transfer", "--method", "exact"], row);
        let table = value(&["transfer", "--method", "tabulated"], row);
        assert!((exact - share).abs() < 6e-3, "{row}: {exact}");
        assert!((table - exact).abs() < 5e-3, "{row}: {table} {exact}");
    }
    assert_eq!(value(&["transfer", "--method", "exact"], "1,1,30,30,0.07,0.01,0"), 0.5);
}

#[test]
fn no_bridge_is_a_status() {
    let fat = "1e-3,1e-3,10,10,0.07,1e-3,0";
    for args in
        [EXACT, TABLE, &["rupture", "--law", "young-laplace"], &["transfer", "--method", "exact"]]
    {
        assert_eq!(one(args, fat), (String::new(), "no-bridge".to_owned()), "{args:?}");
    }
}
