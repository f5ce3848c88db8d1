use glam::DVec3;

/// Where a sphere is near a wall part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Element of the part that carries the nearest point.
    pub element: u32,
    /// Gap S of sphere and wall, m; negative in overlap.
    pub gap: f64,
    /// Unit vector from the sphere's centre towards the wall.
    pub normal: DVec3,
}

/// The walls of a scene, as the core sees them: parts that move and that spheres touch.
pub trait Boundary: Send + Sync {
    /// Places every part at `time` s and gives it its velocity at `velocity_time` s.
    fn move_to(&mut self, time: f64, velocity_time: f64);

    /// Velocity of a part, m/s.
    fn velocity(&self, part: u32) -> DVec3;

    /// Upper bound of the speed of all parts at all times, m/s.
    fn speed_bound(&self) -> f64;

    /// The caller's index of a part's material.
    fn material(&self, part: u32) -> u8;

    /// One more than the largest material index of any part, so that a term without a law for it
    /// is refused at set-up; 0, the default, leaves that unchecked.
    fn materials(&self) -> usize {
        0
    }

    /// Whether a part is there at the time of the last [`Boundary::move_to`].
    fn is_present(&self, part: u32) -> bool;

    /// Collects the parts, ascending, that may have a point within `reach` m of `centre`; `parts`
    /// is cleared first.
    fn near(&self, centre: DVec3, reach: f64, parts: &mut Vec<u32>);

    /// Collects the elements of `part` to look at for touches within `reach` m of `centre` and
    /// says whether there can be any; `elements` is cleared first. A shape that needs no such list
    /// leaves it empty.
    fn candidates(&self, part: u32, centre: DVec3, reach: f64, elements: &mut Vec<u32>) -> bool;

    /// Where a sphere can touch `part`, whatever the gap, if there is one such place only: a
    /// shorter way to what [`Boundary::touches`] finds. `None` leaves it to that.
    fn single_touch(&self, part: u32, centre: DVec3, radius: f64) -> Option<Touch> {
        let _ = (part, centre, radius);
        None
    }

    /// Collects where a sphere touches `part` with a gap of at most `reach` m, nearest first, once
    /// per smooth piece of surface; `touches` is cleared first. The nearest is found whatever its
    /// gap if `reach` is infinite.
    fn touches(
        &self,
        part: u32,
        candidates: &[u32],
        centre: DVec3,
        radius: f64,
        reach: f64,
        touches: &mut Vec<Touch>,
    );
}

/// No walls.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoWalls;

impl Boundary for NoWalls {
    fn move_to(&mut self, _: f64, _: f64) {}

    fn velocity(&self, _: u32) -> DVec3 {
        DVec3::ZERO
    }

    fn speed_bound(&self) -> f64 {
        0.0
    }

    fn material(&self, _: u32) -> u8 {
        0
    }

    fn is_present(&self, _: u32) -> bool {
        false
    }

    fn near(&self, _: DVec3, _: f64, parts: &mut Vec<u32>) {
        parts.clear();
    }

    fn candidates(&self, _: u32, _: DVec3, _: f64, elements: &mut Vec<u32>) -> bool {
        elements.clear();
        false
    }

    fn touches(&self, _: u32, _: &[u32], _: DVec3, _: f64, _: f64, touches: &mut Vec<Touch>) {
        touches.clear();
    }
}
