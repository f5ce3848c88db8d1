//! Numbers that may be several at once.
//!
//! Kernels are written once, over a [`Lane`]: `f64` is one number, [`Four`] are four side by side, and
//! on x86-64 [`Avx`] are four in one register of a machine that has such. All do the same operations
//! in the same order, so they give the same bits.

#[cfg(target_arch = "x86_64")]
mod avx;
mod logarithm;

#[cfg(target_arch = "x86_64")]
pub use avx::Avx;

/// The README's program runs as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

use std::ops::{Add, Div, IndexMut, Mul, Neg, Sub};

use wide::f64x4;

/// One number, or several of independent pairs side by side.
pub trait Lane:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// How many numbers there are.
    const WIDTH: usize;

    /// What it takes to make numbers: a proof that this machine has the registers for them.
    type Permit: Copy + Send + Sync;

    /// What these numbers were made with.
    fn permit(self) -> Self::Permit;

    /// Something of each.
    type Each<T>: IndexMut<usize, Output = T>;

    /// Makes something of each lane.
    fn each<T>(make: impl FnMut(usize) -> T) -> Self::Each<T>;

    /// Reads a number out of each.
    fn pack<T>(permit: Self::Permit, from: &Self::Each<T>, read: impl Fn(&T) -> f64) -> Self;

    /// Reads four numbers that lie one behind the other out of each.
    #[inline(always)]
    fn rows<T>(
        permit: Self::Permit,
        from: &Self::Each<T>,
        read: impl Fn(&T) -> [f64; 4],
    ) -> [Self; 4] {
        [
            Self::pack(permit, from, |t| read(t)[0]),
            Self::pack(permit, from, |t| read(t)[1]),
            Self::pack(permit, from, |t| read(t)[2]),
            Self::pack(permit, from, |t| read(t)[3]),
        ]
    }

    /// The numbers.
    fn unpack(self) -> Self::Each<f64>;

    /// The same number in each lane.
    fn splat(permit: Self::Permit, value: f64) -> Self;

    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;

    /// Mantissa m in [√½, √2) and exponent k of each positive normal number m 2^k; something finite
    /// or not, but the same in every kind of lane, for anything else.
    fn split(self) -> [Self; 2];

    /// Natural logarithm of each positive normal number, to a unit in the last place.
    #[must_use]
    #[inline(always)]
    fn logarithm(self) -> Self {
        logarithm::of(self)
    }

    /// The smaller of the two; `other` if they cannot be compared.
    #[must_use]
    fn least(self, other: Self) -> Self;

    /// The larger of the two; `other` if they cannot be compared.
    #[must_use]
    fn most(self, other: Self) -> Self;

    /// In each lane `then` where `self` is less than `bound`, else `otherwise`.
    #[must_use]
    fn if_less(self, bound: Self, then: Self, otherwise: Self) -> Self;

    /// Whether `self` is less than `bound` in any lane.
    fn any_less(self, bound: Self) -> bool;
}

impl Lane for f64 {
    const WIDTH: usize = 1;

    type Permit = ();

    #[inline(always)]
    fn permit(self) {}

    type Each<T> = [T; 1];

    #[inline(always)]
    fn each<T>(mut make: impl FnMut(usize) -> T) -> [T; 1] {
        [make(0)]
    }

    #[inline(always)]
    fn pack<T>((): (), from: &[T; 1], read: impl Fn(&T) -> f64) -> f64 {
        read(&from[0])
    }

    #[inline(always)]
    fn unpack(self) -> [f64; 1] {
        [self]
    }

    #[inline(always)]
    fn splat((): (), value: f64) -> f64 {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> f64 {
        self.sqrt()
    }

    #[inline(always)]
    fn split(self) -> [f64; 2] {
        logarithm::split(self)
    }

    #[inline(always)]
    fn least(self, other: f64) -> f64 {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn most(self, other: f64) -> f64 {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn if_less(self, bound: f64, then: f64, otherwise: f64) -> f64 {
        if self < bound { then } else { otherwise }
    }

    #[inline(always)]
    fn any_less(self, bound: f64) -> bool {
        self < bound
    }
}

/// Four numbers side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Four(f64x4);

macro_rules! four_operator {
    ($($trait:ident $method:ident $operator:tt)+) => {$(
        impl $trait for Four {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $operator other.0)
            }
        }
    )+};
}

four_operator! { Add add + Sub sub - Mul mul * Div div / }

impl Neg for Four {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Lane for Four {
    const WIDTH: usize = 4;

