//! What is not to be made up for in the next step.

use glam::DVec3;

use super::eight::EIGHT;
use super::link::Link;
use super::loose::take;
use super::{Links, Memory};
use crate::chunk::List;
use crate::particles::Velocity;

impl Links {
    /// Charges stiff pairs, or `all`, up to the gaps that the velocities lead to.
    ///
    /// The others are charged up to the gaps that their impulses were found for, and for the rest of
    /// the way in the next step. That rest is some 1e-3 g of an impulse, g = h c/m: of stiff pairs, or
    /// where the passes did not come to their end, the next step would throw back what this one let
    /// through, and drive the bodies.
    pub(crate) fn close(
        &self,
        velocities: &[Velocity],
        first: u32,
        all: bool,
        memory: &mut dyn Memory,
    ) {
        if !(all || self.stiff) {
            return;
        }
        let mut charge = |link: &Link<f64>, slots, wall, (list, index)| {
            if (all || link.is_stiff() != 0)
                && let Some(own) = memory.impulse(list, index)
            {
                let (speed, _) = link.motion(&take(velocities, slots, first, wall));
                own.charged = link.charge_to(speed, 0.0);
            }
        };
        for eight in &self.all_eights[..self.taken.div_ceil(EIGHT)] {
            for (slots, index, link) in eight.links() {
                charge(&link, slots, DVec3::ZERO, (List::Inside, index));
            }
        }
        for (k, loose) in self.loose.iter().enumerate() {
            charge(&loose.link, loose.slots, self.wall(k), (loose.list, loose.index));
        }
    }

    /// Whether any pair may have to be closed though the passes came to their end.
    pub(crate) fn has_stiff(&self) -> bool {
        self.stiff
    }
}
