//! All liquid of a scene, to go on from later.

use pendular_capillary::CapillaryLaw;
use pendular_dem_core::Partner;
use pendular_lubrication::{NormalDrag, TangentialDrag};
use pendular_pair::{Mate, OutOfRange};
use pendular_transfer::Split;

use super::shelf::{Hold, Shelf};
use super::{LiveBridge, Seated, Wet, WetError};
use crate::{Account, Counts, Ledger};

/// A live bridge as plain numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LiveState {
    /// Radius of the first body, m.
    pub radius: f64,
    /// Radius of the second body, or half side of a wall, m.
    pub mate: f64,
    /// Volume, m³.
    pub volume: f64,
    /// Contact angles, rad.
    pub contact_angles: [f64; 2],
    /// Share of the first body at rupture.
    pub transfer_ratio: f64,
    /// The first body.
    pub first: u32,
    /// The second body.
    pub second: Partner,
}

/// The state of a [`Wet`] term, without its laws and bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct WetState {
    /// The account of all liquid.
    pub ledger: Ledger,
    /// Live bridges by their accounts.
    pub live: Vec<Option<LiveState>>,
    /// How many bridges there were.
    pub counts: Counts,
    /// Thickest film so far, m.
    pub thickest: f64,
    /// Capillary energy lost so far, J.
    pub capillary_loss: f64,
}

impl<C, N, S> Wet<C, N, S>
where
    C: CapillaryLaw,
    N: NormalDrag,
    S: TangentialDrag,
{
    /// What the liquid has become.
    #[must_use]
    pub fn state(&self) -> WetState {
        let plain = |live: &LiveBridge| {
            let bridge = &live.bridge;
            LiveState {
                radius: bridge.radius(),
                mate: match bridge.mate() {
                    Mate::Sphere { radius } => radius,
                    Mate::Wall { half_side } => half_side,
                },
                volume: bridge.volume(),
                contact_angles: bridge.contact_angles(),
                transfer_ratio: live.split.transfer_ratio(),
                first: live.first,
                second: live.second,
            }
        };
        WetState {
            ledger: self.ledger.clone(),
            live: (0..self.live.len() as u32).map(|k| self.live(k).as_ref().map(plain)).collect(),
            counts: self.counts,
            thickest: self.thickest,
            capillary_loss: self.capillary_loss,
        }
    }

    /// Goes on from a state. Laws and bodies are to be those of before; the columns of the pairs
    /// come from [`Wet::column`].
    ///
    /// # Errors
    /// [`WetError`] if the state does not fit the bodies.
    pub fn resume(&mut self, state: WetState) -> Result<(), WetError> {
        let fits = state.ledger.films().len() == self.thickness.len()
            && state.ledger.walls().len() == self.wall_thickness.len();
        if !fits {
            let (value, bodies) = (state.ledger.films().len() as f64, self.thickness.len() as f64);
            let quantity = "number of films in the state";
            return Err(OutOfRange { quantity, value, allowed: (bodies, bodies) }.into());
        }
        (self.live, self.shelf) = (Vec::with_capacity(state.live.len()), Shelf::default());
        for one in state.live {
            let seated = one.map(|state| self.seat(state)).transpose()?;
            self.live.push(seated);
        }
        self.ledger = state.ledger;
        self.counts = state.counts;
        for id in 0..self.thickness.len() as u32 {
            self.measure(Account::Film(id))?;
        }
        for element in 0..self.wall_thickness.len() as u32 {
            self.measure(Account::Wall(element))?;
        }
        self.thickest = state.thickest;
        self.capillary_loss = state.capillary_loss;
        Ok(())
    }

    /// Gives a stored bridge a seat.
    fn seat(&mut self, state: LiveState) -> Result<Seated, OutOfRange> {
        let LiveState { first, second, volume, .. } = state;
        let (bridge, split) =
            (self.bridge(first, second, volume)?, Split::new(state.transfer_ratio)?);
        let far = self.curves(&LiveBridge { bridge, split, first, second })?;
        let seat = self.shelf.seat();
        self.shelf.put(seat, far);
        Ok(Seated { split, first, second, seat })
    }

    /// The column of a pair that holds the live bridge of an account; that of a pair without a
    /// bridge for `None`.
    ///
    /// # Errors
    /// [`OutOfRange`] if there is no such bridge.
    pub fn column(&self, bridge: Option<u32>) -> Result<Hold, OutOfRange> {
        let Some(account) = bridge else { return Ok(Hold::default()) };
        let seated = self.live.get(account as usize).and_then(Option::as_ref);
        let last = self.live.len() as f64;
        let missing = OutOfRange {
            quantity: "number of a live bridge",
            value: f64::from(account),
            allowed: (0.0, last),
        };
        seated.map(|seated| Hold::new(account, seated.seat)).ok_or(missing)
    }
}
