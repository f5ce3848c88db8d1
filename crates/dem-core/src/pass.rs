//! The read half between particles: every active pair is loaded, every load added up.

use std::ops::Range;
use std::time::Instant;

use glam::DVec3;

use crate::chunk::{Chunk, List, Note, Roll, Sum};
use crate::implicit::Met;
use crate::lane::{Four, Lane, Vector};
use crate::lists::{Entry, PairList};
use crate::pairs::{Geometry, Pairs, Picked};
use crate::particles::{Class, Particles, Place, Velocity};
use crate::{Encounter, Load, Pair, PairTerm, Partner};
#[cfg(target_arch = "x86_64")]
use pendular_lane::Avx;

/// Pairs that are looked at before those of them that act are loaded: few enough to stay near.
const TILE: usize = 128;

/// What all chunks read in one step.
#[derive(Clone, Copy)]
pub(crate) struct View<'a> {
    pub(crate) classes: &'a [Class],
    pub(crate) places: &'a [Place],
    pub(crate) velocities: &'a [Velocity],
    pub(crate) class: &'a [u16],
    pub(crate) id: &'a [u32],
    pub(crate) rolls: &'a [Roll],
    pub(crate) time_step: f64,
    /// How far the velocities lag behind the positions, s.
    pub(crate) lag: f64,
}

impl<'a> View<'a> {
    pub(crate) fn new(p: &'a Particles, rolls: &'a [Roll], time_step: f64, lag: f64) -> Self {
        let (places, velocities) = (&p.places, &p.velocities);
        let (class, id, classes) = (&p.class, &p.id, p.classes());
        Self { classes, places, velocities, class, id, rolls, time_step, lag }
    }

    pub(crate) fn inertia(&self, slot: usize) -> f64 {
        self.classes[usize::from(self.class[slot])].inertia()
    }

    #[inline(always)]
    pub(crate) fn encounter(&self, [a, b]: Entry, gap: f64) -> Encounter {
        let second = Partner::Particle(self.id[b as usize]);
        Encounter { first: self.id[a as usize], second, element: 0, nearest: true, gap }
    }

    /// Two particles that meet.
    #[inline(always)]
    pub(crate) fn meet(&self, entry: Entry) -> Encounter {
        self.encounter(entry, self.distances::<f64>((), &[entry]).gap)
    }

    /// Centres and radii of one side of pairs.
    #[inline(always)]
    fn spheres<L: Lane>(
        &self,
        permit: L::Permit,
        entries: &L::Each<Entry>,
        side: usize,
    ) -> (Vector<L>, L) {
        let places = L::each(|k| &self.places[entries[k][side] as usize]);
        let [x, y, z, r] = L::rows(permit, &places, |p| [p.x.x, p.x.y, p.x.z, p.r]);
        (Vector { x, y, z }, r)
    }

    /// How far the particles of pairs side by side are from each other.
    #[inline(always)]
    fn distances<L: Lane>(&self, permit: L::Permit, entries: &L::Each<Entry>) -> Distance<L> {
        let (x, first) = self.spheres::<L>(permit, entries, 0);
        let (y, second) = self.spheres::<L>(permit, entries, 1);
        let line = y - x;
        let distance = line.dot(line).sqrt();
        Distance { line, distance, radii: [first, second], gap: distance - (first + second) }
    }

    /// Pairs side by side.
    #[inline(always)]
    pub(crate) fn pairs<L: Lane, const ROLLS: bool>(
        &'a self,
        permit: L::Permit,
        entries: L::Each<Entry>,
        apart: bool,
    ) -> Pairs<'a, L> {
        let velocities = |side: usize| L::each(|k| &self.velocities[entries[k][side] as usize]);
        let Distance { line, distance, radii, gap } = self.distances::<L>(permit, &entries);
        let (p, q) = (velocities(0), velocities(1));
        let (vi, wi) = motion::<L>(permit, &p);
        let (vj, wj) = motion::<L>(permit, &q);
        let velocity = vi - vj;
        let half = line + velocity * L::splat(permit, self.lag);
        let half_step_normal = half * (L::splat(permit, 1.0) / half.dot(half).sqrt());
        // The contact lies in the middle of gap or overlap, so that li + lj is the distance.
        let half_gap = L::splat(permit, 0.5) * gap;
        let levers = [radii[0] + half_gap, radii[1] + half_gap];
        let along = velocity.dot(half_step_normal);
        let turning = (wi * levers[0] + wj * levers[1]).cross(half_step_normal);
        let spin = wi - wj;
        let mut geometry = Geometry {
            gap,
            radii,
            normal: line * (L::splat(permit, 1.0) / distance),
            half_step_normal,
            separation_speed: -along,
            slip: velocity - half_step_normal * along + turning,
            spin,
            expected_spin: Vector::zero(permit),
            rolling_inertia: L::splat(permit, 0.0),
            levers,
            time_step: self.time_step,
        };
        if ROLLS {
            let rolls = |side: usize| L::each(|k| &self.rolls[entries[k][side] as usize]);
            let (p, q) = (rolls(0), rolls(1));
            geometry.expected_spin = spin
                + (Vector::<L>::pack(permit, &p, |p| p.spin)
                    - Vector::<L>::pack(permit, &q, |q| q.spin));
            let brake = L::each(|k| {
                let [a, b] = entries[k].map(|slot| slot as usize);
                p[k].contacts / self.inertia(a) + q[k].contacts / self.inertia(b)
            });
            geometry.rolling_inertia = L::splat(permit, 1.0) / L::pack(permit, &brake, |b| *b);
        }
        Pairs { view: self, entries, apart, permit, geometry }
    }
}

