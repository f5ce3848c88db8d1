//! One pair or several, side by side, as the kernels see them.

use glam::DVec3;

use crate::lane::{Lane, Vector};
use crate::lists::Entry;
use crate::view::View;
use crate::{Encounter, Load, Pair};

/// What a [`Pair`] says of place and motion, of one pair or several side by side.
#[derive(Debug, Clone, Copy)]
pub struct Geometry<L> {
    /// Gap S of the surfaces, m.
    pub gap: L,
    /// Radii, m.
    pub radii: [L; 2],
    /// Unit vector from the first body to the second.
    pub normal: Vector<L>,
    /// The same half a step before.
    pub half_step_normal: Vector<L>,
    /// dS/dt, m/s.
    pub separation_speed: L,
    /// Slip u of the surfaces, m/s.
    pub slip: Vector<L>,
    /// Relative spin, rad/s.
    pub spin: Vector<L>,
    /// Relative spin expected without rolling friction, rad/s.
    pub expected_spin: Vector<L>,
    /// Moment of inertia that this contact may brake, kg m².
    pub rolling_inertia: L,
    /// Lever arms, m.
    pub levers: [L; 2],
    /// Time step, s.
    pub time_step: f64,
}

impl<L: Lane> Geometry<L> {
    /// Nowhere.
    #[inline(always)]
    pub(crate) fn none(permit: L::Permit) -> Self {
        let (none, zero) = (L::splat(permit, 0.0), Vector::zero(permit));
        Self {
            gap: none,
            radii: [none; 2],
            normal: zero,
            half_step_normal: zero,
            separation_speed: none,
            slip: zero,
            spin: zero,
            expected_spin: zero,
            rolling_inertia: none,
            levers: [none; 2],
            time_step: 0.0,
        }
    }
}

impl<L: Lane> Geometry<L> {
    /// Pair `k` alone.
    #[inline(always)]
    pub(crate) fn single(&self, k: usize) -> Geometry<f64> {
        let one = |lanes: L| lanes.unpack()[k];
        let vector = |v: Vector<L>| Vector { x: one(v.x), y: one(v.y), z: one(v.z) };
        Geometry {
            gap: one(self.gap),
            radii: [one(self.radii[0]), one(self.radii[1])],
            normal: vector(self.normal),
            half_step_normal: vector(self.half_step_normal),
            separation_speed: one(self.separation_speed),
            slip: vector(self.slip),
            spin: vector(self.spin),
            expected_spin: vector(self.expected_spin),
            rolling_inertia: one(self.rolling_inertia),
            levers: [one(self.levers[0]), one(self.levers[1])],
            time_step: self.time_step,
        }
    }
}

impl Geometry<f64> {
    /// Of a single pair.
    #[must_use]
    pub fn of(pair: &Pair) -> Self {
        let vector = |v: DVec3| Vector { x: v.x, y: v.y, z: v.z };
        Self {
            gap: pair.encounter.gap,
            radii: pair.radii,
            normal: vector(pair.normal),
            half_step_normal: vector(pair.half_step_normal),
            separation_speed: pair.separation_speed,
            slip: vector(pair.slip),
            spin: vector(pair.spin),
            expected_spin: vector(pair.expected_spin),
            rolling_inertia: pair.rolling_inertia,
            levers: pair.levers,
            time_step: pair.time_step,
        }
    }
}

/// One pair of particles or several side by side, for [`crate::PairTerm::load_lanes`].
pub struct Pairs<'a, L: Lane> {
    pub(crate) view: &'a View<'a>,
    pub(crate) entries: L::Each<Entry>,
    /// Whether none of these pairs touch; else all of them do. Known where the kernel is compiled,
    /// so that what only a contact needs costs nothing in a pair that is apart.
    pub apart: bool,
    /// What lanes of these pairs are made with.
    pub permit: L::Permit,
    /// Where the pairs are and how they move.
    pub geometry: &'a Geometry<L>,
}

impl<L: Lane> Pairs<'_, L> {
    /// Classes of the particles of pair `k`.
    #[inline(always)]
    pub fn classes(&self, k: usize) -> [u16; 2] {
        let [a, b] = self.entries[k];
        [self.view.class[a as usize], self.view.class[b as usize]]
    }

    /// Who meets whom in pair `k`.
    #[inline(always)]
    pub fn encounter(&self, k: usize) -> Encounter {
        self.view.encounter(self.entries[k], self.geometry.gap.unpack()[k])
    }

    /// All of pair `k`.
    #[inline(always)]
    pub fn pair(&self, k: usize) -> Pair {
        let g = self.geometry;
        let [first_class, second_class] = self.classes(k);
        Pair {
            encounter: self.encounter(k),
            first_class,
            second_class,
            radii: [g.radii[0].unpack()[k], g.radii[1].unpack()[k]],
            normal: g.normal.unpack()[k],
            half_step_normal: g.half_step_normal.unpack()[k],
            separation_speed: g.separation_speed.unpack()[k],
            slip: g.slip.unpack()[k],
            spin: g.spin.unpack()[k],
            expected_spin: g.expected_spin.unpack()[k],
            rolling_inertia: g.rolling_inertia.unpack()[k],
            levers: [g.levers[0].unpack()[k], g.levers[1].unpack()[k]],
            time_step: g.time_step,
        }
    }
}

