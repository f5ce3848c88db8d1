//! What only those of eight links need that are not linear.

use super::eight::{EIGHT, set};
use super::link::Path;
use crate::lane::Lane;

/// Numbers of a [`Path`].
const PATH: usize = 6;

/// The paths of eight links.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(super) struct Paths([[f64; EIGHT]; PATH]);

impl Paths {
    pub(super) const NONE: Self = Self([[0.0; EIGHT]; PATH]);

    #[inline(always)]
    pub(super) fn store<L: Lane>(&mut self, at: usize, path: &Path<L>) {
        let Path { charged, paid, found, before, dashpot, pull } = *path;
        let numbers = [charged, paid, found, before, dashpot, pull];
        for (all, number) in self.0.iter_mut().zip(numbers) {
            set(all, at, number);
        }
    }

    pub(super) fn one(&self, k: usize) -> Path<f64> {
        let [charged, paid, found, before, dashpot, pull] = &self.0;
        Path {
            charged: charged[k],
            paid: paid[k],
            found: found[k],
            before: before[k],
            dashpot: dashpot[k],
            pull: pull[k],
        }
    }
}
