//! Where the forces of the live bridges are kept: outside the lists of the pairs, which every step
//! goes through, and in their order.

use pendular_capillary::ForceCurve;
use pendular_dem_core::{Columns, EachColumn, Lane, Pairs, Resist};
use pendular_lubrication::{NormalCurve, TangentialCurve};

use super::act::{Pull, Pulls};
use super::kinds::{Kind, Kinds};
use crate::room::make_room;

/// No bridge.
const DRY: u32 = u32::MAX;

/// What a pair remembers of its bridge.
#[derive(Debug, Clone, Copy)]
pub struct Hold {
    bridge: u32,
    /// Where on the shelf its forces are.
    seat: u32,
}

impl Hold {
    pub(super) fn new(bridge: u32, seat: u32) -> Self {
        Self { bridge, seat }
    }

    /// A bridge that is to form; it has no seat yet.
    pub(super) fn forming(bridge: u32) -> Self {
        Self { bridge, seat: DRY }
    }

    /// The account of a bridge that is to form.
    pub(super) fn forms(&self) -> Option<u32> {
        self.bridge().filter(|_| self.seat == DRY)
    }

    /// The account of a bridge that has its seat and is to go.
    pub(super) fn ruptures(&self) -> Option<u32> {
        self.bridge().filter(|_| self.seat != DRY)
    }

    /// Number of the pair's bridge account, if it has a bridge.
    #[must_use]
    #[inline(always)]
    pub fn bridge(&self) -> Option<u32> {
        (self.bridge != DRY).then_some(self.bridge)
    }
}

impl Default for Hold {
    fn default() -> Self {
        Self { bridge: DRY, seat: DRY }
    }
}

/// Where the forces are kept is no part of what is remembered.
impl PartialEq for Hold {
    fn eq(&self, other: &Self) -> bool {
        self.bridge == other.bridge
    }
}

/// What acts in an open gap.
#[derive(Debug, Clone, Copy)]
pub(super) struct Far<C, N, S> {
    /// Static rupture distance, m.
    pub(super) rupture: f64,
    pub(super) curves: (C, N, S),
}

/// The part of [`Far`] that each bridge has for itself.
#[derive(Debug, Clone, Copy)]
pub(super) struct Own<C, N> {
    rupture: f64,
    pub(super) capillary: C,
    pub(super) normal: N,
}

/// What a bridge has for itself, as it lies on the shelf, and its kind.
type WithKind<'a, T, S> = (&'a T, &'a Kind<S>);

/// What acts in an open gap.
pub(super) type Open<'a, C, N, S> = WithKind<'a, Own<C, N>, S>;

/// The forces of all live bridges by their seats. In overlap only those at contact are looked at.
pub(super) struct Shelf<C, N, S> {
    /// Tension (N) and drag along the line of centres (N s/m) at contact.
    contact: Vec<[f64; 2]>,
    own: Vec<Own<C, N>>,
    /// The kind of each bridge.
    kind: Vec<u32>,
    kinds: Kinds<S>,
    free: Vec<u32>,
    /// Seats given out, taken or free.
    seats: u32,
}

impl<C, N, S> Default for Shelf<C, N, S> {
    fn default() -> Self {
        Self {
            contact: Vec::new(),
            own: Vec::new(),
            kind: Vec::new(),
            kinds: Kinds::default(),
            free: Vec::new(),
            seats: 0,
        }
    }
}

impl<C: ForceCurve, N: NormalCurve, S: TangentialCurve> Shelf<C, N, S> {
    /// A seat for a new bridge.
    pub(super) fn seat(&mut self) -> u32 {
        self.free.pop().unwrap_or_else(|| {
            self.seats += 1;
            self.seats - 1
        })
    }

