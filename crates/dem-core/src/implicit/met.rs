//! Pairs as they were read, before links are made of them.

use super::{Impulse, Resist};
use crate::lane::{Lane, Vector};
use crate::pairs::Geometry;
use crate::particles::Class;

/// Pairs as they were read, side by side.
pub(crate) struct Met<'a, L: Lane> {
    /// Slots of the bodies; the second is that of the first again at a wall.
    pub(crate) slots: L::Each<[u32; 2]>,
    /// Where the pairs' columns stand.
    pub(crate) index: L::Each<u32>,
    pub(crate) geometry: &'a Geometry<L>,
    /// Square of the speed across the line of centres, m²/s².
    pub(crate) sideways: L,
    pub(crate) resist: &'a Resist<L>,
    pub(crate) remembered: &'a Remembered<L>,
}

/// What pairs remember of their [`Impulse`]s, without those on rolling.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Remembered<L> {
    pub(super) charged: L,
    pub(super) push: L,
    pub(super) shear: Vector<L>,
}

impl<L: Lane> Remembered<L> {
    #[inline(always)]
    pub(crate) fn pack(permit: L::Permit, mut each: impl FnMut(usize) -> Impulse) -> Self {
        let mut charged = L::each(|_| 0.0);
        let rows = L::each(|k| {
            let Impulse { charged: gap, normal, shear, .. } = each(k);
            charged[k] = gap;
            [f64::from(shear.x), f64::from(shear.y), f64::from(shear.z), f64::from(normal)]
        });
        let [x, y, z, push] = L::rows(permit, &rows, |row| *row);
        let charged = L::pack(permit, &charged, |gap| *gap);
        Self { charged, push, shear: Vector { x, y, z } }
    }

    /// The middle of what the gaps are expected to be charged for in this step.
    #[inline(always)]
    pub(crate) fn middle(&self, geometry: &Geometry<L>, duration: f64) -> L {
        let permit = geometry.gap.permit();
        let any = L::splat(permit, f64::INFINITY);
        let charged = self.charged.if_less(any, self.charged, geometry.gap);
        charged + L::splat(permit, 0.5 * duration) * geometry.separation_speed
    }

    /// Pair `k` alone.
    #[inline(always)]
    pub(super) fn single(&self, k: usize) -> Remembered<f64> {
        let one = |lanes: L| lanes.unpack()[k];
        let Vector { x, y, z } = self.shear;
        let shear = Vector { x: one(x), y: one(y), z: one(z) };
        Remembered { charged: one(self.charged), push: one(self.push), shear }
    }
}

/// 1/m and 1/I of every class, and the classes of the slots.
#[derive(Clone, Copy)]
pub(crate) struct Inverse<'a> {
    pub(crate) classes: &'a [[f64; 2]],
    pub(crate) class: &'a [u16],
}

impl Inverse<'_> {
    /// Of all classes.
    pub(crate) fn of(classes: &[Class]) -> Vec<[f64; 2]> {
        classes.iter().map(|class| [1.0 / class.mass(), 1.0 / class.inertia()]).collect()
    }

    /// Of the body at a slot.
    #[inline(always)]
    pub(crate) fn of_slot(&self, slot: u32) -> [f64; 2] {
        self.classes[usize::from(self.class[slot as usize])]
    }

    /// Of both bodies; a wall does not move.
    #[inline(always)]
    pub(super) fn both(&self, [a, b]: [u32; 2]) -> [f64; 4] {
        let [m, t] = self.of_slot(a);
        let [n, u] = if a == b { [0.0; 2] } else { self.of_slot(b) };
        [m, t, n, u]
    }
}