    type Permit = ();

    #[inline(always)]
    fn permit(self) {}

    type Each<T> = [T; 4];

    #[inline(always)]
    fn each<T>(mut make: impl FnMut(usize) -> T) -> [T; 4] {
        // Not `std::array::from_fn`: that leaves a loop and all arrays in memory.
        [make(0), make(1), make(2), make(3)]
    }

    #[inline(always)]
    fn pack<T>((): (), from: &[T; 4], read: impl Fn(&T) -> f64) -> Self {
        Self(f64x4::new([read(&from[0]), read(&from[1]), read(&from[2]), read(&from[3])]))
    }

    #[inline(always)]
    fn unpack(self) -> [f64; 4] {
        self.0.to_array()
    }

    #[inline(always)]
    fn splat((): (), value: f64) -> Self {
        Self(f64x4::splat(value))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn split(self) -> [Self; 2] {
        let [a, b, c, d] = self.unpack().map(logarithm::split);
        let side = |k: usize| Self(f64x4::new([a[k], b[k], c[k], d[k]]));
        [side(0), side(1)]
    }

    #[inline(always)]
    fn least(self, other: Self) -> Self {
        Self(self.0.fast_min(other.0))
    }

    #[inline(always)]
    fn most(self, other: Self) -> Self {
        Self(self.0.fast_max(other.0))
    }

    #[inline(always)]
    fn if_less(self, bound: Self, then: Self, otherwise: Self) -> Self {
        Self(self.0.simd_lt(bound.0).bitselect(then.0, otherwise.0))
    }

    #[inline(always)]
    fn any_less(self, bound: Self) -> bool {
        self.0.simd_lt(bound.0).any()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn four_do_what_one_does<L: Lane<Each<f64> = [f64; 4]>>(permit: L::Permit) {
        let a = [1.5, -0.0, 2.0 / 3.0, 3e300];
        let b = [0.1, 0.5, 1.0, -7.0];
        let one = |f: fn(f64, f64) -> f64| [0, 1, 2, 3].map(|k| f(a[k], b[k]).to_bits());
        let pack = |all: &[f64; 4]| L::pack(permit, all, |v| *v);
        let four = |f: fn(L, L) -> L| f(pack(&a), pack(&b)).unpack().map(f64::to_bits);
        assert_eq!(one(|a, b| a * b + a / b - b), four(|a, b| a * b + a / b - b));
        assert_eq!(one(Lane::least), four(|a, b| a.least(b)));
        assert_eq!(one(|a, b| Lane::most(b, a)), four(|a, b| b.most(a)));
        assert_eq!(one(|a, b| Lane::sqrt(a * a + b)), four(|a, b| (a * a + b).sqrt()));
        assert_eq!(
            one(|a, b| (a * a + b * b).logarithm()),
            four(|a, b| (a * a + b * b).logarithm())
        );
        assert_eq!(one(|a, b| a.if_less(b, -a, b)), four(|a, b| a.if_less(b, -a, b)));
        let rows = [a, b, [2.0; 4], [0.0, 1.0, 2.0, 3.0]];
        let columns = L::rows(permit, &L::each(|k| rows[k]), |row| *row).map(L::unpack);
        assert!((0..16).all(|k| columns[k / 4][k % 4].to_bits() == rows[k % 4][k / 4].to_bits()));
        assert!(pack(&a).any_less(pack(&b)) && !pack(&a).any_less(pack(&a)));
        let (nan, two) = (L::splat(permit, f64::NAN), L::splat(permit, 2.0));
        assert_eq!((nan.least(two).unpack(), nan.most(two).unpack()), ([2.0; 4], [2.0; 4]));
        assert!(!nan.any_less(two));
    }

    #[test]
    fn four_do_what_one_does_to_the_bit() {
        four_do_what_one_does::<Four>(());
        #[cfg(target_arch = "x86_64")]
        if let Some(permit) = pulp::x86::V3::try_new() {
            four_do_what_one_does::<Avx>(permit);
        }
        assert_eq!((Lane::least(f64::NAN, 2.0), Lane::most(f64::NAN, 2.0)), (2.0, 2.0));
    }
}
