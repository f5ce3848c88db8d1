//! Tests across the crates.

#![allow(clippy::unwrap_used, reason = "the helpers of tests may panic like the tests")]

mod curves;
mod failure_modes;
mod implicit_beds;
mod implicit_drag;
mod laws;
mod layering;
mod liquid;
mod liquid_walls;
mod lone_pairs;
mod mesh_walls;
mod pull_off;
mod random_scenes;
mod rig;
mod seeds;
mod wet_pair;
mod young_laplace;
