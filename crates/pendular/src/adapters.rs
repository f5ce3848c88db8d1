use std::cell::RefCell;

use pendular_dem_core::{Boundary, DVec3, Touch};
use pendular_walls::Walls;

thread_local! {
    /// Touches in the words of the wall crate, kept so that no step allocates.
    static FOUND: RefCell<Vec<pendular_walls::Touch>> = const { RefCell::new(Vec::new()) };
}

/// The walls of `pendular-walls` as the boundary of a simulation.
#[derive(Debug, Clone)]
pub struct MeshWalls(pub Walls);

impl Boundary for MeshWalls {
    fn move_to(&mut self, time: f64, velocity_time: f64) {
        self.0.move_to(time, velocity_time);
    }

    #[inline]
    fn velocity(&self, part: u32) -> DVec3 {
        self.0.velocity(part)
    }

    fn speed_bound(&self) -> f64 {
        self.0.speed_bound()
    }

    fn material(&self, part: u32) -> u8 {
        self.0.parts()[part as usize].material
    }

    fn materials(&self) -> usize {
        let parts = self.0.parts().iter();
        parts.map(|part| usize::from(part.material) + 1).max().unwrap_or(0)
    }

    #[inline]
    fn is_present(&self, part: u32) -> bool {
        self.0.is_present(part)
    }

    fn near(&self, centre: DVec3, reach: f64, parts: &mut Vec<u32>) {
        self.0.near(centre, reach, parts);
    }

    fn candidates(&self, part: u32, centre: DVec3, reach: f64, elements: &mut Vec<u32>) -> bool {
        self.0.candidates(part, centre, reach, elements);
        let mesh = matches!(self.0.parts()[part as usize].shape, pendular_walls::Shape::Mesh(_));
        !mesh || !elements.is_empty()
    }

    #[inline]
    fn single_touch(&self, part: u32, centre: DVec3, radius: f64) -> Option<Touch> {
        self.0.single_touch(part, centre, radius).map(touch)
    }

    #[inline]
    fn touches(
        &self,
        part: u32,
        candidates: &[u32],
        centre: DVec3,
        radius: f64,
        reach: f64,
        touches: &mut Vec<Touch>,
    ) {
        FOUND.with_borrow_mut(|found| {
            self.0.touches(part, candidates, centre, radius, reach, found);
            touches.clear();
            touches.extend(found.iter().copied().map(touch));
        });
    }
}

#[inline]
fn touch(touch: pendular_walls::Touch) -> Touch {
    let pendular_walls::Touch { element, gap, normal } = touch;
    Touch { element, gap, normal }
}
