use std::f64::consts::PI;
use std::sync::OnceLock;

/// Points of the rule that the exact solver uses.
const POINTS: usize = 80;

/// Nodes in (0, 1) and weights of the Gauss-Legendre rule, found once by Newton's method.
pub(super) fn rule() -> &'static [(f64, f64); POINTS] {
    static RULE: OnceLock<[(f64, f64); POINTS]> = OnceLock::new();
    RULE.get_or_init(|| {
        let mut rule = [(0.5, 0.0); POINTS];
        for (k, entry) in rule.iter_mut().enumerate() {
            *entry = node(k);
        }
        rule
    })
}

/// The k-th node and its weight on (0, 1).
fn node(k: usize) -> (f64, f64) {
    let n = POINTS as f64;
    let mut x = (PI * (k as f64 + 0.75) / (n + 0.5)).cos();
    let mut slope = 1.0;
    for _ in 0..8 {
        let (value, derivative) = legendre(x);
        x -= value / derivative;
        slope = derivative;
    }
    (0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope))
}

/// Legendre polynomial of degree `POINTS` and its derivative at `x`.
fn legendre(x: f64) -> (f64, f64) {
    let (mut before, mut now) = (1.0, x);
    for k in 2..=POINTS {
        let k = k as f64;
        let next = ((2.0 * k - 1.0) * x * now - (k - 1.0) * before) / k;
        (before, now) = (now, next);
    }
    (now, POINTS as f64 * (x * now - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_polynomials_and_a_square_root_of_a_quadratic() {
        let sum = |f: &dyn Fn(f64) -> f64| rule().iter().map(|&(t, w)| w * f(t)).sum::<f64>();
        assert!((sum(&|_| 1.0) - 1.0).abs() < 1e-14);
        for degree in [1, 2, 17, 90, 159] {
            let exact = 1.0 / (f64::from(degree) + 1.0);
            assert!((sum(&|t| t.powi(degree)) - exact).abs() < 1e-14, "degree {degree}");
        }
        // ∫ sqrt(1 + t²) over (0, 1) = (√2 + asinh 1)/2
        let exact = 0.5 * (2.0_f64.sqrt() + 1.0_f64.asinh());
        assert!((sum(&|t| (1.0 + t * t).sqrt()) - exact).abs() < 1e-14);
    }
}
