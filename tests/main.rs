//! Tests across the crates.

mod curves;
mod laws;
