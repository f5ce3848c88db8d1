//! What the program says of its input.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

use std::process::{Command, Stdio};

/// Runs ten steps of a bed; returns the exit code and what was said.
fn measured(bed: &str, scene: &str, options: &[&str]) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bed.csv");
    std::fs::write(&path, bed).unwrap();
    let mut program = Command::new(env!("CARGO_BIN_EXE_throughput"));
    program.args(["--warm", "1", "--steps", "10", "--scene", scene, "--particles"]).arg(&path);
    let done = program.args(options).output().unwrap();
    let said = [done.stdout, done.stderr].concat();
    (done.status.code(), String::from_utf8_lossy(&said).into_owned())
}

const BED: &str = "id,x,y,z,radius,density\n0,0.01,0,0.02,2.5e-3,1358\n";

#[test]
fn what_would_be_measured_wrongly_is_refused() {
    let moved = BED.replace("id,x,y,z", "x,y,z,id");
    let none = "id,x,y,z,radius,density\n";
    let cases: [(&str, &str, &[&str], &[&str]); 5] = [
        (&moved, "dry-bed", &[], &["line 1", "`x,y,z,id,radius,density`", "`id,x,y,z,"]),
        (none, "dry-bed", &[], &["bed.csv", "no sphere"]),
        (BED, "dry-bed", &["--implicit"], &["--implicit", "wet-bed"]),
        (BED, "dry-bed", &["--tile", "65536,65536"], &["--tile", "2^32"]),
        (BED, "dry-bed", &["--tile", "0,1"], &["--tile", "positive"]),
    ];
    for (bed, scene, options, words) in cases {
        let (code, said) = measured(bed, scene, options);
        assert_eq!(code, Some(2), "{said}");
        assert!(words.iter().all(|word| said.contains(word)), "{said}");
    }
}

#[test]
fn a_good_bed_is_measured() {
    for (scene, options) in [("dry-bed", &[][..]), ("wet-bed", &["--implicit", "--check"])] {
        let (code, said) = measured(BED, scene, options);
        assert_eq!(code, Some(0), "{said}");
        assert!(said.starts_with(&format!("pendular {scene} 1 1 10 ")), "{said}");
    }
}

/// As `throughput … | head -1` does.
#[test]
fn a_reader_that_goes_away_is_no_error() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bed.csv");
    std::fs::write(&path, BED).unwrap();
    let mut program = Command::new(env!("CARGO_BIN_EXE_throughput"));
    program.args(["--steps", "10", "--scene", "dry-bed", "--check", "--particles"]).arg(&path);
    let mut child = program.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let done = child.wait_with_output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
}
