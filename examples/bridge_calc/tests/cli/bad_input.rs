//! Bad rows get a status and do not stop the run; malformed files stop it with their line.

use crate::run::{HEADER, one, run, table};

#[test]
fn a_bad_row_does_not_stop_the_others() {
    let good = "1e-3,2e-3,10,20,0.07,1e-11,1e-5";
    let bad = [
        ("1e-3,2e-3,10,2o,0.07,1e-12,1e-5", "not-a-number"),
        ("1e-3,2e-3,10,20,,1e-12,1e-5", "not-a-number"),
        (",2e-3,10,20,0.07,1e-12,1e-5", "not-a-number"),
        ("1e-3,2e-3,10,20,0.07,-1e-12,1e-5", "invalid"),
        ("1e-3,2e-3,10,20,0.07,0,1e-5", "invalid"),
        ("inf,2e-3,10,20,0.07,1e-12,1e-5", "invalid"),
        ("1e-3,-inf,10,20,0.07,1e-12,1e-5", "invalid"),
        ("1e-3,nan,10,20,0.07,1e-12,1e-5", "invalid"),
        ("1e-3,2e-3,180,20,0.07,1e-12,1e-5", "invalid"),
        ("1e-3,2e-3,10,-1,0.07,1e-12,1e-5", "invalid"),
        ("1e-3,2e-3,10,20,0.07,1e-12,inf", "invalid"),
        ("1e-3,2e-3,10,20,0.07,1e-12,nan", "invalid"),
    ];
    let rows = bad.map(|(row, _)| format!("{row}\n{good}\n")).concat();
    for law in ["willett-reduced", "weigert", "tabulated", "young-laplace"] {
        let answers = table(&["force", "--law", law], &format!("{HEADER}\n{rows}"));
        assert_eq!(answers.len(), 2 * bad.len());
        for (pair, (row, status)) in answers.chunks(2).zip(bad) {
            assert_eq!(pair[0][7..], ["", status], "{row}");
            assert!(pair[1][7].parse::<f64>().unwrap() > 0.0 && pair[1][8] == "ok", "{law}");
        }
    }
}

#[test]
fn strict_refuses_what_is_extrapolated() {
    // Beyond 50° for the closed form.
    let row = "1e-3,1e-3,55,55,0.07,1e-11,1e-5";
    let (force, status) = one(&["force", "--law", "lambert"], row);
    assert!(status == "extrapolated" && force.parse::<f64>().unwrap() > 0.0);
    for args in
        [["force", "--law", "lambert", "--strict"], ["rupture", "--law", "lian", "--strict"]]
    {
        assert_eq!(one(&args, row), (String::new(), "out-of-range".to_owned()));
    }
    let inside = one(&["force", "--law", "lambert", "--strict"], "1e-3,1e-3,50,50,0.07,1e-11,1e-5");
    assert_eq!(inside.1, "ok");
}

/// Seventeen significant digits read back to the same bits.
#[test]
fn numbers_have_seventeen_digits() {
    let (force, _) = one(&["force", "--law", "lambert"], "1e-3,1e-3,0,0,0.07,1e-12,0");
    let (mantissa, exponent) = force.split_once('e').unwrap();
    assert_eq!(mantissa.chars().filter(char::is_ascii_digit).count(), 17);
    assert_eq!(exponent, "-4");
}

#[test]
fn the_gap_is_ignored_where_it_means_nothing() {
    for args in [&["rupture", "--law", "lian"][..], &["transfer", "--method", "exact"]] {
        let at = |gap: &str| one(args, &format!("1e-3,1e-3,0,0,0.07,1e-12,{gap}"));
        assert_eq!(at(""), at("3"));
        assert_eq!(at("").1, "ok");
    }
}

#[test]
fn spaces_and_windows_line_ends_are_fine() {
    let text = format!("{}\r\n 1e-3 , INF ,0,0,0.07,1e-12, 0\r\n\r\n", HEADER.replace(',', ", "));
    let rows = table(&["force", "--law", "rabinovich-plane"], &text);
    assert_eq!(rows[0][8], "ok");
}

#[test]
fn a_malformed_file_ends_with_its_line() {
    let good = "1e-3,2e-3,10,20,0.07,1e-11,1e-5";
    for (text, line) in [
        (String::new(), "line 1"),
        ("r1,r2,theta1,theta2,gamma,volume,gap\n".to_owned(), "line 1"),
        (format!("{good}\n"), "line 1"),
        (format!("{HEADER}\n{good}\n1,2,3\n{good}\n"), "line 3"),
        (format!("{HEADER}\n{good}\n{good}\n{good},5\n"), "line 4"),
    ] {
        let output = run(&["force", "--law", "lambert"], &text);
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{text}");
        assert!(said.contains(line), "{text}: {said}");
        // What came before has been answered.
        let answered = String::from_utf8(output.stdout).unwrap();
        assert_eq!(
            answered.lines().count(),
            answered.matches("ok").count() + usize::from(!answered.is_empty())
        );
    }
}

#[test]
fn an_unknown_name_lists_the_known_ones() {
    for (args, known) in [
        (&["force", "--law", "Lambert"][..], "willett-reduced, weigert, soulie, bagheri"),
        (&["rupture", "--law", "none"], "lian, willett, willett-unequal, mikami"),
        (&["transfer", "--method", "none"], "parabola, exact"),
        (&["contact", "--model", "linear"], "hertz-mindlin, elastic-plastic"),
    ] {
        let output = run(args, "");
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert!(said.contains(known), "{said}");
    }
}
