//! The core as its users see it: impacts, order of sums, lists, errors.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

mod bed;
mod crevice;
mod determinism;
mod errors;
mod impact;
mod implicit;
mod lists;
mod rolling;
mod survey;
mod walls;
