mod act;
mod bodies;
mod books;
mod energy;
mod forces;
mod kinds;
mod shelf;
mod state;
mod term;

use pendular_capillary::CapillaryLaw;
use pendular_dem_core::Partner;
use pendular_lubrication::{NormalDrag, TangentialDrag};
use pendular_pair::{Bridge, OutOfRange, Range};
use pendular_transfer::Split;

use crate::split::Splits;
use crate::{Account, Ledger, Liquid, Move, PairLaws, SplitMethod};

use bodies::check;
pub use bodies::{Bodies, Counts, WallElement, WetError};
pub use forces::BridgeForces;
pub use shelf::Hold;
use shelf::Shelf;
pub use state::{LiveState, WetState};

/// Smallest V* of a bridge where no other is asked for.
const SMALLEST_V_STAR: f64 = 1e-9;

/// A live bridge: what only its end and reports need, kept apart from what every step reads.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LiveBridge {
    /// What is constant over its life.
    pub bridge: Bridge,
    /// How its liquid is shared when it breaks.
    pub split: Split,
    /// The first body.
    pub first: u32,
    /// The second body.
    pub second: Partner,
}

/// A live bridge, as little of it as it can be made again from, and where on the shelf its forces
/// are.
#[derive(Debug, Clone, Copy)]
struct Seated {
    split: Split,
    first: u32,
    second: Partner,
    seat: u32,
}

/// Liquid bridges: they form where films touch, pull, drag, break and hand liquid on.
///
/// All formations and ruptures of a step are computed from the state at its start and booked
/// together at its end (Elskamp & Kruggel-Emden 2018, section 2.2.1).
pub struct Wet<C, N, S>
where
    C: CapillaryLaw,
    N: NormalDrag,
    S: TangentialDrag,
{
    liquid: Liquid,
    between: PairLaws<C, N, S>,
    with_walls: PairLaws<C, N, S>,
    splits: Splits,
    range: Range,
    smallest_v_star: f64,
    bodies: Bodies,
    ledger: Ledger,
    live: Vec<Option<Seated>>,
    shelf: Shelf<C::Curve, N::Curve, S::Curve>,
    thickness: Vec<f64>,
    wall_thickness: Vec<f64>,
    thickest: f64,
    counts: Counts,
    capillary_loss: f64,
    /// Whether loads hold the drags too.
    drags: bool,
}

impl<C, N, S> std::fmt::Debug for Wet<C, N, S>
where
    C: CapillaryLaw,
    N: NormalDrag,
    S: TangentialDrag,
{
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Wet")
            .field("liquid", &self.liquid)
            .field("counts", &self.counts)
            .finish_non_exhaustive()
    }
}

impl<C, N, S> Wet<C, N, S>
where
    C: CapillaryLaw,
    N: NormalDrag,
    S: TangentialDrag,
{
    /// Liquid on particles, walls dry.
    ///
    /// `films` are the volumes L on the particles by id, m³. `range` says what to do with a bridge
    /// outside a law's validity range: refuse (the run stops) or count it as extrapolated.
    ///
    /// # Errors
    /// [`WetError`] for a negative film, a parameter that is not positive, or a material without
    /// contact angle.
    pub fn new(
        liquid: Liquid,
        between: PairLaws<C, N, S>,
        with_walls: PairLaws<C, N, S>,
        split: SplitMethod,
        range: Range,
        bodies: Bodies,
        films: Vec<f64>,
    ) -> Result<Self, WetError> {
        check(&liquid, &bodies, &films)?;
        let (particles, elements) = (films.len(), bodies.elements.len());
        let mut wet = Self {
            ledger: Ledger::new(films, elements),
            thickness: vec![0.0; particles],
            wall_thickness: vec![0.0; elements],
            thickest: 0.0,
            live: Vec::new(),
            shelf: Shelf::default(),
            counts: Counts::default(),
            capillary_loss: 0.0,
            drags: true,
            liquid,
            between,
            with_walls,
            splits: Splits::new(split),
            range,
            smallest_v_star: SMALLEST_V_STAR,
            bodies,
        };
        for id in 0..particles as u32 {
            wet.measure(Account::Film(id))?;
        }
        Ok(wet)
    }

    /// The same with another smallest V* = V/R³ of a bridge; 1e-9 otherwise. Films that would give
    /// less form none: such a bridge would break within a thousandth of the radius.
    ///
    /// # Errors
    /// [`OutOfRange`] unless it lies in [0, 1e-3].
    pub fn with_smallest_v_star(self, smallest_v_star: f64) -> Result<Self, OutOfRange> {
        OutOfRange::within("smallest V/R^3", smallest_v_star, (0.0, 1e-3))?;
        Ok(Self { smallest_v_star, ..self })
    }

    /// The account of all liquid.
    #[must_use]
    pub fn ledger(&self) -> &Ledger {
        &self.ledger
    }

    /// How many bridges formed and broke.
    #[must_use]
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Bridges alive.
    #[must_use]
    pub fn alive(&self) -> u64 {
        self.counts.formed - self.counts.ruptured
    }

    /// The liquid.
    #[must_use]
    pub fn liquid(&self) -> &Liquid {
        &self.liquid
    }

    /// Film thickness on a particle, m.
    #[must_use]
    pub fn film_thickness(&self, id: u32) -> f64 {
        self.thickness.get(id as usize).copied().unwrap_or(0.0)
    }

    /// Books the film of a particle that left the scene as drained and returns it, m³; 0 for an id
    /// that was never in it.
    pub fn drain(&mut self, id: u32) -> f64 {
        let volume = self.ledger.volume(Account::Film(id));
        let out = Move { from: Account::Film(id), to: Account::Drained, volume };
        if self.ledger.book(&mut [out]).is_ok() {
            self.thickness[id as usize] = 0.0;
        }
        volume
    }

    /// How the liquid of a live bridge would be shared if it broke now, m³ to the first body and
    /// to the second.
    #[must_use]
    pub fn shares(&self, bridge: u32) -> [f64; 2] {
        let split = self.live.get(bridge as usize).copied().flatten();
        let volume = self.ledger.volume(Account::Bridge(bridge));
        split.map_or([0.0; 2], |seated| seated.split.shares(volume))
    }

    /// All live bridges.
    pub fn bridges(&self) -> impl Iterator<Item = LiveBridge> + '_ {
        (0..self.live.len() as u32).filter_map(|account| self.live(account))
    }

    /// The tension of a live bridge at `gap` m, N; as in [`pendular_capillary::CapillaryLaw::force`].
    ///
    /// # Errors
    /// [`OutOfRange`] as when the bridge formed; it has formed, so that does not happen.
    pub fn tension(&self, live: &LiveBridge, gap: f64) -> Result<f64, OutOfRange> {
        self.laws(live.second).capillary.force(&live.bridge, gap, self.range)
    }

    /// Class of a particle, also of one that has left.
    #[must_use]
    pub fn class(&self, id: u32) -> u16 {
        self.bodies.class[id as usize]
    }
}
