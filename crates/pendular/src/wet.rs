mod act;
mod bodies;
mod energy;
mod forces;
mod state;

use act::{Pull, act};

use pendular_capillary::CapillaryLaw;
use pendular_dem_core::{
    Class, Columns, Encounter, Geometry, Lane, Load, Loads, Pair, PairTerm, Pairs, Partner,
    StabilityLoad, TermError, Visit,
};
use pendular_lubrication::{NormalCurve, NormalDrag, TangentialCurve, TangentialDrag};
use pendular_pair::{Bridge, Mate, OutOfRange, Range};
use pendular_transfer::formation::{self, WetMate};
use pendular_transfer::{RuptureLaw, Split, TransferError, film};

use crate::split::Splits;
use crate::{Account, Ledger, Liquid, Move, PairLaws, SplitMethod};

/// Smallest V* of a bridge where no other is asked for.
const SMALLEST_V_STAR: f64 = 1e-9;
pub use bodies::{Bodies, Counts, WallElement, WetError};
use bodies::{check, parameter};
pub use forces::BridgeForces;
pub use state::{LiveState, WetState};

/// No bridge.
const DRY: u32 = u32::MAX;

/// What a pair remembers of its bridge; all that [`Wet::load`](PairTerm::load) needs of it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)] // what every step reads comes first
pub struct Hold<C, N, S> {
    bridge: u32,
    rupture: f64,
    /// The forces at contact: in overlap nothing else is looked at.
    contact: Pull,
    curves: Option<(C, N, S)>,
}

impl<C, N, S> Hold<C, N, S> {
    /// Number of the pair's bridge account, if it has a bridge.
    #[must_use]
    pub fn bridge(&self) -> Option<u32> {
        (self.bridge != DRY).then_some(self.bridge)
    }
}

impl<C, N, S> Default for Hold<C, N, S> {
    fn default() -> Self {
        // No gap is below this rupture distance.
        Self { bridge: DRY, rupture: f64::NEG_INFINITY, contact: Pull::UNKNOWN, curves: None }
    }
}

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

/// Liquid bridges: they form where films touch, pull, drag, break and hand liquid on.
///
/// All formations and ruptures of a step are computed from the state at its start and booked
/// together at its end (Elskamp & Kruggel-Emden 2018, section 2.2.1).
#[derive(Debug)]
pub struct Wet<C, N, S> {
    liquid: Liquid,
    between: PairLaws<C, N, S>,
    with_walls: PairLaws<C, N, S>,
    splits: Splits,
    range: Range,
    smallest_v_star: f64,
    bodies: Bodies,
    ledger: Ledger,
    live: Vec<Option<LiveBridge>>,
    thickness: Vec<f64>,
    wall_thickness: Vec<f64>,
    thickest: f64,
    counts: Counts,
    capillary_loss: f64,
}

