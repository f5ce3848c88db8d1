//! Walls seen through their public interface.

#![allow(clippy::unwrap_used)] // helpers of tests are not seen as tests

mod input;
mod screen;
mod search;
mod shapes;
mod surfaces;

use pendular_walls::glam::DVec3;
use pendular_walls::{Part, Shape, Touch, Walls};

/// One part at rest.
fn one(shape: Shape) -> Walls {
    Walls::new(vec![Part::new("it", shape)]).unwrap()
}

/// All touches of a sphere with one part, by way of its candidates.
fn touches(walls: &Walls, part: u32, centre: DVec3, radius: f64, reach: f64) -> Vec<Touch> {
    let (mut candidates, mut out) = (Vec::new(), Vec::new());
    walls.candidates(part, centre, radius + reach, &mut candidates);
    walls.touches(part, &candidates, centre, radius, reach, &mut out);
    out
}
