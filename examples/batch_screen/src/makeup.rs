//! The two make-ups of a screening run: dry, and with liquid.

use pendular::BridgeForces;
use pendular::contact::Linear;
use pendular::dem::{Contact, ContactForces, DVec3, Pair, PairTerm, Spring};
use pendular::pair::OutOfRange;
use serde::{Deserialize, Serialize};

use crate::build::WetTerm;

/// What is stored of a pair: the tangential spring and the number of its bridge.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct StoredPair {
    pub(crate) stretch: [f64; 3],
    pub(crate) bridge: Option<u32>,
}

/// A pair term that may hold liquid, and whose columns can be stored.
pub(crate) trait Makeup: PairTerm + Sized {
    /// The liquid, if there is any.
    fn wet(&self) -> Option<&WetTerm>;
    /// The liquid, to be changed.
    fn wet_mut(&mut self) -> Option<&mut WetTerm>;
    /// A column as it is stored.
    fn store(column: &Self::Column) -> StoredPair;
    /// A stored column.
    fn load_pair(&self, stored: StoredPair) -> Result<Self::Column, OutOfRange>;
    /// What acts in a pair, force by force.
    fn forces(&self, pair: &Pair, column: &Self::Column) -> (ContactForces, Option<BridgeForces>);
}

impl Makeup for Contact<Linear> {
    fn wet(&self) -> Option<&WetTerm> {
        None
    }

    fn wet_mut(&mut self) -> Option<&mut WetTerm> {
        None
    }

    fn store(column: &Self::Column) -> StoredPair {
        StoredPair { stretch: column.stretch().to_array(), bridge: None }
    }

    fn load_pair(&self, stored: StoredPair) -> Result<Self::Column, OutOfRange> {
        Ok(Spring::new(DVec3::from_array(stored.stretch), ()))
    }

    fn forces(&self, pair: &Pair, column: &Self::Column) -> (ContactForces, Option<BridgeForces>) {
        (Contact::forces(self, pair, column), None)
    }
}

impl Makeup for (Contact<Linear>, WetTerm) {
    fn wet(&self) -> Option<&WetTerm> {
        Some(&self.1)
    }

    fn wet_mut(&mut self) -> Option<&mut WetTerm> {
        Some(&mut self.1)
    }

    fn store((spring, hold): &Self::Column) -> StoredPair {
        StoredPair { stretch: spring.stretch().to_array(), bridge: hold.bridge() }
    }

    fn load_pair(&self, stored: StoredPair) -> Result<Self::Column, OutOfRange> {
        Ok((self.0.load_pair(stored)?, self.1.column(stored.bridge)?))
    }

    fn forces(
        &self,
        pair: &Pair,
        (spring, hold): &Self::Column,
    ) -> (ContactForces, Option<BridgeForces>) {
        let bridge = hold.bridge().and_then(|bridge| self.1.forces(bridge, pair));
        (self.0.forces(pair, spring), bridge)
    }
}