/// What [`Wet`] remembers of one pair.
pub type Column<C, N, S> =
    Hold<<C as CapillaryLaw>::Curve, <N as NormalDrag>::Curve, <S as TangentialDrag>::Curve>;

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
            counts: Counts::default(),
            capillary_loss: 0.0,
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
        split.map_or([0.0; 2], |live| live.split.shares(volume))
    }

    /// All live bridges.
    pub fn bridges(&self) -> impl Iterator<Item = &LiveBridge> + '_ {
        self.live.iter().flatten()
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

    fn radius(&self, id: u32) -> f64 {
        self.bodies.radii[usize::from(self.bodies.class[id as usize])]
    }

    /// Wall element of an encounter, numbered through all parts.
    fn element(&self, part: u32, encounter: &Encounter) -> usize {
        (self.bodies.first_elements[part as usize] + encounter.element) as usize
    }

    fn thicknesses(&self, encounter: &Encounter) -> [f64; 2] {
        let second = match encounter.second {
            Partner::Particle(id) => self.thickness[id as usize],
            Partner::Wall(part) => self.wall_thickness[self.element(part, encounter)],
        };
        [self.thickness[encounter.first as usize], second]
    }

    fn accounts(&self, encounter: &Encounter) -> [Account; 2] {
        let second = match encounter.second {
            Partner::Particle(id) => Account::Film(id),
            Partner::Wall(part) => Account::Wall(self.element(part, encounter) as u32),
        };
        [Account::Film(encounter.first), second]
    }

    fn mate(&self, encounter: &Encounter) -> WetMate {
        match encounter.second {
            Partner::Particle(id) => WetMate::Sphere {
                radius: self.radius(id),
                film_volume: self.ledger.volume(Account::Film(id)),
            },
            Partner::Wall(part) => {
                let element = self.element(part, encounter);
                WetMate::Wall {
                    half_side: self.bodies.half_sides[part as usize],
                    film_volume: self.ledger.volume(Account::Wall(element as u32)),
                    area: self.bodies.elements[element].area,
                }
            }
        }
    }

    /// Smallest volume of a bridge, m³.
    fn smallest(&self, encounter: &Encounter) -> f64 {
        let radius = self.radius(encounter.first);
        let reduced = match encounter.second {
            Partner::Particle(id) => radius * self.radius(id) / (radius + self.radius(id)),
            Partner::Wall(_) => radius,
        };
        // The volume is positive also where the ratio's smallest value is set to 0.
        (self.smallest_v_star * (2.0 * reduced).powi(3)).max(f64::MIN_POSITIVE)
    }

    fn contact_angles(&self, encounter: &Encounter) -> [f64; 2] {
        let of = |id: u32| {
            let class = usize::from(self.bodies.class[id as usize]);
            self.liquid.particle_angles[usize::from(self.bodies.materials[class])]
        };
        let second = match encounter.second {
            Partner::Particle(id) => of(id),
            Partner::Wall(part) => {
                self.liquid.wall_angles[usize::from(self.bodies.wall_materials[part as usize])]
            }
        };
        [of(encounter.first), second]
    }

    /// What both bodies would give to a new bridge.
    fn claims(&self, encounter: &Encounter, bridge: u32) -> Result<[Move; 2], TransferError> {
        let film = self.ledger.volume(Account::Film(encounter.first));
        let mate = self.mate(encounter);
        let claims = formation::claims(self.radius(encounter.first), film, mate)?;
        let [first, second] = self.accounts(encounter);
        let to = Account::Bridge(bridge);
        Ok([
            Move { from: first, to, volume: claims[0] },
            Move { from: second, to, volume: claims[1] },
        ])
    }

    /// Folds the bridge of a pair into its column, now that its volume is known.
    fn fold(&mut self, encounter: &Encounter, account: u32) -> Result<Column<C, N, S>, WetError> {
        let volume = self.ledger.volume(Account::Bridge(account));
        let (first, second) = (encounter.first, encounter.second);
        let refuse = |source| WetError::Law { first, second, volume, source };
        let mate = match second {
            Partner::Particle(id) => Mate::Sphere { radius: self.radius(id) },
            Partner::Wall(part) => Mate::Wall { half_side: self.bodies.half_sides[part as usize] },
        };
        let angles = self.contact_angles(encounter);
        let tension = self.liquid.surface_tension;
        let bridge =
            Bridge::new(self.radius(first), mate, volume, angles, tension).map_err(refuse)?;
        let split = self.splits.of(&bridge);
        let (split, extrapolated) =
            split.map_err(|source| WetError::Transfer { first, second, volume, source })?;
        let live = LiveBridge { bridge, split, first, second };
        let hold = self.hold(account, &live).map_err(refuse)?;
        let laws = self.laws(second);
        let strange = laws.capillary.validity().check(&bridge).is_err()
            || laws.rupture.validity().check(&bridge).is_err();
        self.counts.extrapolated += u64::from(strange || extrapolated);
        self.live.resize((account as usize + 1).max(self.live.len()), None);
        self.live[account as usize] = Some(live);
        Ok(hold)
    }

    /// The laws of the bridges with a body.
    fn laws(&self, second: Partner) -> &PairLaws<C, N, S> {
        match second {
            Partner::Particle(_) => &self.between,
            Partner::Wall(_) => &self.with_walls,
        }
    }

    /// What a pair remembers of its bridge.
    fn hold(&self, account: u32, live: &LiveBridge) -> Result<Column<C, N, S>, OutOfRange> {
        let (laws, bridge) = (self.laws(live.second), &live.bridge);
        let viscosity = self.liquid.viscosity;
        let curves = (
            laws.capillary.curve(bridge, self.range)?,
            laws.normal.curve(bridge, viscosity)?,
            laws.tangential.curve(bridge, viscosity)?,
        );
        Ok(Hold {
            bridge: account,
            rupture: laws.rupture.distance(bridge, self.range)?,
            contact: Pull::contact(&curves),
            curves: Some(curves),
        })
    }

    /// Brings the film thickness of an account up to date.
    fn measure(&mut self, account: Account) -> Result<(), WetError> {
        let volume = self.ledger.volume(account);
        let thickness = match account {
            Account::Film(id) => {
                let h = film::thickness(self.radius(id), volume).map_err(parameter)?;
                self.thickness[id as usize] = h;
                h
            }
            Account::Wall(element) => {
                let area = self.bodies.elements[element as usize].area;
                let h = film::wall_thickness(area, volume).map_err(parameter)?;
                self.wall_thickness[element as usize] = h;
                h
            }
            Account::Bridge(_) | Account::Drained => 0.0,
        };
        self.thickest = self.thickest.max(thickness);
        Ok(())
    }

    /// Moves that end a bridge: its volume goes back to its bodies in the split's shares.
    fn rupture(&mut self, encounter: &Encounter, bridge: u32) -> [Move; 2] {
        let [to_first, to_second] = self.accounts(encounter);
        let [first, second] = self.shares(bridge);
        let from = Account::Bridge(bridge);
        [Move { from, to: to_first, volume: first }, Move { from, to: to_second, volume: second }]
    }
}

