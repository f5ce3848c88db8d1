//! Writes the transfer ratios of the shipped pairs as CSV.
//!
//! `cargo run --release -p pendular-transfer --example make_tables > crates/transfer/tables/e18_ratios.csv`

use std::error::Error;

use pendular_transfer::split::{TransferTable, shipped_pairs};

const HEAD: &str = "\
# Transfer ratio T_i (share of the first body) over v_star = V/R^3, no units. Linear between rows.
# Parabolic bridge profile at Willett's rupture distance for unequal spheres; R is the harmonic
# mean of the two radii that the profile hangs on (the particle's own against a large wall).
# Columns: the pairs of e18_pairs.csv. Empty: the equations have no solution with a neck.
# Written by: cargo run --release -p pendular-transfer --example make_tables";

fn main() -> Result<(), Box<dyn Error>> {
    let pairs = shipped_pairs()?;
    let tables: Vec<TransferTable> =
        pairs.iter().map(|(_, pair)| TransferTable::compute(pair)).collect::<Result<_, _>>()?;
    println!("{HEAD}");
    let names: Vec<&str> = pairs.iter().map(|(name, _)| name.as_str()).collect();
    println!("v_star,{}", names.join(","));
    for v_star in TransferTable::grid() {
        let cell = |table: &TransferTable| {
            let found = table.nodes().find(|(v, _)| *v == v_star);
            found.map_or(String::new(), |(_, ratio)| format!("{ratio:.10}"))
        };
        let row: Vec<String> = tables.iter().map(cell).collect();
        println!("{v_star:.16e},{}", row.join(","));
    }
    Ok(())
}
