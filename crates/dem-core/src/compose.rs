//! Terms made of terms: two together, and one that may be absent.

use crate::lane::Lane;
use crate::limit;
use crate::pairs::{Columns, First, Loads, Pairs, Part, Second};
use crate::visits::Visits;
use crate::{Class, EachColumn, Encounter, Impulse, Load, Pair, PairTerm, Resist, TermError};

/// Two terms act together; their columns lie side by side.
impl<A: PairTerm, B: PairTerm> PairTerm for (A, B) {
    type Column = (A::Column, B::Column);

    fn reach(&self) -> f64 {
        self.0.reach().max(self.1.reach())
    }

    #[inline(always)]
    fn idle(&self, encounter: &Encounter, column: &mut Self::Column) -> bool {
        // No short circuit: each brings its own column to rest.
        self.0.idle(encounter, &mut column.0) & self.1.idle(encounter, &mut column.1)
    }

    #[inline(always)]
    fn load(&self, pair: &Pair, column: &mut Self::Column) -> Load {
        self.0.load(pair, &mut column.0) + self.1.load(pair, &mut column.1)
    }

    /// [`crate::Implicit`] goes around a tuple, not into it: what resists is solved for together.
    const IMPLICIT: bool = {
        assert!(!A::IMPLICIT && !B::IMPLICIT, "Implicit goes around a tuple, not into it");
        false
    };
    const SETTLES: bool = A::SETTLES || B::SETTLES;
    const LANES: bool = A::LANES || B::LANES;
    const ACTS_IN_OVERLAP: bool = A::ACTS_IN_OVERLAP || B::ACTS_IN_OVERLAP;
    const COUPLES: bool = A::COUPLES || B::COUPLES;

    #[inline(always)]
    fn load_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
    ) -> Loads<L> {
        if self.0.is_absent() {
            return self.1.load_lanes(pairs, &mut Part::<_, Second<A::Column>>::of(columns));
        }
        let first = self.0.load_lanes(pairs, &mut Part::<_, First<B::Column>>::of(columns));
        if self.1.is_absent() {
            return first;
        }
        first + self.1.load_lanes(pairs, &mut Part::<_, Second<A::Column>>::of(columns))
    }

    #[inline(always)]
    fn is_absent(&self) -> bool {
        self.0.is_absent() && self.1.is_absent()
    }

    #[inline(always)]
    fn live(&self, column: &Self::Column) -> bool {
        self.0.live(&column.0) || self.1.live(&column.1)
    }

    fn settle(&mut self, visits: &mut impl Visits<Self::Column>) -> Result<(), TermError> {
        if A::SETTLES {
            self.0.settle(&mut Part::<_, First<B::Column>>::of(visits))?;
        }
        if B::SETTLES {
            self.1.settle(&mut Part::<_, Second<A::Column>>::of(visits))?;
        }
        Ok(())
    }

    fn arrange(&mut self, each: &mut EachColumn<'_, Self::Column>) {
        self.0.arrange(&mut |see| each(&mut |column| see(&mut column.0)));
        self.1.arrange(&mut |see| each(&mut |column| see(&mut column.1)));
    }

    fn hand_on(&self, from: &mut Self::Column, to: &mut Self::Column) {
        self.0.hand_on(&mut from.0, &mut to.0);
        self.1.hand_on(&mut from.1, &mut to.1);
    }

    fn rolls(&self) -> bool {
        self.0.rolls() || self.1.rolls()
    }

    fn wall_materials(&self) -> Option<usize> {
        let both = [self.0.wall_materials(), self.1.wall_materials()];
        both.into_iter().flatten().min()
    }

    fn stability(&self, classes: &[Class]) -> Vec<limit::Load> {
        let (a, b) = (self.0.stability(classes), self.1.stability(classes));
        a.into_iter().zip(b).map(|(a, b)| a + b).collect()
    }

    fn load_on_limit(&self, pair: &Pair, column: &Self::Column) -> limit::Load {
        self.0.load_on_limit(pair, &column.0) + self.1.load_on_limit(pair, &column.1)
    }

    fn leave_resistance(&mut self) {
        self.0.leave_resistance();
        self.1.leave_resistance();
    }

    #[inline(always)]
    fn resist(&self, pair: &Pair, column: &Self::Column, gap: f64) -> Resist {
        self.0.resist(pair, &column.0, gap) + self.1.resist(pair, &column.1, gap)
    }

    #[inline(always)]
    fn resist_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
        gap: L,
    ) -> Resist<L> {
        let first = self.0.resist_lanes(pairs, &mut Part::<_, First<B::Column>>::of(columns), gap);
        first + self.1.resist_lanes(pairs, &mut Part::<_, Second<A::Column>>::of(columns), gap)
    }

    fn charge(&self, column: &Self::Column, gap: f64) -> [f64; 2] {
        let ([p, c], [q, d]) = (self.0.charge(&column.0, gap), self.1.charge(&column.1, gap));
        [p + q, c + d]
    }
}

