//! Four numbers in one register, where the machine has such.

use std::arch::x86_64::{__m256d, _CMP_LT_OQ};
use std::ops::{Add, Div, Mul, Neg, Sub};

use pulp::x86::V3;

use crate::Lane;
use crate::logarithm::{LEAST, MAGIC, MAGIC_AND_BIAS, MANTISSA, SHIFT};

/// Four numbers side by side in one register.
#[derive(Debug, Clone, Copy)]
pub struct Avx {
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

/// Rows of four as columns.
#[inline(always)]
fn turned(permit: V3, [a, b, c, d]: [__m256d; 4]) -> [__m256d; 4] {
    let avx = permit.avx;
    let (low, high) = (avx._mm256_unpacklo_pd(a, b), avx._mm256_unpackhi_pd(a, b));
    let (low_too, high_too) = (avx._mm256_unpacklo_pd(c, d), avx._mm256_unpackhi_pd(c, d));
    [
        avx._mm256_permute2f128_pd::<0x20>(low, low_too),
        avx._mm256_permute2f128_pd::<0x20>(high, high_too),
        avx._mm256_permute2f128_pd::<0x31>(low, low_too),
        avx._mm256_permute2f128_pd::<0x31>(high, high_too),
    ]
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
    fn rows<T>(permit: V3, from: &[T; 4], read: impl Fn(&T) -> [f64; 4]) -> [Self; 4] {
        let [a, b, c, d] = [read(&from[0]), read(&from[1]), read(&from[2]), read(&from[3])];
        let [a, b, c, d] =
            turned(permit, [pulp::cast(a), pulp::cast(b), pulp::cast(c), pulp::cast(d)]);
        // No closures: what is not inlined could not use the registers.
        [
            Self { permit, all: a },
            Self { permit, all: b },
            Self { permit, all: c },
            Self { permit, all: d },
        ]
    }

    #[inline(always)]
    fn unpack(self) -> [f64; 4] {
        pulp::cast(self.all)
    }

    #[inline(always)]
    fn unpack_rows([a, b, c, d]: [Self; 4]) -> [[f64; 4]; 4] {
        let [a, b, c, d] = turned(a.permit, [a.all, b.all, c.all, d.all]);
        [pulp::cast(a), pulp::cast(b), pulp::cast(c), pulp::cast(d)]
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
    fn split(self) -> [Self; 2] {
        let (avx, avx2) = (self.permit.avx, self.permit.avx2);
        let shift = avx._mm256_set1_epi64x(SHIFT.cast_signed());
        let mask = avx._mm256_set1_epi64x(MANTISSA.cast_signed());
        let least = avx._mm256_set1_epi64x(LEAST.cast_signed());
        let magic = avx._mm256_set1_epi64x(MAGIC.cast_signed());
        let shifted = avx2._mm256_add_epi64(avx._mm256_castpd_si256(self.all), shift);
        let mantissa = avx2._mm256_and_si256(shifted, mask);
        let mantissa = avx2._mm256_add_epi64(mantissa, least);
        let exponent = avx2._mm256_srli_epi64::<52>(shifted);
        let exponent = avx2._mm256_or_si256(exponent, magic);
        let exponent = avx._mm256_castsi256_pd(exponent);
        let all = avx._mm256_sub_pd(exponent, avx._mm256_set1_pd(MAGIC_AND_BIAS));
        [Self { all: avx._mm256_castsi256_pd(mantissa), ..self }, Self { all, ..self }]
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
    fn less_bits(self, bound: Self) -> u32 {
        self.permit.avx._mm256_movemask_pd(self.less(bound)).cast_unsigned()
    }
}
