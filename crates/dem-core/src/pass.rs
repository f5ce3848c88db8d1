//! The read half between particles: every active pair is loaded, every load added up.

use std::time::Instant;

use glam::DVec3;

use crate::block::{Listed, Out, Pass, Stage, load};
use crate::chunk::{Chunk, List, Roll, Sum};
use crate::implicit::Colours;
use crate::lane::{Kernel, Lane, in_widest};
use crate::lists::{Entry, PairList};
use crate::particles::Row;
use crate::view::View;
use crate::{Load, Pair, PairTerm};

/// Pairs that are looked at before those of them that act are loaded: few enough to stay near.
const TILE: usize = 128;
/// The most pairs that wait.
const MANY: usize = Colours::WINDOW + TILE;

/// Loads all active pairs of a chunk.
pub(crate) fn read<T: PairTerm>(view: &View<'_>, term: &T, chunk: &mut Chunk<T::Column>) {
    let start = Instant::now();
    let Chunk { range, inside, across, sums, rolls, notes, apart, overlap, pair_time, .. } = chunk;
    let (colours, pushed) = (&mut chunk.colours, &mut chunk.pushed[..]);
    let links = [&mut chunk.links, &mut chunk.links_across];
    let out = Out { range, sums, rolls, notes, apart, overlap, colours, links, pushed };
    in_widest(Both { view, term, inside, across, out });
    *pair_time += start.elapsed();
}

/// Both lists of a chunk.
struct Both<'v, 'a, T: PairTerm> {
    view: &'a View<'v>,
    term: &'a T,
    inside: &'a mut PairList<T::Column>,
    across: &'a mut PairList<T::Column>,
    out: Out<'a>,
}

impl<T: PairTerm> Kernel for Both<'_, '_, T> {
    #[inline(always)]
    fn run<L: Lane>(mut self, permit: L::Permit) {
        // A copy of its own: no store into a list can change it. All columns have one length, so that
        // a slot is checked once.
        let View { places, velocities, class, id, .. } = *self.view;
        let slots = places.len();
        let (velocities, class, id) = (&velocities[..slots], &class[..slots], &id[..slots]);
        let view = &View { velocities, class, id, ..*self.view };
        let pass = Pass::<'_, T, L> { permit, view, term: self.term };
        let stage = &mut Stage::<L>::new(permit);
        for (pairs, which) in [(self.inside, List::Inside), (self.across, List::Across)] {
            list::<T, L>(&pass, pairs, which, stage, &mut self.out);
        }
    }
}

/// One list: first which pairs act, then what acts in them, several side by side. Those that touch
/// come first, so that neither kind of pair pays for what only the other needs.
///
/// Across the border of the chunk the load goes to one of the particles only, computed in the same
/// orientation as the chunk of the other one does.
#[inline(always)]
fn list<T: PairTerm, L: Lane>(
    pass: &Pass<'_, T, L>,
    list: &mut PairList<T::Column>,
    which: List,
    stage: &mut Stage<L>,
    out: &mut Out<'_>,
) {
    let active = list.active.as_slice();
    let list = &mut Listed { which, active, columns: &mut list.columns[..active.len()] };
    let mut touching = [0; MANY];
    let mut waiting = 0;
    let mut apart = std::mem::take(out.apart);
    apart.clear();
    // An implicit term sorts them first, for which there have to be some.
    // So many at a time, whatever the tiles: their order must not hang on what else is listed.
    let sorts = T::IMPLICIT && which == List::Inside;
    for start in (0..list.active.len()).step_by(TILE) {
        waiting = pick::<T, L>(pass, list, start, &mut touching, waiting, &mut apart);
        let count = if sorts { Colours::WINDOW } else { waiting };
        if waiting > 0 && waiting >= count {
            let mut left = several::<T, L, false>(pass, list, &mut touching[..count], stage, out);
            if sorts && left == count {
                singly::<T, false>(pass.view, pass.term, list, &touching[..count], out);
                left = 0;
            }
            // What does not fill the lanes waits for the next tile.
            touching.copy_within(count - left..waiting, 0);
            waiting -= count - left;
        }
    }
    let left = several::<T, L, false>(pass, list, &mut touching[..waiting], stage, out);
    singly::<T, false>(pass.view, pass.term, list, &touching[waiting - left..waiting], out);
    let window = if T::IMPLICIT { Colours::WINDOW } else { usize::MAX };
    let mut rest = &mut apart[..];
    while !rest.is_empty() {
        let count = rest.len().min(window);
        let mut left = several::<T, L, true>(pass, list, &mut rest[..count], stage, out);
        if count == rest.len() || left == count {
            singly::<T, true>(pass.view, pass.term, list, &rest[count - left..count], out);
            left = 0;
        }
        rest = &mut rest[count - left..];
    }
    *out.apart = apart;
}

