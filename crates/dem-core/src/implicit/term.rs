use super::{Impulse, Resist};
use crate::lane::Lane;
use crate::limit;
use crate::pairs::{Columns, First, Loads, Pairs, Part};
use crate::{Class, EachColumn, Encounter, Load, Pair, PairTerm, TermError, Visits};

/// A term whose dashpots, drags and rolling friction are solved for at the end of the step.
///
/// Taken from the start of the step, a drag allows a step of h < 2 m/c only, in inverse proportion
/// to the viscosity. Here an impulse per pair is sought that fits the velocities *after* it, for all
/// pairs together, so that the step is limited by the springs alone. What the drag takes over a
/// step is its integral over the gap that was travelled, so that m* v + G(S) is kept to 1e-6,
/// however fast a thin film closes.
///
/// It costs a column of 48 bytes a pair, and one pass over all pairs or more. Terms hand over what
/// they give in [`PairTerm::resist`].
///
/// # Sources
/// Splitting for dissipative pairs: Shardlow (2003), SIAM J. Sci. Comput. 24, 1267; Leimkuhler &
/// Shang (2015), J. Comput. Phys. 280, 72. Passes over pairs with accumulated impulses: Jean
/// (1999), Comput. Methods Appl. Mech. Eng. 177, 235 (contact dynamics).
#[derive(Debug)]
pub struct Implicit<T>(T);

impl<T: PairTerm> Implicit<T> {
    /// The same term; its loads leave out what it resists with.
    pub fn new(mut term: T) -> Self {
        term.leave_resistance();
        Self(term)
    }

    /// The term itself.
    pub fn inner(&self) -> &T {
        &self.0
    }

    /// The term itself, to be changed between steps.
    pub fn inner_mut(&mut self) -> &mut T {
        &mut self.0
    }
}

impl<T: PairTerm> PairTerm for Implicit<T> {
    type Column = (T::Column, Impulse);

    fn reach(&self) -> f64 {
        self.0.reach()
    }

    #[inline(always)]
    fn idle(&self, encounter: &Encounter, column: &mut Self::Column) -> bool {
        let idle = self.0.idle(encounter, &mut column.0);
        if idle && column.1.charged.is_finite() {
            column.1 = Impulse::NONE;
        }
        idle
    }

    const LANES: bool = T::LANES;
    const COUPLES: bool = T::COUPLES;
    const SETTLES: bool = T::SETTLES;
    const ACTS_IN_OVERLAP: bool = T::ACTS_IN_OVERLAP;
    const IMPLICIT: bool = true;

    #[inline(always)]
    fn load(&self, pair: &Pair, column: &mut Self::Column) -> Load {
        self.0.load(pair, &mut column.0)
    }

    #[inline(always)]
    fn load_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
    ) -> Loads<L> {
        self.0.load_lanes(pairs, &mut Part::<_, First<Impulse>>::of(columns))
    }

    #[inline(always)]
    fn live(&self, column: &Self::Column) -> bool {
        self.0.live(&column.0) || column.1.charged.is_finite()
    }

    fn settle(&mut self, visits: &mut impl Visits<Self::Column>) -> Result<(), TermError> {
        self.0.settle(&mut Part::<_, First<Impulse>>::of(visits))
    }

    fn arrange(&mut self, each: &mut EachColumn<'_, Self::Column>) {
        self.0.arrange(&mut |see| each(&mut |column| see(&mut column.0)));
    }

    fn hand_on(&self, from: &mut Self::Column, to: &mut Self::Column) {
        self.0.hand_on(&mut from.0, &mut to.0);
    }

    fn wall_materials(&self) -> Option<usize> {
        self.0.wall_materials()
    }

    fn stability(&self, classes: &[Class]) -> Vec<limit::Load> {
        self.0.stability(classes).into_iter().map(limit::Load::resisted_implicitly).collect()
    }

    fn load_on_limit(&self, pair: &Pair, column: &Self::Column) -> limit::Load {
        self.0.load_on_limit(pair, &column.0).resisted_implicitly()
    }

    #[inline(always)]
    fn resist(&self, pair: &Pair, column: &Self::Column, gap: f64) -> Resist {
        self.0.resist(pair, &column.0, gap)
    }

    #[inline(always)]
    fn resist_lanes<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Self::Column>,
        gap: L,
    ) -> Resist<L> {
        self.0.resist_lanes(pairs, &mut Part::<_, First<Impulse>>::of(columns), gap)
    }

    fn charge(&self, column: &Self::Column, gap: f64) -> [f64; 2] {
        self.0.charge(&column.0, gap)
    }

    fn impulse<'a>(&self, column: &'a mut Self::Column) -> Option<&'a mut Impulse> {
        Some(&mut column.1)
    }
}
