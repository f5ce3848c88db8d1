//! Vectors of numbers that may be several at once.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

use glam::DVec3;
#[cfg(target_arch = "x86_64")]
use pendular_lane::{Avx, Avx512};
pub use pendular_lane::{Four, Lane};

/// Work on numbers side by side.
pub(crate) trait Kernel: Sized {
    /// Does it; inlined, so that it may use whatever registers the lanes stand for.
    fn run<L: Lane>(self, permit: L::Permit);
}

/// Does work in the widest registers that this machine has; the same operations, the same bits.
pub(crate) fn in_widest(kernel: impl Kernel) {
    match pulp::Arch::new() {
        #[cfg(target_arch = "x86_64")]
        pulp::Arch::V4(permit) => permit.vectorize(With::<_, Avx512> { kernel, permit }),
        #[cfg(target_arch = "x86_64")]
        pulp::Arch::V3(permit) => permit.vectorize(With::<_, Avx> { kernel, permit }),
        arch => arch.dispatch(With::<_, Four> { kernel, permit: () }),
    }
}

struct With<K, L: Lane> {
    kernel: K,
    permit: L::Permit,
}

impl<K: Kernel, L: Lane> pulp::NullaryFnOnce for With<K, L> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.kernel.run::<L>(self.permit);
    }
}

/// A vector, or several side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vector<L> {
    /// First component.
    pub x: L,
    /// Second component.
    pub y: L,
    /// Third component.
    pub z: L,
}

impl<L: Lane> Vector<L> {
    /// The zero vector in each lane.
    #[must_use]
    #[inline(always)]
    pub fn zero(permit: L::Permit) -> Self {
        let zero = L::splat(permit, 0.0);
        Self { x: zero, y: zero, z: zero }
    }

    /// Reads a vector out of each.
    #[inline(always)]
    pub fn pack<T>(permit: L::Permit, from: &L::Each<T>, read: impl Fn(&T) -> DVec3) -> Self {
        Self {
            x: L::pack(permit, from, |t| read(t).x),
            y: L::pack(permit, from, |t| read(t).y),
            z: L::pack(permit, from, |t| read(t).z),
        }
    }

    /// The vectors.
    #[inline(always)]
    pub fn unpack(self) -> L::Each<DVec3> {
        let (x, y, z) = (self.x.unpack(), self.y.unpack(), self.z.unpack());
        L::each(|k| DVec3::new(x[k], y[k], z[k]))
    }

    /// The vectors, a zero behind each.
    #[inline(always)]
    pub(crate) fn rows(self, permit: L::Permit) -> L::Each<[f64; 4]> {
        L::unpack_rows([self.x, self.y, self.z, L::splat(permit, 0.0)])
    }

    /// Scalar product.
    #[must_use]
    #[inline(always)]
    pub fn dot(self, other: Self) -> L {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Vector product.
    #[must_use]
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    /// In each lane `then` where `value` is less than `bound`, else `otherwise`.
    #[must_use]
    #[inline(always)]
    pub fn if_less(value: L, bound: L, then: Self, otherwise: Self) -> Self {
        Self {
            x: value.if_less(bound, then.x, otherwise.x),
            y: value.if_less(bound, then.y, otherwise.y),
            z: value.if_less(bound, then.z, otherwise.z),
        }
    }
}

impl<L: Lane> Add for Vector<L> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<L: Lane> AddAssign for Vector<L> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<L: Lane> Sub for Vector<L> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<L: Lane> Neg for Vector<L> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y, z: -self.z }
    }
}

impl<L: Lane> Mul<L> for Vector<L> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: L) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}
