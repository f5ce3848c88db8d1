use crate::lane::Lane;
use crate::limit;
use crate::pairs::{Columns, First, Loads, Pairs, Part, Second};
use crate::{Class, Encounter, Impulse, Load, Pair, Resist};

/// Any error of a term.
pub type TermError = Box<dyn std::error::Error + Send + Sync>;

/// Calls what it is given with every column of a term.
pub type EachColumn<'a, C> = dyn FnMut(&mut dyn FnMut(&mut C)) + 'a;

/// The pairs that a term is to settle.
pub trait Visits<C> {
    /// How many there are.
    fn count(&self) -> usize;

    /// Pair `k` as it was read.
    fn encounter(&self, k: usize) -> Encounter;

    /// Whether pair `k` ends after this visit: a body leaves the scene, or a wall part is taken away.
    fn ends(&self, k: usize) -> bool;

    /// The term's column of pair `k`; what is left here is written back.
    fn column(&mut self, k: usize) -> &mut C;
}

impl<C> Visits<C> for Vec<Visit<C>> {
    fn count(&self) -> usize {
        self.len()
    }

    fn encounter(&self, k: usize) -> Encounter {
        self[k].encounter
    }

    fn ends(&self, k: usize) -> bool {
        self[k].ending
    }

    fn column(&mut self, k: usize) -> &mut C {
        &mut self[k].column
    }
}

/// The columns of one of two terms.
impl<A, B, V: Visits<(A, B)>> Visits<A> for Part<'_, V, First<B>> {
    fn count(&self) -> usize {
        self.whole.count()
    }

    fn encounter(&self, k: usize) -> Encounter {
        self.whole.encounter(k)
    }

    fn ends(&self, k: usize) -> bool {
        self.whole.ends(k)
    }

    fn column(&mut self, k: usize) -> &mut A {
        &mut self.whole.column(k).0
    }
}

/// The columns of the other of two terms.
impl<A, B, V: Visits<(A, B)>> Visits<B> for Part<'_, V, Second<A>> {
    fn count(&self) -> usize {
        self.whole.count()
    }

    fn encounter(&self, k: usize) -> Encounter {
        self.whole.encounter(k)
    }

    fn ends(&self, k: usize) -> bool {
        self.whole.ends(k)
    }

    fn column(&mut self, k: usize) -> &mut B {
        &mut self.whole.column(k).1
    }
}

/// A pair that asked for attention, or is about to end.
#[derive(Debug, Clone, Copy)]
pub struct Visit<C> {
    /// The pair as it was read.
    pub encounter: Encounter,
    /// The term's column of the pair; what is left here is written back.
    pub column: C,
    /// The pair ends after this visit: a body leaves the scene, or a wall part is taken away.
    pub ending: bool,
}

/// One kind of interaction of two bodies: a contact, a bridge, both as a tuple, or `()`.
///
/// A term keeps its history of a pair in a *column* that travels with the pair. The read half may
/// change only that column; what pairs share changes in [`PairTerm::settle`].
pub trait PairTerm: Send + Sync {
    /// What the term remembers of one pair. The default is "nothing yet".
    type Column: Copy + Default + Send + Sync;

    /// Largest gap, m, at which a pair without history may act. May change from step to step.
    fn reach(&self) -> f64;

    /// Whether nothing acts in this pair; an idle pair's column is brought to rest here.
    fn idle(&self, encounter: &Encounter, column: &mut Self::Column) -> bool;

    /// Read half: what acts in this pair. Pure but for the pair's own column.
    fn load(&self, pair: &Pair, column: &mut Self::Column) -> Load;

    /// Whether [`PairTerm::load_lanes`] does more than call [`PairTerm::load`] for each pair, so that
    /// it pays to bring pairs to it several at a time.
    const LANES: bool = false;

    /// Whether something acts in every pair in overlap: then [`PairTerm::idle`] is not asked of such
    /// pairs, not of the terms beside this one either.
    const ACTS_IN_OVERLAP: bool = false;

    /// Whether a load can have a couple.
    const COUPLES: bool = true;

