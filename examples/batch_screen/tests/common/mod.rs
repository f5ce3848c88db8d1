//! What the tests of the program share.

use std::path::Path;
use std::process::{Child, Command, Output};

/// Files whose bytes must not depend on whether a run was stopped.
#[allow(dead_code, reason = "not every test looks at them")]
pub(crate) const TABLES: [&str; 10] = [
    "retained.csv",
    "partition.csv",
    "pegging.csv",
    "energy.csv",
    "passages.csv",
    "replay.csv",
    "liquid.csv",
    "liquid_shared.csv",
    "liquid_final.csv",
    "bridges.csv",
];

pub(crate) fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_batch_screen"))
}

pub(crate) fn run(folder: &Path, args: &[&str]) -> Output {
    program().current_dir(folder).args(args).output().unwrap()
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The demo, made small: 24 spheres on a sieve of 40 mm.
pub(crate) fn small() -> String {
    let demo = text(&program().args(["show", "demo"]).output().unwrap().stdout);
    demo.replace("count = 267", "count = 16")
        .replace("count = 99", "count = 6")
        .replace("count = 34", "count = 2")
        .replace("diameter_mm = 80 ", "diameter_mm = 40 ")
        .replace("time = 2.0", "time = 0.08")
        .replace("output_interval = 0.02", "output_interval = 0.01")
        .replace("floor_height_mm = 15", "floor_height_mm = 12")
}

/// The summary of a run.
#[allow(dead_code, reason = "not every test looks at it")]
pub(crate) fn summary(folder: &Path) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(folder.join("summary.json")).unwrap()).unwrap()
}

/// Asks a program to stop, as a batch system does.
#[allow(dead_code, reason = "not every test stops something")]
pub(crate) fn terminate(child: &Child) {
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-TERM", &id]).status().unwrap().success());
}
