//! Where the forces of the live bridges are kept: outside the lists of the pairs, which every step
//! goes through, and in their order.

use pendular_capillary::ForceCurve;
use pendular_dem_core::{Columns, EachColumn, Lane, Pairs, Resist};
use pendular_lubrication::{NormalCurve, TangentialCurve};

use super::act::{Pull, Pulls, Row};

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

/// The forces of all live bridges by their seats. In overlap only those at contact are looked at.
pub(super) struct Shelf<C, N, S> {
    contact: Vec<Row>,
    /// The other part of `contact`: none unless a bridge has such.
    turning: Vec<[f64; 2]>,
    far: Vec<Far<C, N, S>>,
    free: Vec<u32>,
    /// Seats given out, taken or free.
    seats: u32,
}

impl<C, N, S> Default for Shelf<C, N, S> {
    fn default() -> Self {
        let (contact, turning, far, free) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { contact, turning, far, free, seats: 0 }
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
    pub(super) fn put(&mut self, seat: u32, far: Far<C, N, S>) {
        let contact = Pull::contact(&far.curves);
        let turning = contact.map_or([0.0; 2], |pull| pull.turning());
        let contact = contact.map_or(Row::UNKNOWN, |pull| pull.row());
        let seat = seat as usize;
        if seat < self.far.len() {
            (self.contact[seat], self.far[seat]) = (contact, far);
        } else {
            self.contact.push(contact);
            self.far.push(far);
        }
        if turning != [0.0; 2] || !self.turning.is_empty() {
            self.turning.resize(self.far.len(), [0.0; 2]);
            self.turning[seat] = turning;
        }
    }

    /// Makes room for so many more bridges.
    pub(super) fn reserve(&mut self, bridges: usize) {
        let more = bridges.saturating_sub(self.free.len());
        self.contact.reserve(more);
        self.far.reserve(more);
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
            let far = self.all_far::<L>(&seats)?;
            let clearance = N::clearances(&L::each(|k| &far[k].curves.1), gap);
            return Some(Pulls::apart(&far, gap).resist(clearance));
        }
        let (pulls, fade) = self.at_contact(&seats, gap)?;
        let clearance = L::splat(permit, 1.0) / fade;
        (closed.count_ones() as usize == L::WIDTH).then(|| pulls.resist(clearance))
    }

    /// The same of one pair; nothing without a bridge.
    #[inline]
    pub(super) fn resist_one(&self, hold: &Hold, gap: f64) -> Resist {
        let known = self.resist::<f64>(&mut &mut hold.clone(), gap);
        let beyond = |far: &Far<C, N, S>| {
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
            let far = self.all_far::<L>(&seats)?;
            let rupture = L::pack(permit, &far, |far| far.rupture);
            let curves = L::each(|k| &far[k].curves.0);
            return (!rupture.any_less(gap)).then(|| C::forces(&curves, gap));
        }
        let rows = self.all_contact::<L>(&seats)?;
        let [tension, _, _, fade] = L::rows(permit, &rows, |row| row.0);
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
        let [tension, drag, slip, fade] = L::rows(permit, &rows, |row| row.0);
        let exponent = gap * fade;
        if zero.any_less(exponent) {
            return None;
        }
        let mut turning = [zero; 2];
        if !self.turning.is_empty() {
            let of = |k: usize| self.turning.get(seats[k]).copied().unwrap_or_default();
            let each = L::each(of);
            turning = [0, 1].map(|side: usize| L::pack(permit, &each, |one| one[side]));
        }
        Some((Pulls::faded([tension, drag, slip], turning, exponent), fade))
    }

    #[inline(always)]
    fn apart<L: Lane>(&self, seats: &L::Each<usize>, gap: L) -> Option<Pulls<L>> {
        let far = self.all_far::<L>(seats)?;
        if L::pack(gap.permit(), &far, |far| far.rupture).any_less(gap) {
            return None;
        }
        Some(Pulls::apart(&far, gap))
    }

    #[inline(always)]
    fn all_contact<L: Lane>(&self, seats: &L::Each<usize>) -> Option<L::Each<&Row>> {
        let first = self.contact.get(seats[0])?;
        let mut rows = L::each(|_| first);
        for k in 1..L::WIDTH {
            rows[k] = self.contact.get(seats[k])?;
        }
        Some(rows)
    }

    #[inline(always)]
    fn all_far<L: Lane>(&self, seats: &L::Each<usize>) -> Option<L::Each<&Far<C, N, S>>> {
        let first = self.far.get(seats[0])?;
        let mut far = L::each(|_| first);
        for k in 1..L::WIDTH {
            far[k] = self.far.get(seats[k])?;
        }
        Some(far)
    }

    /// The forces of one pair; `None` without a bridge or beyond its static rupture distance.
    pub(super) fn pull(&self, hold: &Hold, gap: f64) -> Option<Pulls<f64>> {
        let seat = hold.seat as usize;
        if gap < 0.0 {
            let overlapping = self.overlapping(&[seat], gap);
            if overlapping.is_some() {
                return overlapping;
            }
        }
        let far = self.far.get(seat)?;
        (gap <= far.rupture).then(|| Pulls::pack((), &[Pull::at(&far.curves, gap)]))
    }

    /// The drag's impulse from contact to a gap, N s, and the drag there, N s/m. In overlap the
    /// drag fades, where it does, by that at contact.
    pub(super) fn charge(&self, hold: &Hold, gap: f64) -> [f64; 2] {
        let seat = hold.seat as usize;
        if gap < 0.0
            && let Some(&Row([_, drag, _, fade])) = self.contact.get(seat)
            && fade > 0.0
            && fade < f64::INFINITY
        {
            let less = (gap * fade).exp_m1();
            return [drag / fade * less, drag * (1.0 + less)];
        }
        self.far.get(seat).map_or([0.0; 2], |far| far.curves.1.charge(gap))
    }

    /// What is kept of a pair's bridge.
    #[inline]
    pub(super) fn held(&self, hold: &Hold) -> Option<&Far<C, N, S>> {
        self.far.get(hold.seat as usize)
    }

    /// What is kept at a seat.
    pub(super) fn far(&self, seat: u32) -> Option<&Far<C, N, S>> {
        self.far.get(seat as usize)
    }

    /// The forces of one pair by the curves at whatever gap; `None` without a bridge.
    pub(super) fn beyond(&self, hold: &Hold, gap: f64) -> Option<Pulls<f64>> {
        let far = self.far.get(hold.seat as usize)?;
        Some(Pulls::pack((), &[Pull::at(&far.curves, gap)]))
    }

    /// Static rupture distance, m.
    pub(super) fn rupture(&self, hold: &Hold) -> Option<f64> {
        self.far.get(hold.seat as usize).map(|far| far.rupture)
    }

    /// Gives out all seats anew, in the order in which `each` goes through the pairs; returns the
    /// new seats by bridge.
    pub(super) fn arrange(&mut self, bridges: usize, each: &mut EachColumn<'_, Hold>) -> Vec<u32> {
        let mut seats = vec![DRY; bridges];
        let mut order = Vec::with_capacity(self.far.len());
        let mut taken = vec![false; self.far.len()];
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
            self.far.swap(new, old);
            if !self.turning.is_empty() {
                self.turning.swap(new, old);
            }
        }
        self.contact.truncate(live);
        self.turning.truncate(live);
        self.far.truncate(live);
        self.free.clear();
        self.seats = live as u32;
        seats
    }
}
