//! Tests across the crates.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

mod curves;
mod laws;
mod layering;
mod young_laplace;
