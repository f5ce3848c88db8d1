use std::f64::consts::PI;
use std::sync::OnceLock;

/// How finely a meridian is integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rule {
    /// 80 points: to rounding.
    Fine,
    /// 36 points: 1e-7 or better, at half the cost.
    Coarse,
}

impl Rule {
    /// Nodes in (0, 1) and weights of the Gauss-Legendre rule.
    pub(super) fn points(self) -> &'static [(f64, f64)] {
        static FINE: OnceLock<Vec<(f64, f64)>> = OnceLock::new();
        static COARSE: OnceLock<Vec<(f64, f64)>> = OnceLock::new();
        match self {
            Self::Fine => FINE.get_or_init(|| rule(80)),
            Self::Coarse => COARSE.get_or_init(|| rule(36)),
        }
    }
}

fn rule(points: usize) -> Vec<(f64, f64)> {
    (0..points).map(|k| node(k, points)).collect()
}

/// The k-th node and its weight on (0, 1), by Newton's method.
fn node(k: usize, points: usize) -> (f64, f64) {
    let mut x = (PI * (k as f64 + 0.75) / (points as f64 + 0.5)).cos();
    let mut slope = 1.0;
    for _ in 0..8 {
        let (value, derivative) = legendre(x, points);
        x -= value / derivative;
        slope = derivative;
    }
    (0.5 * (1.0 - x), 1.0 / ((1.0 - x * x) * slope * slope))
}

/// Legendre polynomial of a degree and its derivative at `x`.
fn legendre(x: f64, degree: usize) -> (f64, f64) {
    let (mut before, mut now) = (1.0, x);
    for k in 2..=degree {
        let k = k as f64;
        let next = ((2.0 * k - 1.0) * x * now - (k - 1.0) * before) / k;
        (before, now) = (now, next);
    }
    (now, degree as f64 * (x * now - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_polynomials_and_a_square_root_of_a_quadratic() {
        let points = Rule::Fine.points();
        let sum = |f: &dyn Fn(f64) -> f64| points.iter().map(|&(t, w)| w * f(t)).sum::<f64>();
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
