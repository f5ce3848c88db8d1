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

impl Moved {
    /// What moving both found out.
    pub(crate) fn with(self, other: Self) -> Self {
        Self { fastest2: self.fastest2.max(other.fastest2), check: self.check + other.check }
    }

    fn see(&mut self, speed2: f64, velocity: &Velocity) {
        self.fastest2 = self.fastest2.max(speed2);
        self.check += speed2 + velocity.w.length_squared();
    }
}

/// What a kick gives to a particle of one class.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Push {
    /// Time over mass, s/kg.
    mass: f64,
    /// Time over moment of inertia, s/(kg m²).
    inertia: f64,
}

impl Push {
    pub(crate) fn new(class: &Class, kick: f64) -> Self {
        Self { mass: kick / class.mass(), inertia: kick / class.inertia() }
    }
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
/// The kick is half a step at the start, where the velocities are those of the positions' time;
/// `pushes` are its effect by class, `fall` what gravity adds to a velocity.
pub(crate) fn integrate<C>(
    chunk: &Chunk<C>,
    bodies: Bodies<'_>,
    pushes: &[Push],
    fall: DVec3,
    drift: f64,
) -> Moved {
    let mut moved = Moved::default();
    let Bodies { places, velocities, rolls, class } = bodies;
    let columns = places.iter_mut().zip(velocities).zip(class).zip(&chunk.sums);
    for (slot, (((place, velocity), class), sum)) in columns.enumerate() {
        let push = pushes[usize::from(*class)];
        let Velocity { v, w } = velocity;
        let turn = push.inertia;
        *v += push.mass * sum.force + fall;
        if let (Some(roll), Some(brake)) = (rolls.get_mut(slot), chunk.rolls.get(slot)) {
            *roll = Roll { spin: turn * sum.torque, contacts: brake.contacts.max(1.0) };
            *w += roll.spin + turn * brake.spin;
        } else {
            *w += turn * sum.torque;
        }
        place.x += drift * *v;
        let speed2 = v.length_squared();
        moved.fastest2 = moved.fastest2.max(speed2);
        moved.check += speed2 + w.length_squared();
    }
    moved
}

/// x(n+1) = x(n) + `drift` v(n+1/2) alone.
pub(crate) fn drift(places: &mut [Place], velocities: &[Velocity], drift: f64) -> Moved {
    let mut moved = Moved::default();
    for (place, velocity) in places.iter_mut().zip(velocities) {
        place.x += drift * velocity.v;
        moved.see(velocity.v.length_squared(), velocity);
    }
    moved
}