    /// Puts there what acts in the bridge; new seats are taken in their order.
    pub(super) fn put(&mut self, seat: u32, Far { rupture, curves }: Far<C, N, S>) {
        let contact = Pull::contact(&curves);
        let (capillary, normal, tangential) = curves;
        let kind = self.kinds.number(Kind::new(tangential, contact.as_ref()));
        let contact = contact.map_or([0.0; 2], |pull| pull.own());
        let own = Own { rupture, capillary, normal };
        let seat = seat as usize;
        if seat < self.own.len() {
            (self.contact[seat], self.own[seat], self.kind[seat]) = (contact, own, kind);
        } else {
            self.contact.push(contact);
            self.own.push(own);
            self.kind.push(kind);
        }
    }

    /// Makes room for so many more bridges.
    pub(super) fn reserve(&mut self, bridges: usize) {
        let more = bridges.saturating_sub(self.free.len());
        make_room(&mut self.contact, more);
        make_room(&mut self.own, more);
        make_room(&mut self.kind, more);
    }

    /// The seat is free again.
    pub(super) fn leave(&mut self, seat: u32) {
        self.free.push(seat);
    }

    /// The forces of pairs side by side, all apart or all in overlap; `None` if any has no bridge or
    /// is beyond its static rupture distance.
    #[inline(always)]
    pub(super) fn pulls<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Hold>,
    ) -> Option<Pulls<L>> {
        let seats = L::each(|k| columns.column(k).seat as usize);
        let gap = pairs.geometry.gap;
        if pairs.apart { self.apart(&seats, gap) } else { self.overlapping(&seats, gap) }
    }

    /// What resists in pairs side by side; `None` if any has no bridge, or if only some gaps are
    /// open.
    #[inline(always)]
    pub(super) fn resist<L: Lane>(
        &self,
        columns: &mut impl Columns<Hold>,
        gap: L,
    ) -> Option<Resist<L>> {
        let permit = gap.permit();
        let seats = L::each(|k| columns.column(k).seat as usize);
        let closed = gap.less_bits(L::splat(permit, 0.0));
        if closed == 0 {
            let open = self.all_open::<L>(&seats)?;
            let clearance = N::clearances(&L::each(|k| &open[k].0.normal), gap);
            return Some(Pulls::apart(&open, gap).resist(clearance));
        }
        let (pulls, fade) = self.at_contact(&seats, gap)?;
        // A drag that does not fade tells nothing of how soon it changes once the gap opens.
        if L::splat(permit, 0.0).less_bits(fade).count_ones() as usize != L::WIDTH {
            return None;
        }
        let clearance = L::splat(permit, 1.0) / fade;
        (closed.count_ones() as usize == L::WIDTH).then(|| pulls.resist(clearance))
    }

    /// The same of one pair; nothing without a bridge.
    #[inline]
    pub(super) fn resist_one(&self, hold: &Hold, gap: f64) -> Resist {
        let known = self.resist::<f64>(&mut &mut hold.clone(), gap);
        let beyond = |far: Far<C, N, S>| {
            Pulls::pack((), &[Pull::at(&far.curves, gap)]).resist(far.curves.1.clearance(gap))
        };
        known.or_else(|| self.held(hold).map(beyond)).unwrap_or_default()
    }

    /// Capillary tension alone, as in [`Shelf::pulls`].
    #[inline(always)]
    pub(super) fn tensions<L: Lane>(
        &self,
        pairs: &Pairs<'_, L>,
        columns: &mut impl Columns<Hold>,
    ) -> Option<L> {
        let (permit, gap) = (pairs.permit, pairs.geometry.gap);
        let seats = L::each(|k| columns.column(k).seat as usize);
        if pairs.apart {
            let open = self.all_open::<L>(&seats)?;
            let rupture = L::pack(permit, &open, |open| open.0.rupture);
            let curves = L::each(|k| &open[k].0.capillary);
            return (!rupture.any_less(gap)).then(|| C::forces(&curves, gap));
        }
        let rows = self.all_contact::<L>(&seats)?;
        let tension = L::pack(permit, &rows, |(own, _)| own[0]);
        let fade = L::pack(permit, &rows, |(_, kind)| kind.contact[1]);
        (!L::splat(permit, 0.0).any_less(gap * fade)).then_some(tension)
    }

    #[inline(always)]
    fn overlapping<L: Lane>(&self, seats: &L::Each<usize>, gap: L) -> Option<Pulls<L>> {
        self.at_contact(seats, gap).map(|(pulls, _)| pulls)
    }

    /// The forces in overlap by those at contact, and how the drags fade, 1/m.
    #[inline(always)]
    fn at_contact<L: Lane>(&self, seats: &L::Each<usize>, gap: L) -> Option<(Pulls<L>, L)> {
        let permit = gap.permit();
        let rows = self.all_contact::<L>(seats)?;
        let zero = L::splat(permit, 0.0);
        let row = |&([tension, drag], kind): &WithKind<'_, [f64; 2], S>| {
            [*tension, *drag, kind.contact[0], kind.contact[1]]
        };
        let [tension, drag, slip, fade] = L::rows(permit, &rows, row);
        let exponent = gap * fade;
        if zero.any_less(exponent) {
            return None;
        }
        let mut turning = [zero; 2];
        if self.kinds.turn {
            turning[0] = L::pack(permit, &rows, |(_, kind)| kind.turning[0]);
            turning[1] = L::pack(permit, &rows, |(_, kind)| kind.turning[1]);
        }
        Some((Pulls::faded([tension, drag, slip], turning, exponent), fade))
    }

    #[inline(always)]
    fn apart<L: Lane>(&self, seats: &L::Each<usize>, gap: L) -> Option<Pulls<L>> {
        let open = self.all_open::<L>(seats)?;
        if L::pack(gap.permit(), &open, |(own, _)| own.rupture).any_less(gap) {
            return None;
        }
        Some(Pulls::apart(&open, gap))
    }

    #[inline(always)]
    fn all_contact<L: Lane>(
        &self,
        seats: &L::Each<usize>,
    ) -> Option<L::Each<WithKind<'_, [f64; 2], S>>> {
        self.with_kinds::<L, _>(&self.contact, seats)
    }

    #[inline(always)]
    fn all_open<L: Lane>(&self, seats: &L::Each<usize>) -> Option<L::Each<Open<'_, C, N, S>>> {
        self.with_kinds::<L, _>(&self.own, seats)
    }

    /// What a column has at some seats, with the kinds; `None` if any has no bridge.
    #[inline(always)]
    fn with_kinds<'a, L: Lane, T>(
        &'a self,
        column: &'a [T],
        seats: &L::Each<usize>,
    ) -> Option<L::Each<WithKind<'a, T, S>>> {
        // As long as the column, so that a seat is checked once.
        let kinds = self.kind.get(..column.len())?;
        let at = |seat: usize| Some((column.get(seat)?, self.kinds.get(kinds[seat])?));
        let first = at(seats[0])?;
        let mut all = L::each(|_| first);
        for k in 1..L::WIDTH {
            all[k] = at(seats[k])?;
        }
        Some(all)
    }

    /// The forces of one pair; `None` without a bridge or beyond its static rupture distance.
    pub(super) fn pull(&self, hold: &Hold, gap: f64) -> Option<Pulls<f64>> {
        if gap < 0.0 {
            let overlapping = self.overlapping(&[hold.seat as usize], gap);
            if overlapping.is_some() {
                return overlapping;
            }
        }
        let far = self.held(hold)?;
        (gap <= far.rupture).then(|| Pulls::pack((), &[Pull::at(&far.curves, gap)]))
    }

    /// The drag's impulse from contact to a gap, N s, and the drag there, N s/m. In overlap the
    /// drag fades, where it does, by that at contact.
    pub(super) fn charge(&self, hold: &Hold, gap: f64) -> [f64; 2] {
        let seat = [hold.seat as usize];
        if gap < 0.0
            && let Some([([_, drag], kind)]) = self.all_contact::<f64>(&seat)
            && kind.contact[1] > 0.0
            && kind.contact[1] < f64::INFINITY
        {
            let fade = kind.contact[1];
            let less = (gap * fade).exp_m1();
            return [drag / fade * less, drag * (1.0 + less)];
        }
        self.all_open::<f64>(&seat).map_or([0.0; 2], |[(own, _)]| own.normal.charge(gap))
    }

    /// What is kept of a pair's bridge.
    #[inline]
    pub(super) fn held(&self, hold: &Hold) -> Option<Far<C, N, S>> {
        self.far(hold.seat)
    }

    /// What is kept at a seat.
    #[inline]
    pub(super) fn far(&self, seat: u32) -> Option<Far<C, N, S>> {
        let [(own, kind)] = self.all_open::<f64>(&[seat as usize])?;
        let Own { rupture, capillary, normal } = *own;
        Some(Far { rupture, curves: (capillary, normal, kind.tangential) })
    }

    /// The forces of one pair by the curves at whatever gap; `None` without a bridge.
    pub(super) fn beyond(&self, hold: &Hold, gap: f64) -> Option<Pulls<f64>> {
        let far = self.held(hold)?;
        Some(Pulls::pack((), &[Pull::at(&far.curves, gap)]))
    }

    /// Static rupture distance, m.
    pub(super) fn rupture(&self, hold: &Hold) -> Option<f64> {
        self.own.get(hold.seat as usize).map(|own| own.rupture)
    }

    /// Gives out all seats anew, in the order in which `each` goes through the pairs; returns the
    /// new seats by bridge.
    pub(super) fn arrange(&mut self, bridges: usize, each: &mut EachColumn<'_, Hold>) -> Vec<u32> {
        let mut seats = vec![DRY; bridges];
        let mut order = Vec::with_capacity(self.own.len());
        let mut taken = vec![false; self.own.len()];
        each(&mut |hold| {
            let Some(seat) = seats.get_mut(hold.bridge as usize) else { return };
            // A pair may stand in two lists.
            if *seat == DRY {
                *seat = order.len() as u32;
                order.push(hold.seat);
                taken[hold.seat as usize] = true;
            }
            hold.seat = *seat;
        });
        let live = order.len();
        order.extend((0..taken.len() as u32).filter(|&seat| !taken[seat as usize]));
        for new in 0..live {
            // What was there has been moved on, maybe several times.
            let mut old = order[new] as usize;
            while old < new {
                old = order[old] as usize;
            }
            self.contact.swap(new, old);
            self.own.swap(new, old);
            self.kind.swap(new, old);
        }
        self.contact.truncate(live);
        self.own.truncate(live);
        self.kind.truncate(live);
        self.kinds.keep(&mut self.kind);
        self.free.clear();
        self.seats = live as u32;
        seats
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pendular_capillary::{CapillaryLaw, Lambert2008};
    use pendular_lubrication::{
        AdamsPerchard1985, Gap, NormalDrag, Overlap, Popov2010, Regularisation, TangentialDrag,
    };
    use pendular_pair::{Bridge, Mate, Range};

    /// A pair whose gap opens is linear within a small share of its clearance. In overlap that once
    /// was infinite for a drag that stays as it is: leaving a contact cost too much momentum.
    #[test]
    fn a_drag_in_overlap_has_the_clearance_of_contact() {
        let bridge = Bridge::new(2e-3, Mate::PLANE, 1e-10, [0.0; 2], 0.07).unwrap();
        for overlap in [Overlap::Fade, Overlap::Full] {
            let near = Regularisation { gap: Gap::Roughness { length: 2e-6 }, overlap };
            let curves = (
                Lambert2008.curve(&bridge, Range::Strict).unwrap(),
                AdamsPerchard1985 { near }.curve(&bridge, 0.1).unwrap(),
                Popov2010 { near }.curve(&bridge, 0.1).unwrap(),
            );
            let mut shelf = Shelf::default();
            let seat = shelf.seat();
            shelf.put(seat, Far { rupture: 1e-4, curves });
            for gap in [-1e-6, -1e-9, 0.0] {
                let resist = shelf.resist_one(&Hold::new(0, seat), gap);
                assert!((resist.clearance / 2e-6 - 1.0).abs() < 1e-12, "{overlap:?}: {resist:?}");
                let drag = curves.1.coefficient(gap);
                assert!((resist.drag / drag - 1.0).abs() < 1e-12, "{overlap:?}: {resist:?}");
            }
        }
    }
}