/// A term that may be absent: `None` acts in no pair.
impl<T: PairTerm> PairTerm for Option<T> {
    type Column = T::Column;

    fn reach(&self) -> f64 {
        self.as_ref().map_or(0.0, T::reach)
    }

    #[inline(always)]
    fn idle(&self, encounter: &Encounter, column: &mut Self::Column) -> bool {
        self.as_ref().is_none_or(|term| term.idle(encounter, column))
    }

    #[inline(always)]
    fn load(&self, pair: &Pair, column: &mut Self::Column) -> Load {
        self.as_ref().map_or_else(Load::default, |term| term.load(pair, column))
    }

    const IMPLICIT: bool = T::IMPLICIT;
    const SETTLES: bool = T::SETTLES;
    const LANES: bool = T::LANES;
    const COUPLES: bool = T::COUPLES;

    #[inline(always)]
    fn load_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
    ) -> Loads<L> {
        match self {
            Some(term) => term.load_lanes(pairs, columns),
            None => Loads::none(pairs.permit),
        }
    }

    #[inline(always)]
    fn is_absent(&self) -> bool {
        self.as_ref().is_none_or(T::is_absent)
    }

    #[inline(always)]
    fn live(&self, column: &Self::Column) -> bool {
        self.as_ref().is_some_and(|term| term.live(column))
    }

    fn settle(&mut self, visits: &mut impl Visits<Self::Column>) -> Result<(), TermError> {
        self.as_mut().map_or(Ok(()), |term| term.settle(visits))
    }

    fn arrange(&mut self, each: &mut EachColumn<'_, Self::Column>) {
        if let Some(term) = self {
            term.arrange(each);
        }
    }

    fn hand_on(&self, from: &mut Self::Column, to: &mut Self::Column) {
        if let Some(term) = self {
            term.hand_on(from, to);
        }
    }

    fn rolls(&self) -> bool {
        self.as_ref().is_some_and(T::rolls)
    }

    fn wall_materials(&self) -> Option<usize> {
        self.as_ref().and_then(T::wall_materials)
    }

    fn stability(&self, classes: &[Class]) -> Vec<limit::Load> {
        match self {
            Some(term) => term.stability(classes),
            None => ().stability(classes),
        }
    }

    fn load_on_limit(&self, pair: &Pair, column: &Self::Column) -> limit::Load {
        self.as_ref().map_or_else(Default::default, |term| term.load_on_limit(pair, column))
    }

    fn leave_resistance(&mut self) {
        if let Some(term) = self {
            term.leave_resistance();
        }
    }

    fn resist(&self, pair: &Pair, column: &Self::Column, gap: f64) -> Resist {
        let resist = |term: &T| term.resist(pair, column, gap);
        self.as_ref().map_or_else(Resist::default, resist)
    }

    #[inline(always)]
    fn resist_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
        gap: L,
    ) -> Resist<L> {
        match self {
            Some(term) => term.resist_lanes(pairs, columns, gap),
            None => Resist::none(pairs.permit),
        }
    }

    fn charge(&self, column: &Self::Column, gap: f64) -> [f64; 2] {
        self.as_ref().map_or([0.0; 2], |term| term.charge(column, gap))
    }

    fn impulse<'a>(&self, column: &'a mut Self::Column) -> Option<&'a mut Impulse> {
        self.as_ref().and_then(|term| term.impulse(column))
    }
}