/// Loads as many of the pairs as fill the lanes, if the term has them; returns how many are left
/// over at the end.
#[inline(always)]
fn several<T: PairTerm, L: Lane, const APART: bool>(
    pass: &Pass<'_, T, L>,
    list: &mut Listed<'_, T::Column>,
    acting: &mut [u32],
    stage: &mut Stage<L>,
    out: &mut Out<'_>,
) -> usize {
    if !T::LANES {
        singly::<T, APART>(pass.view, pass.term, list, acting, out);
        return 0;
    }
    let full = if T::IMPLICIT && list.which == List::Inside {
        out.colours.sort(list.active, acting, out.range)
    } else {
        acting.len() - acting.len() % L::WIDTH
    };
    load::<T, L, APART>(pass, list, &acting[..full], stage, out);
    acting.len() - full
}

/// Loads pairs one at a time. They are few: compiled once for whatever registers the machine has.
#[inline(never)]
fn singly<T: PairTerm, const APART: bool>(
    view: &View<'_>,
    term: &T,
    list: &mut Listed<'_, T::Column>,
    acting: &[u32],
    out: &mut Out<'_>,
) {
    let pass = Pass { permit: (), view, term };
    load::<T, f64, APART>(&pass, list, acting, &mut Stage::new(()), out);
}

/// Writes the places of those pairs in a tile that are not idle: of those that touch behind the
/// first `waiting` of `touching`, of the others to the end of `apart`. There are no branches on what
/// no processor can foresee.
#[inline(always)]
fn pick<T: PairTerm, L: Lane>(
    pass: &Pass<'_, T, L>,
    list: &mut Listed<'_, T::Column>,
    start: usize,
    touching: &mut [u32; MANY],
    waiting: usize,
    apart: &mut Vec<u32>,
) -> usize {
    let end = list.active.len().min(start + TILE);
    let (tile, columns) = (&list.active[start..end], &mut list.columns[start..end]);
    let gaps = gaps::<L>(pass.permit, pass.view, tile);
    let (mut near, mut far) = (waiting, 0);
    let mut others = [0; TILE];
    for (index, gap) in gaps.iter().enumerate().take(tile.len()) {
        let touch = *gap < 0.0;
        touching[near] = (start + index) as u32;
        near += usize::from(touch);
        others[far % TILE] = index as u32;
        far += usize::from(!touch);
    }
    if !T::ACTS_IN_OVERLAP {
        let mut kept = waiting;
        for k in waiting..near {
            touching[kept] = touching[k];
            let index = touching[k] as usize - start;
            kept += usize::from(acts(pass, tile[index], gaps[index], &mut columns[index]));
        }
        near = kept;
    }
    let mut kept = 0;
    for k in 0..far.min(TILE) {
        let index = others[k];
        others[kept] = start as u32 + index;
        let index = index as usize;
        kept += usize::from(acts(pass, tile[index], gaps[index], &mut columns[index]));
    }
    apart.extend_from_slice(&others[..kept]);
    near
}

#[inline(always)]
fn acts<T: PairTerm, L: Lane>(
    pass: &Pass<'_, T, L>,
    entry: Entry,
    gap: f64,
    column: &mut T::Column,
) -> bool {
    !pass.term.idle(&pass.view.encounter(entry, gap), column)
}

/// Gaps of a tile of pairs.
#[inline(always)]
fn gaps<L: Lane>(permit: L::Permit, view: &View<'_>, tile: &[Entry]) -> [f64; TILE] {
    let mut gaps = [0.0; TILE];
    let (entries, out) = (tile.chunks_exact(L::WIDTH), gaps.chunks_exact_mut(L::WIDTH));
    let rest = entries.remainder();
    for (entries, out) in entries.zip(out) {
        let gap = view.distances::<L>(permit, &L::each(|k| entries[k])).gap.unpack();
        (0..L::WIDTH).for_each(|k| out[k] = gap[k]);
    }
    for (entry, out) in rest.iter().zip(&mut gaps[tile.len() - rest.len()..]) {
        *out = view.distances::<f64>((), &[*entry]).gap;
    }
    gaps
}