    /// Read half for particles, several pairs side by side: to the bit what [`PairTerm::load`] gives
    /// for each of them. Either all of them touch or all are apart ([`Pairs::apart`]).
    #[inline(always)]
    fn load_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
    ) -> Loads<L> {
        Loads::pack(pairs.permit, &L::each(|k| self.load(&pairs.pair(k), columns.column(k))))
    }

    /// Whether the term is not there at all, so that nothing needs to be asked of it or added.
    fn is_absent(&self) -> bool {
        false
    }

    /// Whether the column must not be lost, whatever the gap.
    fn live(&self, column: &Self::Column) -> bool;

    /// Whether [`PairTerm::settle`] does anything.
    const SETTLES: bool = true;

    /// Write half: settles all pairs that asked for attention, in the order of their keys.
    ///
    /// # Errors
    /// Whatever the term cannot do; the simulation stops with it.
    fn settle(&mut self, visits: &mut impl Visits<Self::Column>) -> Result<(), TermError> {
        let _ = visits;
        Ok(())
    }

    /// Brings what the term keeps of each pair outside the column into the order in which the pairs
    /// are read: `each` calls what it is given with all columns in that order, with both copies of a
    /// pair that stands in two lists. Called now and then; changes nothing but the speed.
    fn arrange(&mut self, each: &mut EachColumn<'_, Self::Column>) {
        let _ = each;
    }

    /// Does what [`PairTerm::settle`] has left to be done once the visits are written back, so that
    /// not both take memory at the same time. A term that wraps another hands this on.
    ///
    /// # Errors
    /// As [`PairTerm::settle`].
    fn finish(&mut self) -> Result<(), TermError> {
        Ok(())
    }

    /// Moves to the particle's nearest touch with a wall part what belongs to the part as a whole.
    fn hand_on(&self, from: &mut Self::Column, to: &mut Self::Column) {
        let _ = (from, to);
    }

    /// Whether what resists is solved for at the end of the step: only [`crate::Implicit`] does.
    const IMPLICIT: bool = false;

    /// From now on loads leave out what [`PairTerm::resist`] gives.
    fn leave_resistance(&mut self) {}

    /// What resists motion in this pair, with drags at `gap` m and contacts at the encounter's.
    fn resist(&self, pair: &Pair, column: &Self::Column, gap: f64) -> Resist {
        let _ = (pair, column, gap);
        Resist::default()
    }

    /// The same of several pairs side by side: to the bit what [`PairTerm::resist`] gives for each.
    #[inline(always)]
    fn resist_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
        gap: L,
    ) -> Resist<L> {
        let gaps = gap.unpack();
        let one = |k| self.resist(&pairs.pair(k), columns.column(k), gaps[k]);
        Resist::pack(pairs.permit, &L::each(one))
    }

    /// The impulse of the drag along the line of centres over a slow change of the gap from 0 to
    /// `gap` m, N s, and the drag there, N s/m.
    fn charge(&self, column: &Self::Column, gap: f64) -> [f64; 2] {
        let _ = (column, gap);
        [0.0; 2]
    }

    /// What the column remembers of the last step's resistance.
    fn impulse<'a>(&self, column: &'a mut Self::Column) -> Option<&'a mut Impulse> {
        let _ = column;
        None
    }

    /// Whether the term uses rolling friction, so that the core keeps what that needs.
    fn rolls(&self) -> bool {
        false
    }

    /// How many wall materials the term has laws for; `None` for any number.
    fn wall_materials(&self) -> Option<usize> {
        None
    }

    /// The stiffest and most viscous pair that each class can be part of.
    fn stability(&self, classes: &[Class]) -> Vec<limit::Load>;

    /// What this pair, as it is now, adds to the sums of the stability limit.
    fn load_on_limit(&self, pair: &Pair, column: &Self::Column) -> limit::Load {
        let _ = (pair, column);
        limit::Load::default()
    }
}

/// No interaction at all.
impl PairTerm for () {
    type Column = ();
    const SETTLES: bool = false;

    fn reach(&self) -> f64 {
        0.0
    }

    fn idle(&self, _: &Encounter, (): &mut ()) -> bool {
        true
    }

    fn load(&self, _: &Pair, (): &mut ()) -> Load {
        Load::default()
    }

    fn live(&self, (): &()) -> bool {
        false
    }

    fn stability(&self, classes: &[Class]) -> Vec<limit::Load> {
        vec![limit::Load::default(); classes.len()]
    }
}

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

    fn finish(&mut self) -> Result<(), TermError> {
        self.0.finish()?;
        self.1.finish()
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

    fn finish(&mut self) -> Result<(), TermError> {
        self.as_mut().map_or(Ok(()), T::finish)
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
