//! Pairs that act: what acts in them, several side by side, several blocks of them at a time.

use std::ops::Range;

use crate::PairTerm;
use crate::Resist;
use crate::chunk::{List, Note, Roll, Sum};
use crate::implicit::{Colours, Impulse, Inverse, Links, Met, Remembered};
use crate::lane::{Lane, Vector};
use crate::lists::Entry;
use crate::pairs::{Columns, Geometry, Loads, Pairs, Picked};
use crate::pass::roll;
use crate::view::View;

/// Blocks that are worked on at a time: few enough to stay near.
const BLOCKS: usize = 8;

/// What all pairs of a chunk are loaded with.
pub(crate) struct Pass<'a, T, L: Lane> {
    pub(crate) permit: L::Permit,
    pub(crate) view: &'a View<'a>,
    pub(crate) term: &'a T,
}

/// The active pairs of a list and as many columns.
pub(crate) struct Listed<'a, C> {
    pub(crate) which: List,
    pub(crate) active: &'a [Entry],
    pub(crate) columns: &'a mut [C],
}

/// Where a chunk's loads go.
pub(crate) struct Out<'a> {
    pub(crate) range: &'a Range<u32>,
    pub(crate) sums: &'a mut [Sum],
    pub(crate) rolls: &'a mut [Roll],
    pub(crate) notes: &'a mut Vec<Note>,
    pub(crate) apart: &'a mut Vec<u32>,
    pub(crate) overlap: &'a mut f64,
    pub(crate) colours: &'a mut Colours,
    /// Where an implicit term keeps the pairs that act: inside, and across the border.
    pub(crate) links: [&'a mut Links; 2],
    /// What the impulses do that the pairs inside remember.
    pub(crate) pushed: &'a mut [Sum],
}

/// Where and how some blocks of pairs are and what acts in them.
///
/// The numbers of a block wait long for roots and quotients. A processor fills that time with the
/// next blocks only while the work on one is short, so each part of the work is done for several
/// blocks before the next part.
pub(crate) struct Stage<L> {
    geometry: [Geometry<L>; BLOCKS],
    loads: [Loads<L>; BLOCKS],
    resist: [Resist<L>; BLOCKS],
    remembered: [Remembered<L>; BLOCKS],
}

impl<L: Lane> Stage<L> {
    #[inline(always)]
    pub(crate) fn new(permit: L::Permit) -> Self {
        Self {
            geometry: [Geometry::none(permit); BLOCKS],
            loads: [Loads::none(permit); BLOCKS],
            resist: [Resist::none(permit); BLOCKS],
            remembered: [Remembered::pack(permit, |_| Impulse::NONE); BLOCKS],
        }
    }
}

/// Loads pairs that act, as many as fill some blocks.
#[inline(always)]
pub(crate) fn load<T, L, const APART: bool>(
    pass: &Pass<'_, T, L>,
    list: &mut Listed<'_, T::Column>,
    acting: &[u32],
    stage: &mut Stage<L>,
    out: &mut Out<'_>,
) where
    T: PairTerm,
    L: Lane,
{
    let (permit, view) = (pass.permit, pass.view);
    let inside = list.which == List::Inside;
    let rolls = view.rolls();
    for acting in acting.chunks(BLOCKS * L::WIDTH) {
        let blocks = acting.chunks_exact(L::WIDTH);
        for (at, geometry) in blocks.clone().zip(&mut stage.geometry) {
            let entries = L::each(|k| list.active[at[k] as usize]);
            *geometry = view.geometry::<L>(permit, &entries);
        }
        for ((at, geometry), loads) in blocks.clone().zip(&stage.geometry).zip(&mut stage.loads) {
            let entries = L::each(|k| list.active[at[k] as usize]);
            let pairs = Pairs { view, entries, apart: APART, permit, geometry };
            *loads = pass.term.load_lanes(&pairs, &mut Picked { columns: list.columns, at });
        }
        if T::IMPLICIT {
            meet::<T, L, APART>(pass, list, acting, stage, out);
        }
        for ((at, geometry), loads) in blocks.zip(&stage.geometry).zip(&stage.loads) {
            let entries = L::each(|k| list.active[at[k] as usize]);
            if inside {
                add_up::<L, true>(permit, &entries, geometry, loads, T::COUPLES, out);
            } else {
                add_up::<L, false>(permit, &entries, geometry, loads, T::COUPLES, out);
            }
            if rolls && !APART {
                brake::<L>(&entries, geometry, loads.rolling, out);
            }
            if !APART {
                note_overlap(permit, geometry, out);
            }
            if loads.attention != 0 {
                for k in (0..L::WIDTH).filter(|k| loads.attention >> k & 1 == 1) {
                    out.notes.push(Note { list: list.which, index: at[k] });
                }
            }
        }
    }
}

/// Adds forces and torques to the chunk's own particles, pair by pair.
#[inline(always)]
fn add_up<L: Lane, const INSIDE: bool>(
    permit: L::Permit,
    entries: &L::Each<Entry>,
    geometry: &Geometry<L>,
    loads: &Loads<L>,
    couples: bool,
    out: &mut Out<'_>,
) {
    let force = (geometry.normal * loads.tension + loads.shear).rows(permit);
    let arm = geometry.normal.cross(loads.shear);
    let mut torques = [arm * geometry.levers[0], arm * geometry.levers[1]];
    if couples {
        torques = [torques[0] + loads.couple, torques[1] - loads.couple];
    }
    let torques = [torques[0].rows(permit), torques[1].rows(permit)];
    let first_slot = out.range.start;
    for k in 0..L::WIDTH {
        let sum = |side: usize| (entries[k][side] - first_slot) as usize;
        if INSIDE || out.range.contains(&entries[k][0]) {
            let sum = &mut out.sums[sum(0)];
            sum.force.add(force[k]);
            sum.torque.add(torques[0][k]);
        }
        if INSIDE || !out.range.contains(&entries[k][0]) {
            let sum = &mut out.sums[sum(1)];
            sum.force.take(force[k]);
            sum.torque.add(torques[1][k]);
        }
    }
}

