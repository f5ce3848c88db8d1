//! Tests across the crates: see `main.rs`.

/// The programs in the documentation run as tests.
#[cfg(doctest)]
#[doc = include_str!("../../docs/using-one-law.md")]
struct UsingOneLaw;
