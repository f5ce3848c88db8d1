//! The gaps up to which pairs count as charged, where their own impulses are not to say so.

use super::eight::{EIGHT, Eight, set, take};
use super::link::Link;
use super::loose;
use super::{Links, Memory};
use crate::chunk::List;
use crate::lane::{Kernel, Lane, in_widest};
use crate::particles::Velocity;

impl Links {
    /// Charges all pairs up to the gaps that the velocities lead to.
    ///
    /// Without that a pair is charged up to the gap that its impulse was found for, and for the rest
    /// of the way in the next step. That rest is some 1e-2 g of an impulse, g = h c/m: between stiff
    /// pairs, or where the passes did not come to their end, the next step would throw back what
    /// this one let through, and drive the bodies.
    pub(crate) fn close(&self, velocities: &[Velocity], first: u32, memory: &mut dyn Memory) {
        let eights = &self.all_eights[..self.taken.div_ceil(EIGHT)];
        in_widest(Close { eights, velocities, first, memory });
        for one in &self.loose {
            if let Some(own) = memory.impulse(one.list, one.index) {
                let two = loose::take(velocities, one.slots, first, one.wall);
                let (speed, _) = one.link.motion(&two);
                own.charged = one.link.charge_to(speed, 0.0);
            }
        }
    }

    /// Whether there is a stiff pair among them.
    pub(crate) fn has_stiff(&self) -> bool {
        self.stiff
    }
}

struct Close<'a> {
    eights: &'a [Eight],
    velocities: &'a [Velocity],
    first: u32,
    memory: &'a mut dyn Memory,
}

impl Kernel for Close<'_> {
    #[inline(always)]
    fn run<L: Lane>(self, permit: L::Permit) {
        let Close { eights, velocities, first, memory } = self;
        for eight in eights {
            let mut charged = [0.0; EIGHT];
            for at in (0..EIGHT).step_by(L::WIDTH) {
                let link: Link<L> = eight.load(permit, at);
                let two = take::<L>(permit, velocities, &eight.slots, at, first);
                let (speed, _) = link.motion(&two);
                set(&mut charged, at, link.charge_to(speed, L::splat(permit, 0.0)));
            }
            for k in (0..EIGHT).filter(|k| eight.which >> k & 1 == 1) {
                if let Some(own) = memory.impulse(List::Inside, eight.index[k]) {
                    own.charged = charged[k];
                }
            }
        }
    }
}
