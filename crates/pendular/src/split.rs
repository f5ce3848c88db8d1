use std::collections::HashMap;
use std::collections::hash_map::Entry;

use pendular_pair::{Bridge, Mate};
use pendular_transfer::split::{TransferTable, exact};
use pendular_transfer::{Split, TransferError};

/// How the transfer ratio of a rupture is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SplitMethod {
    /// At the neck of the exact bridge, from the table of `pendular-capillary`.
    #[default]
    Exact,
    /// The parabolic profile of Pepin (2000) and Shi & McCarthy (2008), from a table over the
    /// volume as Elskamp & Kruggel-Emden (2018) use it. Outside the table the nearer end holds,
    /// and is counted as extrapolated.
    Parabola,
    /// Half to each body.
    Half,
}

/// The transfer ratios of a scene, by its pairs of bodies.
#[derive(Debug, Default)]
pub(crate) struct Splits {
    method: SplitMethod,
    tables: HashMap<[u64; 4], TransferTable>,
}

impl Splits {
    pub(crate) fn new(method: SplitMethod) -> Self {
        Self { method, tables: HashMap::new() }
    }

    /// The split of a bridge, and whether it is extrapolated.
    pub(crate) fn of(&mut self, bridge: &Bridge) -> Result<(Split, bool), TransferError> {
        match self.method {
            SplitMethod::Half => Ok((Split::HALF, false)),
            SplitMethod::Exact => Ok((exact(bridge)?, false)),
            SplitMethod::Parabola => {
                let lookup = self.table(bridge)?.clamped(bridge.volume())?;
                Ok((lookup.split, lookup.extrapolated))
            }
        }
    }

    /// The table of the bridge's two bodies, made when they first meet.
    fn table(&mut self, bridge: &Bridge) -> Result<&TransferTable, TransferError> {
        let size = match bridge.mate() {
            Mate::Sphere { radius } => radius,
            // No sphere has a negative radius: walls get keys of their own.
            Mate::Wall { half_side } => -half_side,
        };
        let [first, second] = bridge.contact_angles();
        let key = [bridge.radius(), size, first, second].map(f64::to_bits);
        Ok(match self.tables.entry(key) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => {
                let angles = [first, second];
                place.insert(TransferTable::for_pair(bridge.radius(), bridge.mate(), angles)?)
            }
        })
    }
}
