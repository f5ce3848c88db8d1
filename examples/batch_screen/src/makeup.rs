//! The two make-ups of a screening run: dry, and with liquid.

use pendular::contact::Linear;
use pendular::dem::{Contact, PairTerm};

use crate::build::WetTerm;

/// A pair term that may hold liquid.
pub(crate) trait Makeup: PairTerm {
    /// The liquid, if there is any.
    fn wet(&self) -> Option<&WetTerm>;
    /// The liquid, to be changed.
    fn wet_mut(&mut self) -> Option<&mut WetTerm>;
}

impl Makeup for Contact<Linear> {
    fn wet(&self) -> Option<&WetTerm> {
        None
    }

    fn wet_mut(&mut self) -> Option<&mut WetTerm> {
        None
    }
}

impl Makeup for (Contact<Linear>, WetTerm) {
    fn wet(&self) -> Option<&WetTerm> {
        Some(&self.1)
    }

    fn wet_mut(&mut self) -> Option<&mut WetTerm> {
        Some(&mut self.1)
    }
}