/// How far two particles are from each other.
struct Distance<L> {
    /// From centre to centre, m.
    line: Vector<L>,
    distance: L,
    radii: [L; 2],
    gap: L,
}

/// Velocity and spin of particles side by side.
#[inline(always)]
fn motion<L: Lane>(permit: L::Permit, of: &L::Each<&Velocity>) -> (Vector<L>, Vector<L>) {
    let [vx, vy, vz, _] = L::rows(permit, of, |p| [p.v.x, p.v.y, p.v.z, p.w.x]);
    let [_, wx, wy, wz] = L::rows(permit, of, |p| [p.v.z, p.w.x, p.w.y, p.w.z]);
    (Vector { x: vx, y: vy, z: vz }, Vector { x: wx, y: wy, z: wz })
}

/// Loads all active pairs of a chunk.
pub(crate) fn read<T: PairTerm, const ROLLS: bool>(
    view: &View<'_>,
    term: &T,
    chunk: &mut Chunk<T::Column>,
) {
    let start = Instant::now();
    let Chunk { range, inside, across, sums, rolls, notes, apart, overlap, pair_time, .. } = chunk;
    let met = [&mut chunk.links.met, &mut chunk.links_across.met];
    let out = Out { range, sums, rolls, notes, apart, overlap, met };
    // The widest registers that this machine has; the same operations, the same bits.
    match pulp::Arch::new() {
        #[cfg(target_arch = "x86_64")]
        pulp::Arch::V3(permit) => permit.vectorize(Both::<'_, '_, T, Avx, ROLLS> {
            permit,
            view,
            term,
            inside,
            across,
            out,
        }),
        // The same four numbers, but twice as many registers.
        #[cfg(target_arch = "x86_64")]
        pulp::Arch::V4(wide) => wide.vectorize(Both::<'_, '_, T, Avx, ROLLS> {
            permit: *wide,
            view,
            term,
            inside,
            across,
            out,
        }),
        arch => arch.dispatch(Both::<'_, '_, T, Four, ROLLS> {
            permit: (),
            view,
            term,
            inside,
            across,
            out,
        }),
    }
    *pair_time += start.elapsed();
}

/// Both lists of a chunk.
struct Both<'v, 'a, T: PairTerm, L: Lane, const ROLLS: bool> {
    permit: L::Permit,
    view: &'a View<'v>,
    term: &'a T,
    inside: &'a mut PairList<T::Column>,
    across: &'a mut PairList<T::Column>,
    out: Out<'a>,
}

impl<T: PairTerm, L: Lane, const ROLLS: bool> pulp::NullaryFnOnce for Both<'_, '_, T, L, ROLLS> {
    type Output = ();

    #[inline(always)]
    fn call(mut self) {
        // A copy of its own: no store into a list can change it.
        let (permit, view, term) = (self.permit, &{ *self.view }, self.term);
        list::<T, L, ROLLS, true>(permit, view, term, self.inside, &mut self.out);
        list::<T, L, ROLLS, false>(permit, view, term, self.across, &mut self.out);
    }
}

struct Out<'a> {
    range: &'a Range<u32>,
    sums: &'a mut [Sum],
    rolls: &'a mut [Roll],
    notes: &'a mut Vec<Note>,
    apart: &'a mut Vec<u32>,
    overlap: &'a mut f64,
    /// Where an implicit term keeps the pairs that act.
    met: [&'a mut Vec<Met>; 2],
}

