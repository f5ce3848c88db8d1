//! The program from outside: CSV in, CSV out.
#![allow(clippy::unwrap_used, reason = "a test that cannot run its program fails")]
#![allow(clippy::excessive_precision, reason = "seventeen digits, as they were computed")]

mod advise;
mod bad_input;
mod exact;
mod formulas;
mod other;
mod run;