impl<C, N, S> PairTerm for Wet<C, N, S>
where
    C: CapillaryLaw + Send + Sync,
    C::Curve: Send + Sync,
    N: NormalDrag + Send + Sync,
    N::Curve: Send + Sync,
    S: TangentialDrag + Send + Sync,
    S::Curve: Send + Sync,
{
    type Column = Column<C, N, S>;

    fn reach(&self) -> f64 {
        2.0 * self.thickest
    }

    #[inline]
    fn idle(&self, encounter: &Encounter, column: &mut Self::Column) -> bool {
        if column.bridge != DRY {
            return false;
        }
        // The thickest film there ever was decides most pairs without a look at their own.
        !encounter.nearest
            || encounter.gap > 2.0 * self.thickest
            || !formation::films_touch(encounter.gap, self.thicknesses(encounter))
    }

    const LANES: bool = true;

    #[inline]
    fn load(&self, pair: &Pair, column: &mut Self::Column) -> Load {
        let geometry = Geometry::of(pair);
        match column.near(pair.encounter.gap) {
            Some(pull) => act(&[pull], &geometry),
            None => match self.apart(pair, column) {
                Some(pull) => act(&[pull], &geometry),
                None => return Load { attention: true, ..Load::default() },
            },
        }
        .single()
    }

    #[inline(always)]
    fn load_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
    ) -> Loads<L> {
        let gaps = pairs.geometry.gap.unpack();
        let mut near = true;
        let mut pulls = L::each(|k| {
            let pull = columns.column(k).near(gaps[k]);
            near &= pull.is_some();
            pull.unwrap_or_default()
        });
        let attention = if near { 0 } else { self.look_apart(pairs, columns, &mut pulls) };
        Loads { attention, ..act(&pulls, &pairs.geometry) }
    }

    #[inline]
    fn live(&self, column: &Self::Column) -> bool {
        column.bridge != DRY
    }

    fn settle(&mut self, visits: &mut [Visit<Self::Column>]) -> Result<(), TermError> {
        let mut moves = Vec::with_capacity(2 * visits.len());
        let mut forming = Vec::new();
        for (k, visit) in visits.iter_mut().enumerate() {
            let encounter = visit.encounter;
            if visit.column.bridge != DRY {
                moves.extend(self.rupture(&encounter, visit.column.bridge));
            } else if !visit.ending {
                let bridge = self.ledger.open_bridge();
                forming.push((k, bridge, moves.len()));
                moves.extend(self.claims(&encounter, bridge)?);
            }
        }
        self.ledger.book(&mut moves)?;
        for visit in visits.iter_mut().filter(|visit| visit.column.bridge != DRY) {
            let bridge = std::mem::take(&mut visit.column).bridge;
            self.lose(bridge, visit.encounter.gap, 1.0)?;
            self.live[bridge as usize] = None;
            self.ledger.close_bridge(bridge);
            self.counts.ruptured += 1;
        }
        for (k, bridge, given) in forming {
            let volume = self.ledger.volume(Account::Bridge(bridge));
            if volume >= self.smallest(&visits[k].encounter) {
                visits[k].column = self.fold(&visits[k].encounter, bridge)?;
                self.lose(bridge, visits[k].encounter.gap, -1.0)?;
                self.counts.formed += 1;
            } else {
                let back = |given: &Move| Move { from: given.to, to: given.from, ..*given };
                let [first, second] = [back(&moves[given]), back(&moves[given + 1])];
                self.ledger.book(&mut [first, second])?;
                self.ledger.close_bridge(bridge);
            }
        }
        for step in &moves {
            self.measure(step.from)?;
            self.measure(step.to)?;
        }
        Ok(())
    }

    fn hand_on(&self, from: &mut Self::Column, to: &mut Self::Column) {
        if from.bridge != DRY && to.bridge == DRY {
            std::mem::swap(from, to);
        }
    }

    fn stability(&self, classes: &[Class]) -> Vec<StabilityLoad> {
        // A drag that has no value here allows no time step at all.
        let none = StabilityLoad { normal_drag: f64::INFINITY, ..StabilityLoad::default() };
        let one = |class: &Class| self.strongest_drag(class, classes).unwrap_or(none);
        classes.iter().map(one).collect()
    }

    fn load_on_limit(&self, pair: &Pair, column: &Self::Column) -> StabilityLoad {
        let bridge = column.bridge();
        bridge.map_or_else(Default::default, |b| self.drag_on_limit(b, pair.encounter.gap))
    }
}

