//! What all chunks read in one step, and the geometry of pairs of particles.

use crate::chunk::Roll;
use crate::lane::{Lane, Vector};
use crate::lists::Entry;
use crate::pairs::{Geometry, Pairs};
use crate::particles::{Class, Particles, Place, Velocity};
use crate::{Encounter, Pair, Partner};

/// What all chunks read in one step.
#[derive(Clone, Copy)]
pub(crate) struct View<'a> {
    pub(crate) classes: &'a [Class],
    pub(crate) places: &'a [Place],
    pub(crate) velocities: &'a [Velocity],
    pub(crate) class: &'a [u16],
    pub(crate) id: &'a [u32],
    pub(crate) rolls: &'a [Roll],
    /// 1/m and 1/I of every class; empty unless the term is implicit.
    pub(crate) inverse: &'a [[f64; 2]],
    pub(crate) time_step: f64,
    /// How far the velocities lag behind the positions, s.
    pub(crate) lag: f64,
}

impl<'a> View<'a> {
    pub(crate) fn new(
        p: &'a Particles,
        rolls: &'a [Roll],
        inverse: &'a [[f64; 2]],
        [time_step, lag]: [f64; 2],
    ) -> Self {
        let (places, velocities) = (&p.places, &p.velocities);
        let (class, id, classes) = (&p.class, &p.id, p.classes());
        Self { classes, places, velocities, class, id, rolls, inverse, time_step, lag }
    }

    /// Whether the term uses rolling friction.
    #[inline(always)]
    pub(crate) fn rolls(&self) -> bool {
        !self.rolls.is_empty()
    }

    /// How long the next kick lasts, s.
    pub(crate) fn kick(&self) -> f64 {
        0.5 * self.time_step + self.lag
    }

    /// How long the next kick lasts and the drift after it, s.
    pub(crate) fn kick_and_drift(&self) -> [f64; 2] {
        [self.kick(), self.time_step]
    }

    /// Square of the speed of pairs across their lines of centres, m²/s²; 0 at a wall, where both
    /// slots are the same.
    #[inline(always)]
    pub(crate) fn sideways<L: Lane>(
        &self,
        permit: L::Permit,
        slots: &L::Each<[u32; 2]>,
        separation_speed: L,
    ) -> L {
        let of = |side: usize| L::each(|k| &self.velocities[slots[k][side] as usize]);
        let [x, y, z, _] = L::rows(permit, &of(0), |p| p.v.0);
        let first = Vector { x, y, z };
        let [x, y, z, _] = L::rows(permit, &of(1), |p| p.v.0);
        let v = first - Vector { x, y, z };
        (v.dot(v) - separation_speed * separation_speed).most(L::splat(permit, 0.0))
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
        let [x, y, z, r] = L::rows(permit, &places, |p| p.row());
        (Vector { x, y, z }, r)
    }

    /// How far the particles of pairs side by side are from each other.
    #[inline(always)]
    pub(crate) fn distances<L: Lane>(
        &self,
        permit: L::Permit,
        entries: &L::Each<Entry>,
    ) -> Distance<L> {
        let (x, first) = self.spheres::<L>(permit, entries, 0);
        let (y, second) = self.spheres::<L>(permit, entries, 1);
        let line = y - x;
        let distance = line.dot(line).sqrt();
        Distance { line, distance, radii: [first, second], gap: distance - (first + second) }
    }

    /// Where pairs are and how they move.
    #[inline(always)]
    pub(crate) fn geometry<L: Lane>(
        &self,
        permit: L::Permit,
        entries: &L::Each<Entry>,
    ) -> Geometry<L> {
        let velocities = |side: usize| L::each(|k| &self.velocities[entries[k][side] as usize]);
        let Distance { line, distance, radii, gap } = self.distances::<L>(permit, entries);
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
        if self.rolls() {
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
        geometry
    }

    /// All of one pair.
    pub(crate) fn pair(&self, entry: Entry) -> Pair {
        let geometry = self.geometry::<f64>((), &[entry]);
        Pairs { view: self, entries: [entry], apart: false, permit: (), geometry: &geometry }
            .pair(0)
    }
}

/// How far two particles are from each other.
pub(crate) struct Distance<L> {
    /// From centre to centre, m.
    line: Vector<L>,
    distance: L,
    radii: [L; 2],
    pub(crate) gap: L,
}

/// Velocity and spin of particles side by side.
#[inline(always)]
pub(crate) fn motion<L: Lane>(
    permit: L::Permit,
    of: &L::Each<&Velocity>,
) -> (Vector<L>, Vector<L>) {
    let [vx, vy, vz, _] = L::rows(permit, of, |p| p.v.0);
    let [wx, wy, wz, _] = L::rows(permit, of, |p| p.w.0);
    (Vector { x: vx, y: vy, z: vz }, Vector { x: wx, y: wy, z: wz })
}
