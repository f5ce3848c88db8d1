//! Terms that look at their pairs one at a time.

use pendular_dem_core::{
    Class, Columns, EachColumn, Encounter, Lane, Load, Loads, Pair, PairTerm, Pairs, Resist,
    StabilityLoad, TermError, Visits,
};

/// Does what its term does, by [`PairTerm::load`] alone.
pub(crate) struct LonePairs<T>(pub(crate) T);

impl<T: PairTerm> PairTerm for LonePairs<T> {
    type Column = T::Column;
    const LANES: bool = false;

    fn reach(&self) -> f64 {
        self.0.reach()
    }

    fn idle(&self, encounter: &Encounter, column: &mut Self::Column) -> bool {
        self.0.idle(encounter, column)
    }

    fn load(&self, pair: &Pair, column: &mut Self::Column) -> Load {
        self.0.load(pair, column)
    }

    fn load_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
    ) -> Loads<L> {
        assert_eq!(L::WIDTH, 1, "several at a time was not asked for");
        let each = L::each(|k| self.0.load(&pairs.pair(k), columns.column(k)));
        Loads::pack(pairs.permit, &each)
    }

    fn live(&self, column: &Self::Column) -> bool {
        self.0.live(column)
    }

    fn settle(&mut self, visits: &mut impl Visits<Self::Column>) -> Result<(), TermError> {
        self.0.settle(visits)
    }

    fn arrange(&mut self, each: &mut EachColumn<'_, Self::Column>) {
        self.0.arrange(each);
    }

    fn hand_on(&self, from: &mut Self::Column, to: &mut Self::Column) {
        self.0.hand_on(from, to);
    }

    fn rolls(&self) -> bool {
        self.0.rolls()
    }

    fn stability(&self, classes: &[Class]) -> Vec<StabilityLoad> {
        self.0.stability(classes)
    }
}

/// Does what its term does; what resists is asked for by [`PairTerm::resist`] alone.
pub(crate) struct LoneResistances<T>(pub(crate) T);

impl<T: PairTerm> PairTerm for LoneResistances<T> {
    type Column = T::Column;
    const LANES: bool = T::LANES;
    const COUPLES: bool = T::COUPLES;
    const ACTS_IN_OVERLAP: bool = T::ACTS_IN_OVERLAP;

    fn reach(&self) -> f64 {
        self.0.reach()
    }

    fn idle(&self, encounter: &Encounter, column: &mut Self::Column) -> bool {
        self.0.idle(encounter, column)
    }

    fn load(&self, pair: &Pair, column: &mut Self::Column) -> Load {
        self.0.load(pair, column)
    }

    fn load_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
    ) -> Loads<L> {
        self.0.load_lanes(pairs, columns)
    }

    fn live(&self, column: &Self::Column) -> bool {
        self.0.live(column)
    }

    fn settle(&mut self, visits: &mut impl Visits<Self::Column>) -> Result<(), TermError> {
        self.0.settle(visits)
    }

    fn arrange(&mut self, each: &mut EachColumn<'_, Self::Column>) {
        self.0.arrange(each);
    }

    fn hand_on(&self, from: &mut Self::Column, to: &mut Self::Column) {
        self.0.hand_on(from, to);
    }

    fn leave_resistance(&mut self) {
        self.0.leave_resistance();
    }

    fn resist(&self, pair: &Pair, column: &Self::Column, gap: f64) -> Resist {
        self.0.resist(pair, column, gap)
    }

    fn charge(&self, column: &Self::Column, gap: f64) -> [f64; 2] {
        self.0.charge(column, gap)
    }

    fn stability(&self, classes: &[Class]) -> Vec<StabilityLoad> {
        self.0.stability(classes)
    }
}