/// One list: first which pairs act, then what acts in them, several side by side. Those that touch
/// come first, so that neither kind of pair pays for what only the other needs.
///
/// `INSIDE`: both particles are the chunk's own; else the load goes to one of them only, computed
/// in the same orientation as the chunk of the other one does.
#[inline(always)]
fn list<T: PairTerm, L: Lane, const ROLLS: bool, const INSIDE: bool>(
    permit: L::Permit,
    view: &View<'_>,
    term: &T,
    list: &mut PairList<T::Column>,
    out: &mut Out<'_>,
) {
    let mut touching = [0; TILE + 4];
    let mut waiting = 0;
    let mut apart = std::mem::take(out.apart);
    apart.clear();
    for start in (0..list.active.len()).step_by(TILE) {
        let count =
            pick::<T, L>(permit, view, term, list, start, &mut touching, waiting, &mut apart);
        let acting = &touching[..count];
        waiting = fours::<T, L, ROLLS, INSIDE, false>(permit, view, term, list, acting, out);
        // What makes no four waits for the next tile.
        touching.copy_within(count - waiting..count, 0);
    }
    singly::<T, ROLLS, INSIDE, false>(view, term, list, &touching[..waiting], out);
    let waiting = fours::<T, L, ROLLS, INSIDE, true>(permit, view, term, list, &apart, out);
    let rest = &apart[apart.len() - waiting..];
    singly::<T, ROLLS, INSIDE, true>(view, term, list, rest, out);
    *out.apart = apart;
}

/// Writes the places of those pairs in a tile that are not idle: of those that touch behind the
/// first `waiting` of `touching`, without branching on what no processor can foresee; of the others
/// to the end of `apart`.
#[inline(always)]
#[allow(clippy::too_many_arguments)] // one loop body, named
fn pick<T: PairTerm, L: Lane>(
    permit: L::Permit,
    view: &View<'_>,
    term: &T,
    list: &mut PairList<T::Column>,
    start: usize,
    touching: &mut [u32; TILE + 4],
    waiting: usize,
    apart: &mut Vec<u32>,
) -> usize {
    let end = list.active.len().min(start + TILE);
    let tile = &list.active[start..end];
    let gaps = gaps::<L>(permit, view, tile);
    let pairs = tile.iter().zip(&mut list.columns[start..end]).zip(gaps);
    let (mut near, mut far) = (waiting, 0);
    let mut others = [0; TILE];
    for (index, ((&entry, column), gap)) in pairs.enumerate() {
        let (acts, touches) = (!term.idle(&view.encounter(entry, gap), column), gap < 0.0);
        touching[near] = (start + index) as u32;
        near += usize::from(acts & touches);
        others[far % TILE] = (start + index) as u32;
        far += usize::from(acts & !touches);
    }
    apart.extend_from_slice(&others[..far]);
    near
}

/// Gaps of a tile of pairs.
#[inline(always)]
fn gaps<L: Lane>(permit: L::Permit, view: &View<'_>, tile: &[Entry]) -> [f64; TILE] {
    let mut gaps = [0.0; TILE];
    let (fours, rest) = tile.as_chunks::<4>();
    let (gaps_of_fours, gaps_of_rest) = gaps.split_at_mut(4 * fours.len());
    for (four, out) in fours.iter().zip(gaps_of_fours.as_chunks_mut::<4>().0) {
        let gap = view.distances::<L>(permit, &L::each(|k| four[k])).gap.unpack();
        (out[0], out[1], out[2], out[3]) = (gap[0], gap[1], gap[2], gap[3]);
    }
    for (entry, out) in rest.iter().zip(gaps_of_rest) {
        *out = view.distances::<f64>((), &[*entry]).gap;
    }
    gaps
}

/// Loads as many of the pairs as make fours; returns how many are left over at the end.
#[inline(always)]
fn fours<T: PairTerm, L: Lane, const ROLLS: bool, const INSIDE: bool, const APART: bool>(
    permit: L::Permit,
    view: &View<'_>,
    term: &T,
    list: &mut PairList<T::Column>,
    acting: &[u32],
    out: &mut Out<'_>,
) -> usize {
    if !T::LANES {
        singly::<T, ROLLS, INSIDE, APART>(view, term, list, acting, out);
        return 0;
    }
    let (fours, rest) = acting.as_chunks::<4>();
    for at in fours {
        block::<T, L, ROLLS, INSIDE, APART>(permit, view, term, list, at, out);
    }
    rest.len()
}

#[inline(always)]
fn singly<T: PairTerm, const ROLLS: bool, const INSIDE: bool, const APART: bool>(
    view: &View<'_>,
    term: &T,
    list: &mut PairList<T::Column>,
    acting: &[u32],
    out: &mut Out<'_>,
) {
    for at in acting {
        block::<T, f64, ROLLS, INSIDE, APART>((), view, term, list, std::slice::from_ref(at), out);
    }
}

