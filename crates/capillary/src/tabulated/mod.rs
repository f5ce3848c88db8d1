//! The exact bridge folded into a small table: exact enough for use, as fast as a closed form.
//!
//! A bridge becomes, once, a curve of ten coefficients:
//!
//! ```text
//! F = (1 − S/H) (c₀ + c₁ τ + … + c₉ τ⁹),
//! H = √(S² + a²),   a² = 2V/(πR),   τ = √(1 − S/S_rup)
//! ```
//!
//! 1 − S/H is what a small bridge does (Lambert), τ takes up the square root at rupture.
//!
//! - **Equal contact angles**, any two spheres or sphere and plane: coefficients, S_rup and share
//!   are Chebyshev sums over ln V*, θ and ∛(1 − r_small/r_large), in a table of 39 kB that the
//!   example `make_table` builds from the exact solver.
//! - **Unequal angles**: cubic in ln V* between exactly solved bridges (65 nodes) for each pair of
//!   angles and size ratio, solved when first wanted and remembered for all threads. At the volume
//!   where the neck jumps from one body to the other the bridge is solved itself.
//! - **Outside**: the exact solver folds the bridge itself.
//!
//! # Accuracy
//! On bridges that did not build the table, S up to 0.98 S_rup, V* 1e-6 to 0.5, θ 0 to 60°:
//! relative error of the force 2e-5 in the median and 6e-4 at worst for equal angles, 1e-5 and 5e-4
//! for unequal ones; of S_rup at worst 3e-4 and 2e-4; error of the share at worst 3e-3. The example
//! prints them.
//!
//! # Cost
//! A force costs less than twice Lambert's (6.6 against 3.7 ns, with Willett's full form 20). A
//! curve costs 2 to 5 µs with equal angles; with unequal ones half a millisecond per node that is not
//! yet known (four for the first bridge, 65 at most per pair of bodies), then 0.2 µs. Where the exact
//! solver folds: half a millisecond.
//!
//! ```
//! use pendular_capillary::{Bridge, CapillaryLaw, ForceCurve, Mate, Range};
//! use pendular_capillary::tabulated::{self, Tabulated};
//! // Two spheres of 2.381 mm, 13.6 nl, 20.6 mN/m, θ = 0; exact at S = 120.5 µm: 39.067 µN.
//! let mate = Mate::Sphere { radius: 2.381e-3 };
//! let bridge = Bridge::new(2.381e-3, mate, 13.6e-12, [0.0; 2], 20.6e-3)?;
//! let curve = Tabulated.curve(&bridge, Range::Strict)?;
//! assert!((curve.force(1.20544793052e-4) / 3.906676002e-5 - 1.0).abs() < 5e-4);
//! assert_eq!(tabulated::transfer_ratio(&bridge)?, 0.5);
//! # Ok::<(), pendular_capillary::OutOfRange>(())
//! ```

mod chebyshev;
mod curve;
mod folded;
mod grid;
mod law;
mod pairs;
#[cfg(test)]
mod tests;

pub use curve::TabulatedCurve;
pub use grid::generate;
pub use law::{Tabulated, rupture_distance, transfer_ratio};
