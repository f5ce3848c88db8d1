//! Eight numbers in one register, where the machine has such.

use std::arch::x86_64::{__m256d, __m512d, __mmask8, _CMP_LT_OQ};
use std::ops::{Add, Div, Mul, Neg, Sub};

use pulp::x86::V4;

use crate::Lane;
use crate::logarithm::{LEAST, MAGIC, MAGIC_AND_BIAS, MANTISSA, SHIFT};

/// Eight numbers side by side in one register.
#[derive(Debug, Clone, Copy)]
pub struct Avx512 {
    permit: V4,
    all: __m512d,
}

macro_rules! operator {
    ($($trait:ident $method:ident $instruction:ident)+) => {$(
        impl $trait for Avx512 {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self { all: self.permit.avx512f.$instruction(self.all, other.all), ..self }
            }
        }
    )+};
}

operator! { Add add _mm512_add_pd Sub sub _mm512_sub_pd Mul mul _mm512_mul_pd Div div _mm512_div_pd }

impl Neg for Avx512 {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        let minus = self.permit.avx512f._mm512_set1_pd(-0.0);
        Self { all: self.permit.avx512dq._mm512_xor_pd(self.all, minus), ..self }
    }
}

impl Avx512 {
    #[inline(always)]
    fn less(self, bound: Self) -> __mmask8 {
        self.permit.avx512f._mm512_cmp_pd_mask::<_CMP_LT_OQ>(self.all, bound.all)
    }
}

/// Two rows in one register.
#[inline(always)]
fn both(permit: V4, low: [f64; 4], high: [f64; 4]) -> __m512d {
    let (low, high): (__m256d, __m256d) = (pulp::cast(low), pulp::cast(high));
    permit.avx512f._mm512_insertf64x4::<1>(permit.avx512f._mm512_castpd256_pd512(low), high)
}

impl Lane for Avx512 {
    const WIDTH: usize = 8;

    type Permit = V4;

    type Each<T> = [T; 8];

    #[inline(always)]
    fn permit(self) -> V4 {
        self.permit
    }

    #[inline(always)]
    fn each<T>(mut make: impl FnMut(usize) -> T) -> [T; 8] {
        [make(0), make(1), make(2), make(3), make(4), make(5), make(6), make(7)]
    }

    #[inline(always)]
    fn pack<T>(permit: V4, from: &[T; 8], read: impl Fn(&T) -> f64) -> Self {
        let [a, b, c, d, e, f, g, h] = from;
        let low = [read(a), read(b), read(c), read(d)];
        Self { permit, all: both(permit, low, [read(e), read(f), read(g), read(h)]) }
    }

    #[inline(always)]
    fn rows<T>(permit: V4, from: &[T; 8], read: impl Fn(&T) -> [f64; 4]) -> [Self; 4] {
        let avx = permit.avx512f;
        let [a, b, c, d, e, f, g, h] = from;
        // Neighbours in two registers, so that the columns come out in order.
        let (ac, bd) = (both(permit, read(a), read(c)), both(permit, read(b), read(d)));
        let (eg, fh) = (both(permit, read(e), read(g)), both(permit, read(f), read(h)));
        let (low, high) = (avx._mm512_unpacklo_pd(ac, bd), avx._mm512_unpackhi_pd(ac, bd));
        let (low_too, high_too) = (avx._mm512_unpacklo_pd(eg, fh), avx._mm512_unpackhi_pd(eg, fh));
        [
            Self { permit, all: avx._mm512_shuffle_f64x2::<0b10_00_10_00>(low, low_too) },
            Self { permit, all: avx._mm512_shuffle_f64x2::<0b10_00_10_00>(high, high_too) },
            Self { permit, all: avx._mm512_shuffle_f64x2::<0b11_01_11_01>(low, low_too) },
            Self { permit, all: avx._mm512_shuffle_f64x2::<0b11_01_11_01>(high, high_too) },
        ]
    }

    #[inline(always)]
    fn unpack(self) -> [f64; 8] {
        pulp::cast(self.all)
    }

    #[inline(always)]
    fn unpack_rows([x, y, z, w]: [Self; 4]) -> [[f64; 4]; 8] {
        let avx = x.permit.avx512f;
        let (even, odd) =
            (avx._mm512_unpacklo_pd(x.all, y.all), avx._mm512_unpackhi_pd(x.all, y.all));
        let (even_end, odd_end) =
            (avx._mm512_unpacklo_pd(z.all, w.all), avx._mm512_unpackhi_pd(z.all, w.all));
        let low = pulp::cast([0_u64, 1, 8, 9, 2, 3, 10, 11]);
        let high = pulp::cast([4_u64, 5, 12, 13, 6, 7, 14, 15]);
        let [a, c] = pulp::cast(avx._mm512_permutex2var_pd(even, low, even_end));
        let [b, d] = pulp::cast(avx._mm512_permutex2var_pd(odd, low, odd_end));
        let [e, g] = pulp::cast(avx._mm512_permutex2var_pd(even, high, even_end));
        let [f, h] = pulp::cast(avx._mm512_permutex2var_pd(odd, high, odd_end));
        [a, b, c, d, e, f, g, h]
    }

    #[inline(always)]
    fn splat(permit: V4, value: f64) -> Self {
        Self { permit, all: permit.avx512f._mm512_set1_pd(value) }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self { all: self.permit.avx512f._mm512_sqrt_pd(self.all), ..self }
    }

    #[inline(always)]
    fn split(self) -> [Self; 2] {
        let avx = self.permit.avx512f;
        let shift = avx._mm512_set1_epi64(SHIFT.cast_signed());
        let mask = avx._mm512_set1_epi64(MANTISSA.cast_signed());
        let least = avx._mm512_set1_epi64(LEAST.cast_signed());
        let magic = avx._mm512_set1_epi64(MAGIC.cast_signed());
        let shifted = avx._mm512_add_epi64(avx._mm512_castpd_si512(self.all), shift);
        let mantissa = avx._mm512_add_epi64(avx._mm512_and_si512(shifted, mask), least);
        let exponent = avx._mm512_or_si512(avx._mm512_srli_epi64::<52>(shifted), magic);
        let exponent = avx._mm512_castsi512_pd(exponent);
        let all = avx._mm512_sub_pd(exponent, avx._mm512_set1_pd(MAGIC_AND_BIAS));
        [Self { all: avx._mm512_castsi512_pd(mantissa), ..self }, Self { all, ..self }]
    }

    #[inline(always)]
    fn least(self, other: Self) -> Self {
        Self { all: self.permit.avx512f._mm512_min_pd(self.all, other.all), ..self }
    }

    #[inline(always)]
    fn most(self, other: Self) -> Self {
        Self { all: self.permit.avx512f._mm512_max_pd(self.all, other.all), ..self }
    }

    #[inline(always)]
    fn if_less(self, bound: Self, then: Self, otherwise: Self) -> Self {
        let less = self.less(bound);
        let all = self.permit.avx512f._mm512_mask_blend_pd(less, otherwise.all, then.all);
        Self { all, ..self }
    }

    #[inline(always)]
    fn less_bits(self, bound: Self) -> u32 {
        u32::from(self.less(bound))
    }
}
