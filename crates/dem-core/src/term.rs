use crate::lane::Lane;
use crate::limit;
use crate::pairs::{Columns, Loads, Pairs};
use crate::visits::Visits;
use crate::{Class, Encounter, Impulse, Load, Pair, Resist};

/// Any error of a term.
pub type TermError = Box<dyn std::error::Error + Send + Sync>;

/// Calls what it is given with every column of a term.
pub type EachColumn<'a, C> = dyn FnMut(&mut dyn FnMut(&mut C)) + 'a;

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

    /// Moves to the particle's nearest touch with a wall part what belongs to the part as a whole.
    fn hand_on(&self, from: &mut Self::Column, to: &mut Self::Column) {
        let _ = (from, to);
    }

    /// Whether what resists is solved for at the end of the step: only [`crate::Implicit`] does, also
    /// as an optional term.
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
