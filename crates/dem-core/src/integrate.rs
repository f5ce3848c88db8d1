//! The write half: particles move.

use glam::DVec3;

use crate::chunk::{Chunk, Roll};
use crate::particles::{Class, Place, Velocity};

/// What moving a chunk found out.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Moved {
    /// Largest squared speed, m²/s².
    pub(crate) fastest2: f64,
    /// A sum that is finite if and only if all velocities are.
    pub(crate) check: f64,
}

/// One chunk's slices of the columns that change.
pub(crate) struct Bodies<'a> {
    pub(crate) places: &'a mut [Place],
    pub(crate) velocities: &'a mut [Velocity],
    pub(crate) rolls: &'a mut [Roll],
    pub(crate) class: &'a [u16],
}

/// Leapfrog: v(n+1/2) = v(n−1/2) + `kick` F/m, x(n+1) = x(n) + `drift` v(n+1/2).
///
/// `kick` is half a step at the start, where the velocities are those of the positions' time.
pub(crate) fn integrate<C>(
    chunk: &Chunk<C>,
    bodies: Bodies<'_>,
    classes: &[Class],
    gravity: DVec3,
    kick: f64,
    drift: f64,
) -> Moved {
    let mut moved = Moved::default();
    let Bodies { places, velocities, rolls, class } = bodies;
    for (slot, sum) in chunk.sums.iter().enumerate() {
        let kind = &classes[usize::from(class[slot])];
        let Velocity { v, w } = &mut velocities[slot];
        let turn = kick / kind.inertia();
        *v += (kick / kind.mass()) * sum.force + kick * gravity;
        if let (Some(roll), Some(brake)) = (rolls.get_mut(slot), chunk.rolls.get(slot)) {
            *roll = Roll { spin: turn * sum.torque, contacts: brake.contacts.max(1.0) };
            *w += roll.spin + turn * brake.spin;
        } else {
            *w += turn * sum.torque;
        }
        places[slot].x += drift * *v;
        let speed2 = v.length_squared();
        moved.fastest2 = moved.fastest2.max(speed2);
        moved.check += speed2 + w.length_squared();
    }
    moved
}
