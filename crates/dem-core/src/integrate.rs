//! The write half: particles move.

use glam::DVec3;

use crate::chunk::{Chunk, Roll, Sum};
use crate::particles::{Class, Place, Row, Velocity};

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
/// `pushes` are its effect by class, `fall` what gravity adds to a velocity. The sums are zero again
/// afterwards: it costs least while they are at hand.
pub(crate) fn integrate<C: Send>(
    chunk: &mut Chunk<C>,
    bodies: Bodies<'_>,
    pushes: &[Push],
    fall: DVec3,
    drift: f64,
) -> Moved {
    // In the widest registers that this machine has.
    pulp::Arch::new().dispatch(|| step(chunk, bodies, pushes, Row::new(fall), drift))
}

#[inline(always)]
fn step<C>(
    chunk: &mut Chunk<C>,
    bodies: Bodies<'_>,
    pushes: &[Push],
    fall: Row,
    drift: f64,
) -> Moved {
    let mut moved = Moved::default();
    let Bodies { places, velocities, rolls, class } = bodies;
    let columns = places.iter_mut().zip(velocities).zip(class).zip(&mut chunk.sums);
    for (slot, (((place, velocity), class), sum)) in columns.enumerate() {
        let push = pushes[usize::from(*class)];
        let turn = push.inertia;
        let (v, w) = (&mut velocity.v.0, &mut velocity.w.0);
        let Sum { force: Row(force), torque: Row(torque) } = std::mem::take(sum);
        *v = each(|k| v[k] + (push.mass * force[k] + fall.0[k]));
        if let (Some(roll), Some(brake)) = (rolls.get_mut(slot), chunk.rolls.get_mut(slot)) {
            let brake = std::mem::take(brake);
            *roll = Roll { spin: turn * Row(torque).vector(), contacts: brake.contacts.max(1.0) };
            let braked = Row::new(turn * brake.spin).0;
            *w = each(|k| w[k] + (turn * torque[k] + braked[k]));
        } else {
            *w = each(|k| w[k] + turn * torque[k]);
        }
        // The zero behind the velocity leaves the radius behind the position.
        let place_now = place.row();
        place.set(each(|k| place_now[k] + drift * v[k]));
        let speed2 = velocity.v.vector().length_squared();
        moved.fastest2 = moved.fastest2.max(speed2);
        moved.check += speed2 + velocity.w.vector().length_squared();
    }
    moved
}

/// x(n+1) = x(n) + `drift` v(n+1/2) alone.
pub(crate) fn drift(places: &mut [Place], velocities: &[Velocity], drift: f64) -> Moved {
    let mut moved = Moved::default();
    for (place, velocity) in places.iter_mut().zip(velocities) {
        let (v, w) = (velocity.v.vector(), velocity.w.vector());
        place.x += drift * v;
        let speed2 = v.length_squared();
        moved.fastest2 = moved.fastest2.max(speed2);
        moved.check += speed2 + w.length_squared();
    }
    moved
}

/// Four numbers; written out, so that they become one register.
#[inline(always)]
fn each(of: impl Fn(usize) -> f64) -> [f64; 4] {
    [of(0), of(1), of(2), of(3)]
}