impl<L: Lane> std::fmt::Debug for Pairs<'_, L> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Pairs({} side by side)", L::WIDTH)
    }
}

/// [`Load`]s side by side.
#[derive(Debug, Clone, Copy)]
pub struct Loads<L> {
    /// Force along the normal, N, positive when the bodies attract each other.
    pub tension: L,
    /// Force on the first body across the normal, N.
    pub shear: Vector<L>,
    /// Torque on the first body, N m; the second gets the opposite.
    pub couple: Vector<L>,
    /// Torque of rolling friction on the first body, N m.
    pub rolling: Vector<L>,
    /// The pairs that want attention, one bit each.
    pub attention: u32,
}

impl<L: Lane> Loads<L> {
    /// Nothing acts.
    #[must_use]
    #[inline(always)]
    pub fn none(permit: L::Permit) -> Self {
        let zero = Vector::zero(permit);
        let tension = L::splat(permit, 0.0);
        Self { tension, shear: zero, couple: zero, rolling: zero, attention: 0 }
    }

    /// Puts single loads side by side.
    #[inline(always)]
    pub fn pack(permit: L::Permit, loads: &L::Each<Load>) -> Self {
        let bits = (0..L::WIDTH).map(|k| u32::from(loads[k].attention) << k);
        Self {
            tension: L::pack(permit, loads, |l| l.tension),
            shear: Vector::<L>::pack(permit, loads, |l| l.shear),
            couple: Vector::<L>::pack(permit, loads, |l| l.couple),
            rolling: Vector::<L>::pack(permit, loads, |l| l.rolling),
            attention: bits.sum(),
        }
    }
}

impl Loads<f64> {
    #[inline(always)]
    /// The load of a single pair.
    #[must_use]
    pub fn single(self) -> Load {
        let vector = |v: Vector<f64>| DVec3::new(v.x, v.y, v.z);
        let (shear, couple) = (vector(self.shear), vector(self.couple));
        let rolling = vector(self.rolling);
        Load { tension: self.tension, shear, couple, rolling, attention: self.attention != 0 }
    }
}

impl<L: Lane> std::ops::Add for Loads<L> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            tension: self.tension + other.tension,
            shear: self.shear + other.shear,
            couple: self.couple + other.couple,
            rolling: self.rolling + other.rolling,
            attention: self.attention | other.attention,
        }
    }
}

/// The columns of pairs side by side.
pub trait Columns<C> {
    /// The column of pair `k`.
    fn column(&mut self, k: usize) -> &mut C;
}

/// A single column.
impl<C> Columns<C> for &mut C {
    #[inline(always)]
    fn column(&mut self, _: usize) -> &mut C {
        self
    }
}

/// Columns of a list at given places.
pub(crate) struct Picked<'a, C> {
    pub(crate) columns: &'a mut [C],
    pub(crate) at: &'a [u32],
}

impl<C> Columns<C> for Picked<'_, C> {
    #[inline(always)]
    fn column(&mut self, k: usize) -> &mut C {
        &mut self.columns[self.at[k] as usize]
    }
}

/// The first or second part of columns that are tuples.
pub(crate) struct Part<'a, P, O> {
    pub(crate) whole: &'a mut P,
    other: std::marker::PhantomData<O>,
}

impl<'a, P, O> Part<'a, P, O> {
    #[inline(always)]
    pub(crate) fn of(whole: &'a mut P) -> Self {
        Self { whole, other: std::marker::PhantomData }
    }
}

/// Marks the first part; the type is that of the second.
pub(crate) struct First<B>(std::marker::PhantomData<B>);
/// Marks the second part; the type is that of the first.
pub(crate) struct Second<A>(std::marker::PhantomData<A>);

impl<A, B, P: Columns<(A, B)>> Columns<A> for Part<'_, P, First<B>> {
    #[inline(always)]
    fn column(&mut self, k: usize) -> &mut A {
        &mut self.whole.column(k).0
    }
}

impl<A, B, P: Columns<(A, B)>> Columns<B> for Part<'_, P, Second<A>> {
    #[inline(always)]
    fn column(&mut self, k: usize) -> &mut B {
        &mut self.whole.column(k).1
    }
}