impl<C, N, S> Wet<C, N, S>
where
    C: CapillaryLaw,
    N: NormalDrag,
    S: TangentialDrag,
{
    /// Corrects the forces of those pairs that have no bridge or a far one; returns which of them
    /// want attention.
    #[cold]
    #[inline(never)]
    fn look_apart<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Column<C, N, S>>,
        pulls: &mut L::Each<Pull>,
    ) -> u32 {
        let mut attention = 0;
        for k in 0..L::WIDTH {
            let pair = pairs.pair(k);
            if columns.column(k).near(pair.encounter.gap).is_none() {
                let pull = self.apart(&pair, columns.column(k));
                attention |= u32::from(pull.is_none()) << k;
                pulls[k] = pull.unwrap_or_default();
            }
        }
        attention
    }

    /// What acts in a pair without bridge or beyond its static rupture distance; `None` if a bridge
    /// forms or ruptures.
    #[cold]
    fn apart(&self, pair: &Pair, column: &Column<C, N, S>) -> Option<Pull> {
        let (encounter, gap) = (&pair.encounter, pair.encounter.gap);
        if column.bridge == DRY {
            let forms =
                encounter.nearest && formation::films_touch(gap, self.thicknesses(encounter));
            return (!forms).then(Pull::default);
        }
        let speed = pair.separation_speed.hypot(pair.slip.length());
        let live = self.live[column.bridge as usize].as_ref()?;
        let dynamic = self.laws(live.second).dynamic.curve(&live.bridge);
        let factor = dynamic.map_or(1.0, |curve| curve.factor(speed));
        if gap > column.rupture * factor { None } else { column.far(gap) }
    }

    /// The drag at contact of the strongest pair that a class can be part of.
    fn strongest_drag(
        &self,
        class: &Class,
        classes: &[Class],
    ) -> Result<StabilityLoad, OutOfRange> {
        let largest = classes.iter().fold(0.0_f64, |r, other| r.max(other.radius()));
        let pairs =
            [(&self.between, Mate::Sphere { radius: largest }), (&self.with_walls, Mate::PLANE)];
        let mut most = StabilityLoad::default();
        for (laws, mate) in pairs {
            // The drag coefficients at contact hardly depend on the volume.
            let volume = 1e-2 * class.radius().powi(3);
            let tension = self.liquid.surface_tension;
            let bridge = Bridge::new(class.radius(), mate, volume, [0.0; 2], tension)?;
            let normal = laws.normal.curve(&bridge, self.liquid.viscosity)?;
            let tangential = laws.tangential.curve(&bridge, self.liquid.viscosity)?;
            let slip = tangential.resistance(0.0).slip;
            most.normal_drag = most.normal_drag.max(normal.coefficient(0.0));
            most.tangential_drag = most.tangential_drag.max(slip);
        }
        Ok(most)
    }
}
