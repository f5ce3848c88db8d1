use std::f64::consts::PI;

/// The k-th of `count` Chebyshev points on [0, 1], both ends included.
pub(super) fn node(k: usize, count: usize) -> f64 {
    0.5 - 0.5 * (PI * k as f64 / (count - 1) as f64).cos()
}

/// Chebyshev coefficients on [0, 1] of the polynomial through `values` at [`node`]s.
pub(super) fn coefficients(values: &[f64]) -> Vec<f64> {
    let last = values.len() - 1;
    let end = |k: usize| if k == 0 || k == last { 0.5 } else { 1.0 };
    let term = |n: usize| {
        // The angle is reduced in integers, so that the sums are exact to rounding.
        let wave = |k: usize| (PI * ((k * n) % (2 * last)) as f64 / last as f64).cos();
        let sum: f64 = (0..=last).map(|k| end(k) * values[k] * wave(k)).sum();
        let sign = if n.is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * end(n) * sum * 2.0 / last as f64
    };
    (0..=last).map(term).collect()
}

/// T₀ … of the shifted Chebyshev polynomials at `x` in [0, 1].
pub(super) fn polynomials<const N: usize>(x: f64) -> [f64; N] {
    let z = 2.0 * x - 1.0;
    let mut t = [1.0; N];
    if N > 1 {
        t[1] = z;
    }
    for n in 2..N {
        t[n] = 2.0 * z * t[n - 1] - t[n - 2];
    }
    t
}

/// Monomial coefficients of a sum of shifted Chebyshev polynomials on [0, 1].
pub(super) fn to_monomials<const N: usize>(chebyshev: &[f64; N]) -> [f64; N] {
    // T_{n+1}(z) = 2 z T_n − T_{n−1} with z = 2 x − 1, on the coefficients of x.
    let mut sum = [0.0; N];
    let (mut before, mut now) = ([0.0; N], [0.0; N]);
    now[0] = 1.0;
    for (n, &c) in chebyshev.iter().enumerate() {
        for (entry, term) in sum.iter_mut().zip(now) {
            *entry += c * term;
        }
        let factor = if n == 0 { 1.0 } else { 2.0 };
        let mut next = [0.0; N];
        for k in 0..N {
            let raised = if k > 0 { 2.0 * now[k - 1] } else { 0.0 };
            next[k] = factor * (raised - now[k]) - before[k];
        }
        (before, now) = (if n == 0 { unit() } else { now }, next);
    }
    sum
}

fn unit<const N: usize>() -> [f64; N] {
    let mut first = [0.0; N];
    first[0] = 1.0;
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_comes_back_in_both_bases() {
        let f = |x: f64| 3.0 - 2.0 * x + 0.5 * x * x - 7.0 * x * x * x;
        let values: Vec<f64> = (0..6).map(|k| f(node(k, 6))).collect();
        let series = coefficients(&values);
        for x in [0.0, 0.2, 0.9, 1.0] {
            let t: [f64; 6] = polynomials(x);
            let sum: f64 = t.iter().zip(&series).map(|(a, b)| a * b).sum();
            assert!((sum - f(x)).abs() < 1e-14);
        }
        let array: [f64; 6] = series.try_into().unwrap();
        let monomials = to_monomials(&array);
        for (found, known) in monomials.iter().zip([3.0, -2.0, 0.5, -7.0, 0.0, 0.0]) {
            assert!((found - known).abs() < 1e-12, "{monomials:?}");
        }
    }
}
