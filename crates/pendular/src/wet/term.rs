//! Bridges as a term between bodies.

use pendular_capillary::CapillaryLaw;
use pendular_dem_core::{
    Class, Columns, EachColumn, Encounter, Geometry, Lane, Load, Loads, Pair, PairTerm, Pairs,
    Resist, StabilityLoad, TermError, Visits,
};
use pendular_lubrication::{NormalCurve, NormalDrag, TangentialCurve, TangentialDrag};
use pendular_pair::{Bridge, Mate, OutOfRange};
use pendular_transfer::formation;

use super::Wet;
use super::act::Pulls;
use super::shelf::Hold;
use crate::room::make_room;
use crate::{Account, Move};

impl<C, N, S> PairTerm for Wet<C, N, S>
where
    C: CapillaryLaw + Send + Sync,
    C::Curve: Send + Sync,
    N: NormalDrag + Send + Sync,
    N::Curve: Send + Sync,
    S: TangentialDrag + Send + Sync,
    S::Curve: Send + Sync,
{
    type Column = Hold;

    fn reach(&self) -> f64 {
        2.0 * self.thickest
    }

    #[inline]
    fn idle(&self, encounter: &Encounter, column: &mut Self::Column) -> bool {
        if column.bridge().is_some() {
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
        let near = self.shelf.pull(column, pair.encounter.gap);
        match near.or_else(|| self.apart(pair, column)) {
            Some(pulls) => pulls.act(&Geometry::of(pair), self.drags).single(),
            None => Load { attention: true, ..Load::default() },
        }
    }

    #[inline(always)]
    fn load_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Hold>,
    ) -> Loads<L> {
        if !self.drags {
            return match self.shelf.tensions(pairs, columns) {
                Some(tension) => Loads { tension, ..Loads::none(pairs.permit) },
                None => self.look_apart(pairs, columns),
            };
        }
        match self.shelf.pulls(pairs, columns) {
            Some(pulls) => pulls.act(pairs.geometry, self.drags),
            None => self.look_apart(pairs, columns),
        }
    }

    #[inline]
    fn live(&self, column: &Self::Column) -> bool {
        column.bridge().is_some()
    }

    fn settle(&mut self, visits: &mut impl Visits<Self::Column>) -> Result<(), TermError> {
        // Very many bridges may form in the first step: besides their moves nothing is kept of them
        // but their place among the visits and what stays, an account in their column.
        let mut moves = Vec::with_capacity(2 * visits.count());
        self.ledger.reserve(visits.count());
        for k in 0..visits.count() {
            let encounter = visits.encounter(k);
            if let Some(bridge) = visits.column(k).bridge() {
                moves.extend(self.rupture(&encounter, bridge));
            } else if !visits.ends(k) {
                let bridge = self.ledger.open_bridge();
                *visits.column(k) = Hold::forming(bridge);
                moves.extend(self.claims(&encounter, bridge)?);
            }
        }
        self.ledger.book(&mut moves)?;
        for k in 0..visits.count() {
            let Some(bridge) = visits.column(k).ruptures() else { continue };
            *visits.column(k) = Hold::default();
            self.lose(bridge, visits.encounter(k).gap, 1.0);
            if let Some(seated) = self.live[bridge as usize].take() {
                self.shelf.leave(seated.seat);
            }
            self.ledger.close_bridge(bridge);
            self.counts.ruptured += 1;
        }
        self.give_back_too_little(visits, &moves)?;
        for step in &moves {
            self.measure(step.from)?;
            self.measure(step.to)?;
        }
        drop(moves);
        self.seat_new(visits)
    }

    fn arrange(&mut self, each: &mut EachColumn<'_, Hold>) {
        let seats = self.shelf.arrange(self.live.len(), each);
        for (seated, seat) in self.live.iter_mut().zip(seats) {
            if let Some(seated) = seated {
                seated.seat = seat;
            }
        }
    }

    fn hand_on(&self, from: &mut Self::Column, to: &mut Self::Column) {
        if from.bridge().is_some() && to.bridge().is_none() {
            std::mem::swap(from, to);
        }
    }

    fn stability(&self, classes: &[Class]) -> Vec<StabilityLoad> {
        // A drag that has no value here allows no time step at all.
        let none = StabilityLoad { normal_drag: f64::INFINITY, ..StabilityLoad::default() };
        let one = |class: &Class| self.strongest_drag(class, classes).unwrap_or(none);
        classes.iter().map(one).collect()
    }

    fn leave_resistance(&mut self) {
        self.drags = false;
    }

    fn resist(&self, _: &Pair, column: &Hold, gap: f64) -> Resist {
        self.shelf.resist_one(column, gap)
    }

    #[inline(always)]
    fn resist_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Hold>,
        gap: L,
    ) -> Resist<L> {
        self.shelf.resist(columns, gap).unwrap_or_else(|| {
            let gaps = gap.unpack();
            let one = |k| self.shelf.resist_one(columns.column(k), gaps[k]);
            Resist::pack(pairs.permit, &L::each(one))
        })
    }

    fn charge(&self, column: &Hold, gap: f64) -> [f64; 2] {
        self.shelf.charge(column, gap)
    }

    fn load_on_limit(&self, pair: &Pair, column: &Hold) -> StabilityLoad {
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
    /// Gives the liquid back that is too little for a bridge.
    fn give_back_too_little(
        &mut self,
        visits: &mut impl Visits<Hold>,
        moves: &[Move],
    ) -> Result<(), TermError> {
        let given = moves.chunks_exact(2).filter_map(|both| match both[0].to {
            Account::Bridge(bridge) => Some((bridge, both)),
            _ => None,
        });
        let mut given = given.peekable();
        for k in 0..visits.count() {
            let Some(bridge) = visits.column(k).forms() else { continue };
            let Some((_, both)) = given.next_if(|(to, _)| *to == bridge) else { continue };
            if !self.has_enough(bridge, &visits.encounter(k)) {
                let back = |given: &Move| Move { from: given.to, to: given.from, ..*given };
                self.ledger.book(&mut [back(&both[0]), back(&both[1])])?;
                self.ledger.close_bridge(bridge);
                *visits.column(k) = Hold::default();
            }
        }
        Ok(())
    }

    /// Folds the bridges that form.
    fn seat_new(&mut self, visits: &mut impl Visits<Hold>) -> Result<(), TermError> {
        let forming = (0..visits.count()).filter(|&k| visits.column(k).forms().is_some()).count();
        let accounts = self.ledger.bridges();
        let more = accounts.saturating_sub(self.live.len());
        make_room(&mut self.live, more);
        self.live.resize(accounts, None);
        self.shelf.reserve(forming);
        for k in 0..visits.count() {
            let Some(bridge) = visits.column(k).forms() else { continue };
            let encounter = visits.encounter(k);
            let seat = self.shelf.seat();
            self.fold(bridge, seat, &encounter)?;
            *visits.column(k) = Hold::new(bridge, seat);
            self.lose(bridge, encounter.gap, -1.0);
            self.counts.formed += 1;
        }
        Ok(())
    }

    /// What acts where some of the pairs have no bridge or a far one, or forces at contact that say
    /// nothing of overlap.
    #[cold]
    #[inline(never)]
    fn look_apart<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Hold>,
    ) -> Loads<L> {
        let mut attention = 0;
        let mut pulls = L::each(|_| Pulls::<f64>::default());
        for k in 0..L::WIDTH {
            let (pair, column) = (pairs.pair(k), &*columns.column(k));
            let near = self.shelf.pull(column, pair.encounter.gap);
            let pull = near.or_else(|| self.apart(&pair, column));
            attention |= u32::from(pull.is_none()) << k;
            pulls[k] = pull.unwrap_or_default();
        }
        let pulls = Pulls::<L>::side_by_side(pairs.permit, &pulls);
        Loads { attention, ..pulls.act(pairs.geometry, self.drags) }
    }

    /// What acts in a pair without bridge or beyond its static rupture distance; `None` if a bridge
    /// forms or ruptures.
    #[cold]
    fn apart(&self, pair: &Pair, column: &Hold) -> Option<Pulls<f64>> {
        let (encounter, gap) = (&pair.encounter, pair.encounter.gap);
        let Some(bridge) = column.bridge() else {
            let forms =
                encounter.nearest && formation::films_touch(gap, self.thicknesses(encounter));
            return (!forms).then(Pulls::default);
        };
        let speed = pair.separation_speed.hypot(pair.slip.length());
        let live = self.live(bridge)?;
        let dynamic = self.laws(live.second).dynamic.curve(&live.bridge);
        let factor = dynamic.map_or(1.0, |curve| curve.factor(speed));
        let rupture = self.shelf.rupture(column)?;
        if gap > rupture * factor { None } else { self.shelf.beyond(column, gap) }
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
