//! Tests across the crates: see `main.rs`.
