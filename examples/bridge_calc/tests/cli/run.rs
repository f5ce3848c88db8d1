//! Runs the program as its users do.

use std::io::Write;
use std::process::{Command, Output, Stdio};

pub(crate) const HEADER: &str = "r1,r2,theta1_deg,theta2_deg,gamma,volume,gap";

/// The program's answer to a text on stdin.
pub(crate) fn run(args: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_bridge_calc"))
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    // A run that refuses its header stops reading.
    let _ = stdin.write_all(input.as_bytes());
    drop(stdin);
    child.wait_with_output().unwrap()
}

/// The cells of a run that succeeds, without the header.
pub(crate) fn table(args: &[&str], input: &str) -> Vec<Vec<String>> {
    let output = run(args, input);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    cells(&String::from_utf8(output.stdout).unwrap())
}

/// The cells of a CSV text without quotes, without the header.
pub(crate) fn cells(text: &str) -> Vec<Vec<String>> {
    text.lines().skip(1).map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// Result and status of one bridge.
pub(crate) fn one(args: &[&str], row: &str) -> (String, String) {
    let rows = table(args, &format!("{HEADER}\n{row}\n"));
    assert_eq!(rows.len(), 1);
    (rows[0][7].clone(), rows[0][8].clone())
}

/// The result of one bridge that has one.
pub(crate) fn value(args: &[&str], row: &str) -> f64 {
    let (value, status) = one(args, row);
    value.parse().unwrap_or_else(|_| panic!("{args:?} {row}: {status}"))
}