/// Adds a load to the particle at a wall.
#[inline(always)]
pub(crate) fn add_wall(sum: &mut Sum, load: &Load, pair: &Pair) {
    let force = load.tension * pair.normal + load.shear;
    let torque = pair.levers[0] * pair.normal.cross(load.shear) + load.couple;
    sum.force.add(Row::new(force).0);
    sum.torque.add(Row::new(torque).0);
}

#[inline(always)]
pub(crate) fn roll(sum: &mut Roll, torque: DVec3) {
    sum.spin += torque;
    sum.contacts += 1.0;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Class, Columns, Contact, Encounter, Loads, PairContact, Pairs, Particles};
    use crate::{Settings, Simulation, StabilityLoad};
    use pendular_contact::Linear;
    use rand_pcg::Pcg64;
    use rand_pcg::rand_core::{Rng, SeedableRng};

    type Dry = Contact<Linear>;

    /// The contact, one pair at a time.
    struct Single(Dry);

    impl PairTerm for Single {
        type Column = <Dry as PairTerm>::Column;
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
            Loads::pack(pairs.permit, &L::each(|k| self.0.load(&pairs.pair(k), columns.column(k))))
        }

        fn live(&self, column: &Self::Column) -> bool {
            self.0.live(column)
        }

        fn rolls(&self) -> bool {
            self.0.rolls()
        }

        fn stability(&self, classes: &[Class]) -> Vec<StabilityLoad> {
            self.0.stability(classes)
        }
    }

    fn heap() -> Particles {
        let classes = vec![1e-3, 1.3e-3].into_iter().map(|r| Class::new(r, 2500.0, 0).unwrap());
        let mut particles = Particles::new(classes.collect()).unwrap();
        let mut random = Pcg64::seed_from_u64(11);
        let mut any = |s: f64| s * ((random.next_u64() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0);
        for k in 0..700_u32 {
            let at = DVec3::new(f64::from(k % 10), f64::from(k / 10 % 10), f64::from(k / 100));
            let x = 2.65e-3 * at + DVec3::new(any(3e-5), any(3e-5), any(3e-5));
            let v = DVec3::new(any(0.5), any(0.5), any(0.5)) - 0.1 * (at - 4.5);
            let w = DVec3::new(any(300.0), any(300.0), any(300.0));
            particles.push((k % 2) as u16, x, v, w).unwrap();
        }
        particles
    }

    fn run<T: PairTerm>(term: impl Fn(Dry) -> T, rolling_friction: f64) -> Vec<[u64; 9]> {
        let particles = heap();
        let law = move |a: &Class, b: f64| PairContact {
            normal: Linear::from_restitution(1e4, 0.7, a.mass() * b / (a.mass() + b)).unwrap(),
            friction: 0.4,
            rolling_friction,
            tangential_damping: 1e-3,
        };
        let dry = Contact::new(
            particles.classes(),
            0,
            move |a, b| law(a, b.mass()),
            move |a, _| law(a, a.mass()),
        );
        let settings = Settings { gravity: DVec3::ZERO, ..Settings::new(2e-6) };
        let settings = Settings { start_overlap: 0.5, ..settings };
        let mut simulation =
            Simulation::new(particles, term(dry), crate::NoWalls, settings).unwrap();
        simulation.advance(1_500).unwrap();
        assert!(simulation.largest_overlap() > 1e-4, "spheres touch");
        let bits = |p: crate::Particle| {
            let all = [p.position, p.velocity, p.spin].map(|v| v.to_array().map(f64::to_bits));
            std::array::from_fn(|k| all[k / 3][k % 3])
        };
        simulation.particles().iter().map(bits).collect()
    }

    #[test]
    fn four_at_a_time_and_one_at_a_time_give_the_same_bits() {
        for rolling_friction in [0.0, 1e-5] {
            assert!(run(|dry| dry, rolling_friction) == run(Single, rolling_friction));
        }
    }
}
