//! The natural logarithm of several numbers at once.
//!
//! ln x = k ln 2 + ln m with m = 1 + f in [√½, √2), and with s = f/(2 + f)
//! ln m = f − f²/2 + s (f²/2 + R(s²)); R and the error bound, one unit in the last place, are those
//! of FreeBSD's `e_log.c` (Sun Microsystems, 1993).

use crate::Lane;

/// Bits of √½, cut off.
pub(super) const LEAST: u64 = 0x3fe6_a09e_0000_0000;
/// What brings √½ to a mantissa of zeros, the exponent still biased.
pub(super) const SHIFT: u64 = 0x3ff0_0000_0000_0000 - LEAST;
/// The bits of a mantissa.
pub(super) const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
/// 2^52: a small whole number in its last bits is added to it.
pub(super) const MAGIC: u64 = 0x4330_0000_0000_0000;
/// The same with the exponent's bias.
pub(super) const MAGIC_AND_BIAS: f64 = 4_503_599_627_370_496.0 + 1023.0;

const LN2_HIGH: f64 = 6.931_471_803_691_238e-1;
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;
/// R(z) = Σ SERIES[k] z^(k+1).
const SERIES: [f64; 7] = [
    6.666_666_666_666_735e-1,
    3.999_999_999_940_942e-1,
    2.857_142_874_366_239e-1,
    2.222_219_843_214_978_4e-1,
    1.818_357_216_161_805e-1,
    1.531_383_769_920_937_3e-1,
    1.479_819_860_511_658_6e-1,
];

/// Mantissa and exponent of one number.
#[inline(always)]
pub(super) fn split(x: f64) -> [f64; 2] {
    let shifted = x.to_bits().wrapping_add(SHIFT);
    let mantissa = (shifted & MANTISSA) + LEAST;
    let exponent = f64::from_bits(shifted >> 52 | MAGIC) - MAGIC_AND_BIAS;
    [f64::from_bits(mantissa), exponent]
}

#[inline(always)]
pub(super) fn of<L: Lane>(x: L) -> L {
    let permit = x.permit();
    let [m, k] = x.split();
    let f = m - L::splat(permit, 1.0);
    let s = f / (L::splat(permit, 2.0) + f);
    let z = s * s;
    // Two sums that do not wait for each other.
    let square = z * z;
    let of = |k: usize| L::splat(permit, SERIES[k]);
    let odd = of(1) + square * (of(3) + square * of(5));
    let even = of(0) + square * (of(2) + square * (of(4) + square * of(6)));
    let series = even + z * odd;
    let half_square = L::splat(permit, 0.5) * f * f;
    let small = s * (half_square + z * series) + k * L::splat(permit, LN2_LOW);
    k * L::splat(permit, LN2_HIGH) - ((half_square - small) - f)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_logarithm_to_a_unit_in_the_last_place() {
        assert_eq!(1.0.logarithm(), 0.0);
        for k in 1..200_000_u32 {
            let near = 1.0 + f64::from(k) * 1e-5;
            for x in [near, 1.0 / near, 1e-3 * f64::from(k).powi(7), 1e-300 * near, 1e300 * near] {
                let error = (x.logarithm() - x.ln()).abs();
                assert!(error <= 1.01 * f64::EPSILON * x.ln().abs(), "{x:e}: {error:e}");
            }
        }
    }
}