#[inline(always)]
fn block<T: PairTerm, L: Lane, const ROLLS: bool, const INSIDE: bool, const APART: bool>(
    permit: L::Permit,
    view: &View<'_>,
    term: &T,
    list: &mut PairList<T::Column>,
    at: &[u32],
    out: &mut Out<'_>,
) {
    let pairs = view.pairs::<L, ROLLS>(permit, L::each(|k| list.active[at[k] as usize]), APART);
    let loads = term.load_lanes(&pairs, &mut Picked { columns: &mut list.columns, at });
    let g = &pairs.geometry;
    let force = (g.normal * loads.tension + loads.shear).unpack();
    let arm = g.normal.cross(loads.shear);
    let mut torques = [arm * g.levers[0], arm * g.levers[1]];
    if T::COUPLES {
        torques = [torques[0] + loads.couple, torques[1] - loads.couple];
    }
    let torques = [torques[0].unpack(), torques[1].unpack()];
    for k in 0..L::WIDTH {
        let entry = pairs.entries[k];
        if INSIDE {
            let slot = |side: usize| (entry[side] - out.range.start) as usize;
            add(&mut out.sums[slot(0)], force[k], torques[0][k]);
            add(&mut out.sums[slot(1)], -force[k], torques[1][k]);
        } else {
            let second = !out.range.contains(&entry[0]);
            let slot = (entry[usize::from(second)] - out.range.start) as usize;
            let force = if second { -force[k] } else { force[k] };
            add(&mut out.sums[slot], force, torques[usize::from(second)][k]);
        }
    }
    if ROLLS && !APART {
        brake::<L>(&pairs, loads.rolling, out);
    }
    let smaller = g.radii[0].least(g.radii[1]);
    if !APART && (L::splat(permit, *out.overlap) * smaller).any_less(-g.gap) {
        let shares = (-g.gap / smaller).unpack();
        *out.overlap = (0..L::WIDTH).fold(*out.overlap, |most, k| most.max(shares[k]));
    }
    if T::IMPLICIT {
        meet::<L>(&pairs, at, INSIDE, out);
    }
    if loads.attention != 0 {
        let kind = if INSIDE { List::Inside } else { List::Across };
        for k in (0..L::WIDTH).filter(|k| loads.attention >> k & 1 == 1) {
            out.notes.push(Note { list: kind, index: at[k] });
        }
    }
}

/// Keeps how pairs met for the end of the step; of pairs across a border only those whose first
/// particle is the chunk's own.
#[inline(always)]
fn meet<L: Lane>(pairs: &Pairs<'_, L>, at: &[u32], inside: bool, out: &mut Out<'_>) {
    let g = &pairs.geometry;
    let (normal, slip) = (g.normal.unpack(), g.slip.unpack());
    let (gap, rate) = (g.gap.unpack(), g.separation_speed.unpack());
    let levers = [g.levers[0].unpack(), g.levers[1].unpack()];
    let [mine, border] = &mut out.met;
    let (met, list) = if inside { (mine, List::Inside) } else { (border, List::Across) };
    for k in 0..L::WIDTH {
        let slots = pairs.entries[k];
        if inside || out.range.contains(&slots[0]) {
            met.push(Met {
                slots,
                list,
                index: at[k],
                normal: normal[k],
                levers: [levers[0][k], levers[1][k]],
                gap: gap[k],
                rate: rate[k],
                slip: slip[k],
            });
        }
    }
}

#[inline(always)]
fn add(sum: &mut Sum, force: DVec3, torque: DVec3) {
    sum.force += force;
    sum.torque += torque;
}

/// Adds the torques of rolling friction to the chunk's own particles.
#[inline(always)]
fn brake<L: Lane>(pairs: &Pairs<'_, L>, torque: Vector<L>, out: &mut Out<'_>) {
    let (gaps, torque) = (pairs.geometry.gap.unpack(), torque.unpack());
    for k in (0..L::WIDTH).filter(|&k| gaps[k] < 0.0) {
        for (slot, torque) in pairs.entries[k].into_iter().zip([torque[k], -torque[k]]) {
            if out.range.contains(&slot) {
                roll(&mut out.rolls[(slot - out.range.start) as usize], torque);
            }
        }
    }
}

/// Adds a load to the particle at a wall.
#[inline(always)]
pub(crate) fn add_wall(sum: &mut Sum, load: &Load, pair: &Pair) {
    let force = load.tension * pair.normal + load.shear;
    add(sum, force, pair.levers[0] * pair.normal.cross(load.shear) + load.couple);
}

#[inline(always)]
pub(crate) fn roll(sum: &mut Roll, torque: DVec3) {
    sum.spin += torque;
    sum.contacts += 1.0;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Columns, Contact, Loads, PairContact, Settings, Simulation, StabilityLoad};
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
            assert_eq!(L::WIDTH, 1, "four at a time was not asked for");
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
