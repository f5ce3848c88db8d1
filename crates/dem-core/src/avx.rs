//! Four numbers in one register, where the machine has such.

use std::arch::x86_64::{__m256d, _CMP_LT_OQ};
use std::ops::{Add, Div, Mul, Neg, Sub};

use pulp::x86::V3;

use crate::Lane;

/// Four numbers side by side in one register.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Avx {
    permit: V3,
    all: __m256d,
}

macro_rules! operator {
    ($($trait:ident $method:ident $instruction:ident)+) => {$(
        impl $trait for Avx {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self { all: self.permit.avx.$instruction(self.all, other.all), ..self }
            }
        }
    )+};
}

operator! { Add add _mm256_add_pd Sub sub _mm256_sub_pd Mul mul _mm256_mul_pd Div div _mm256_div_pd }

impl Neg for Avx {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        let avx = self.permit.avx;
        Self { all: avx._mm256_xor_pd(self.all, avx._mm256_set1_pd(-0.0)), ..self }
    }
}

impl Avx {
    #[inline(always)]
    fn less(self, bound: Self) -> __m256d {
        self.permit.avx._mm256_cmp_pd::<_CMP_LT_OQ>(self.all, bound.all)
    }
}

impl Lane for Avx {
    const WIDTH: usize = 4;

    type Permit = V3;

    type Each<T> = [T; 4];

    #[inline(always)]
    fn permit(self) -> V3 {
        self.permit
    }

    #[inline(always)]
    fn each<T>(mut make: impl FnMut(usize) -> T) -> [T; 4] {
        [make(0), make(1), make(2), make(3)]
    }

    #[inline(always)]
    fn pack<T>(permit: V3, from: &[T; 4], read: impl Fn(&T) -> f64) -> Self {
        let [a, b, c, d] = from;
        Self { permit, all: permit.avx._mm256_setr_pd(read(a), read(b), read(c), read(d)) }
    }

    #[inline(always)]
    fn unpack(self) -> [f64; 4] {
        pulp::cast(self.all)
    }

    #[inline(always)]
    fn splat(permit: V3, value: f64) -> Self {
        Self { permit, all: permit.avx._mm256_set1_pd(value) }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self { all: self.permit.avx._mm256_sqrt_pd(self.all), ..self }
    }

    #[inline(always)]
    fn least(self, other: Self) -> Self {
        Self { all: self.permit.avx._mm256_min_pd(self.all, other.all), ..self }
    }

    #[inline(always)]
    fn most(self, other: Self) -> Self {
        Self { all: self.permit.avx._mm256_max_pd(self.all, other.all), ..self }
    }

    #[inline(always)]
    fn if_less(self, bound: Self, then: Self, otherwise: Self) -> Self {
        let less = self.less(bound);
        Self { all: self.permit.avx._mm256_blendv_pd(otherwise.all, then.all, less), ..self }
    }

    #[inline(always)]
    fn any_less(self, bound: Self) -> bool {
        self.permit.avx._mm256_movemask_pd(self.less(bound)) != 0
    }
}