/// Keeps those pairs that something resists for the end of the step; of pairs across a border only
/// those whose first particle is the chunk's own. Those that want attention are looked at again
/// once they have had it.
#[inline(always)]
fn meet<T: PairTerm, L: Lane, const APART: bool>(
    pass: &Pass<'_, T, L>,
    list: &mut Listed<'_, T::Column>,
    acting: &[u32],
    stage: &mut Stage<L>,
    out: &mut Out<'_>,
) {
    let (permit, view, kick) = (pass.permit, pass.view, pass.view.kick());
    let inverse = Inverse { classes: view.inverse, class: view.class };
    let blocks = acting.chunks_exact(L::WIDTH);
    let Stage { geometry, loads, resist, remembered } = stage;
    for (at, remembered) in blocks.clone().zip(&mut *remembered) {
        let columns = &mut Picked { columns: list.columns, at };
        *remembered = Remembered::pack(permit, |k| impulse(pass.term, columns.column(k)));
    }
    for (((at, geometry), remembered), resist) in
        blocks.clone().zip(&*geometry).zip(&*remembered).zip(&mut *resist)
    {
        let entries = L::each(|k| list.active[at[k] as usize]);
        let pairs = Pairs { view, entries, apart: APART, permit, geometry };
        let columns = &mut Picked { columns: list.columns, at };
        *resist = pass.term.resist_lanes(&pairs, columns, remembered.middle(geometry, kick));
    }
    for ((((at, geometry), loads), resist), remembered) in
        blocks.zip(&*geometry).zip(&*loads).zip(&*resist).zip(&*remembered)
    {
        let (slots, index) = (L::each(|k| list.active[at[k] as usize]), L::each(|k| at[k]));
        let sideways = view.sideways(permit, &slots, geometry.separation_speed);
        let met = Met { slots, index, geometry, sideways, resist, remembered };
        link(pass, list, &met, !loads.attention, inverse, out);
    }
}

/// Makes links of those pairs in `which` something resists.
#[inline(always)]
fn link<T: PairTerm, L: Lane>(
    pass: &Pass<'_, T, L>,
    list: &mut Listed<'_, T::Column>,
    met: &Met<'_, L>,
    mut which: u32,
    inverse: Inverse<'_>,
    out: &mut Out<'_>,
) {
    let inside = list.which == List::Inside;
    if !inside {
        for k in (0..L::WIDTH).filter(|&k| !out.range.contains(&met.slots[k][0])) {
            which &= !(1 << k);
        }
    }
    let any = met.resist.any();
    // Where nothing resists any more nothing is remembered either.
    let free = which & !any;
    for k in (0..L::WIDTH).filter(|k| free >> k & 1 == 1) {
        if let Some(impulse) = pass.term.impulse(&mut list.columns[met.index[k] as usize]) {
            *impulse = Impulse::NONE;
        }
    }
    let links = &mut *out.links[usize::from(!inside)];
    let times = pass.view.kick_and_drift();
    let which = which & any;
    let rest = if inside && L::WIDTH > 1 {
        let pushed = (&mut *out.pushed, out.range.start);
        links.add(pass.permit, met, which, inverse, times, pushed)
    } else if which != 0 {
        links.add_loose(pass.permit, met, which, list.which, inverse, times)
    } else {
        0
    };
    for k in (0..L::WIDTH).filter(|k| rest >> k & 1 == 1) {
        let impulse = impulse(pass.term, &mut list.columns[met.index[k] as usize]);
        links.add_single(met, (k, impulse), list.which, inverse, times);
    }
}

/// What a pair remembers of its impulses.
#[inline(always)]
fn impulse<T: PairTerm>(term: &T, column: &mut T::Column) -> Impulse {
    match term.impulse(column) {
        Some(impulse) => *impulse,
        None => Impulse::NONE,
    }
}

/// Adds the torques of rolling friction to the chunk's own particles.
#[inline(always)]
fn brake<L: Lane>(
    entries: &L::Each<Entry>,
    geometry: &Geometry<L>,
    torque: Vector<L>,
    out: &mut Out<'_>,
) {
    let (gaps, torque) = (geometry.gap.unpack(), torque.unpack());
    for k in (0..L::WIDTH).filter(|&k| gaps[k] < 0.0) {
        for (slot, torque) in entries[k].into_iter().zip([torque[k], -torque[k]]) {
            if out.range.contains(&slot) {
                roll(&mut out.rolls[(slot - out.range.start) as usize], torque);
            }
        }
    }
}

/// Keeps the largest overlap over the smaller radius.
#[inline(always)]
fn note_overlap<L: Lane>(permit: L::Permit, geometry: &Geometry<L>, out: &mut Out<'_>) {
    let smaller = geometry.radii[0].least(geometry.radii[1]);
    if (L::splat(permit, *out.overlap) * smaller).any_less(-geometry.gap) {
        let shares = (-geometry.gap / smaller).unpack();
        *out.overlap = (0..L::WIDTH).fold(*out.overlap, |most, k| most.max(shares[k]));
    }
}
