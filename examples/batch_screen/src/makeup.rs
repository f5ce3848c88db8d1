//! The make-ups of a screening run: dry, with liquid, with liquid whose drags are implicit.

use pendular::BridgeForces;
use pendular::contact::Linear;
use pendular::dem::glam::Vec3;
use pendular::dem::{Contact, ContactForces, DVec3, Implicit, Impulse, Pair, PairTerm, Spring};
use pendular::pair::OutOfRange;
use serde::{Deserialize, Serialize};

use crate::build::WetTerm;

/// What is stored of a pair: the tangential spring, the number of its bridge, the impulses of
/// implicit drags.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct StoredPair {
    pub(crate) stretch: [f64; 3],
    pub(crate) bridge: Option<u32>,
    pub(crate) impulse: Option<StoredImpulse>,
}

/// Gap charged, normal impulse; shear, couple, rolling.
type StoredImpulse = (f64, f32, [[f32; 3]; 3]);

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
        StoredPair { stretch: column.stretch().to_array(), bridge: None, impulse: None }
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
        StoredPair { stretch: spring.stretch().to_array(), bridge: hold.bridge(), impulse: None }
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

impl Makeup for Implicit<(Contact<Linear>, WetTerm)> {
    fn wet(&self) -> Option<&WetTerm> {
        self.inner().wet()
    }

    fn wet_mut(&mut self) -> Option<&mut WetTerm> {
        self.inner_mut().wet_mut()
    }

    fn store((column, impulse): &Self::Column) -> StoredPair {
        let Impulse { charged, normal, shear, couple, rolling } = *impulse;
        let vectors = [shear, couple, rolling].map(|v| v.to_array());
        let impulse = Some((charged, normal, vectors));
        StoredPair { impulse, ..<(Contact<Linear>, WetTerm)>::store(column) }
    }

    fn load_pair(&self, stored: StoredPair) -> Result<Self::Column, OutOfRange> {
        let impulse = stored.impulse.map_or(Impulse::NONE, |(charged, normal, vectors)| {
            let [shear, couple, rolling] = vectors.map(Vec3::from_array);
            Impulse { charged, normal, shear, couple, rolling }
        });
        Ok((self.inner().load_pair(stored)?, impulse))
    }

    fn forces(
        &self,
        pair: &Pair,
        (column, impulse): &Self::Column,
    ) -> (ContactForces, Option<BridgeForces>) {
        let (mut contact, bridge) = self.inner().forces(pair, column);
        // Rolling friction is what the passes have found, not what a load would be.
        contact.rolling = impulse.rolling.as_dvec3() / pair.time_step;
        contact.rolling_power = -contact.rolling.dot(pair.spin);
        (contact, bridge)
    }
}
