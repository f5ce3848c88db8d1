//! Numbers that may be several at once.
//!
//! Kernels are written once, over a [`Lane`]: `f64` is one number, [`Four`] are four side by side, and
//! on x86-64 [`Avx`] and [`Avx512`] are four and eight in one register of a machine that has such.
//! All do the same operations in the same order, so they give the same bits.

#[cfg(target_arch = "x86_64")]
mod avx;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod logarithm;

#[cfg(target_arch = "x86_64")]
pub use avx::Avx;
#[cfg(target_arch = "x86_64")]
pub use avx512::Avx512;

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

    /// The reverse of [`Lane::rows`]: four numbers that lie one behind the other, of each.
    #[inline(always)]
    fn unpack_rows(columns: [Self; 4]) -> Self::Each<[f64; 4]> {
        let [a, b, c, d] = columns.map(Self::unpack);
        Self::each(|k| [a[k], b[k], c[k], d[k]])
    }

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

    /// One bit for each lane in which `self` is less than `bound`.
    fn less_bits(self, bound: Self) -> u32;

    /// Whether `self` is less than `bound` in any lane.
    #[inline(always)]
    fn any_less(self, bound: Self) -> bool {
        self.less_bits(bound) != 0
    }
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
    fn less_bits(self, bound: f64) -> u32 {
        u32::from(self < bound)
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
    fn less_bits(self, bound: Self) -> u32 {
        self.0.simd_lt(bound.0).to_bitmask()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const A: [f64; 8] = [1.5, -0.0, 2.0 / 3.0, 3e300, -1.0, 0.3, 1e-300, 5.0];
    const B: [f64; 8] = [0.1, 0.5, 1.0, -7.0, 0.0, 0.3, -2.0, 1e-9];

    /// Whether a function gives of all numbers at once what it gives of each.
    fn same<L: Lane>(permit: L::Permit, one: fn(f64, f64) -> f64, all: fn(L, L) -> L) -> bool {
        let pack = |numbers: &[f64; 8]| L::pack(permit, &L::each(|k| numbers[k]), |v| *v);
        let given = all(pack(&A), pack(&B)).unpack();
        (0..L::WIDTH).all(|k| given[k].to_bits() == one(A[k], B[k]).to_bits())
    }

    fn all_do_what_one_does<L: Lane>(permit: L::Permit) {
        assert!(same::<L>(permit, |a, b| a * b + a / b - b, |a, b| a * b + a / b - b));
        assert!(same::<L>(permit, Lane::least, |a, b| a.least(b)));
        assert!(same::<L>(permit, |a, b| Lane::most(b, a), |a, b| b.most(a)));
        assert!(same::<L>(permit, |a, b| (a * a + b * b).sqrt(), |a, b| (a * a + b * b).sqrt()));
        assert!(same::<L>(permit, |a, b| -a + b, |a, b| -a + b));
        let one = |a: f64, b: f64| (a * a + b * b).logarithm();
        assert!(same::<L>(permit, one, |a, b| (a * a + b * b).logarithm()));
        assert!(same::<L>(permit, |a, b| a.if_less(b, -a, b), |a, b| a.if_less(b, -a, b)));
    }

    fn rows_are_turned_there_and_back<L: Lane>(permit: L::Permit) {
        let rows = L::each(|k| [A[k], B[k], 7.0 - k as f64, k as f64]);
        let columns = L::rows(permit, &rows, |row| *row);
        let back = L::unpack_rows(columns);
        let columns = columns.map(L::unpack);
        for k in 0..L::WIDTH {
            let column = [0, 1, 2, 3].map(|c: usize| columns[c][k]);
            assert_eq!(column.map(f64::to_bits), rows[k].map(f64::to_bits));
            assert_eq!(back[k].map(f64::to_bits), rows[k].map(f64::to_bits));
        }
    }

    fn several_behave<L: Lane>(permit: L::Permit) {
        all_do_what_one_does::<L>(permit);
        rows_are_turned_there_and_back::<L>(permit);
        let (nan, two) = (L::splat(permit, f64::NAN), L::splat(permit, 2.0));
        assert!((0..L::WIDTH).all(|k| nan.least(two).unpack()[k] == 2.0));
        assert!((0..L::WIDTH).all(|k| nan.most(two).unpack()[k] == 2.0));
        assert!(!nan.any_less(two) && !two.any_less(two));
        let last = L::pack(permit, &L::each(|k| k as f64), |v| *v);
        assert!(two.any_less(last) && last.any_less(two));
        assert_eq!(last.less_bits(two), 0b11);
    }

    #[test]
    fn several_do_what_one_does_to_the_bit() {
        several_behave::<Four>(());
        #[cfg(target_arch = "x86_64")]
        if let Some(permit) = pulp::x86::V3::try_new() {
            several_behave::<Avx>(permit);
        }
        #[cfg(target_arch = "x86_64")]
        if let Some(permit) = pulp::x86::V4::try_new() {
            several_behave::<Avx512>(permit);
        }
        assert_eq!((Lane::least(f64::NAN, 2.0), Lane::most(f64::NAN, 2.0)), (2.0, 2.0));
    }
}
