//! A scalar root in a bracket.

/// Largest number of evaluations: bisection alone would need fewer than twice as many.
const MAX_EVALUATIONS: usize = 200;

/// A root of `f` between `a` and `b`, to the last digits, by Brent's method.
///
/// `None` if `f` has the same sign at both ends or is not a number somewhere on the way.
pub(crate) fn root(a: f64, b: f64, mut f: impl FnMut(f64) -> f64) -> Option<f64> {
    let (fa, fb) = (f(a), f(b));
    if fa.is_nan() || fb.is_nan() || (fa > 0.0 && fb > 0.0) || (fa < 0.0 && fb < 0.0) {
        return None;
    }
    // `b` is the best guess, `a` the one before, and the root lies between `b` and `c`.
    let (mut a, mut fa, mut b, mut fb) = (a, fa, b, fb);
    let (mut c, mut fc, mut step, mut before) = (a, fa, b - a, b - a);
    for _ in 0..MAX_EVALUATIONS {
        if (fb > 0.0) == (fc > 0.0) {
            (c, fc, step, before) = (a, fa, b - a, b - a);
        }
        if fc.abs() < fb.abs() {
            (a, fa, b, fb, c, fc) = (b, fb, c, fc, b, fb);
        }
        let tolerance = 2.0 * f64::EPSILON * b.abs() + f64::MIN_POSITIVE;
        let half = 0.5 * (c - b);
        if half.abs() <= tolerance || fb == 0.0 {
            return Some(b);
        }
        (step, before) = match interpolated(a, fa, b, fb, c, fc, half) {
            Some(s) if 2.0 * s.abs() < before.abs() && before.abs() > tolerance => (s, step),
            _ => (half, half),
        };
        (a, fa) = (b, fb);
        b += if step.abs() > tolerance { step } else { tolerance.copysign(half) };
        fb = f(b);
        if fb.is_nan() {
            return None;
        }
    }
    Some(b)
}

/// Brent's inverse quadratic or secant step from `b`, if it stays well inside the bracket.
fn interpolated(a: f64, fa: f64, b: f64, fb: f64, c: f64, fc: f64, half: f64) -> Option<f64> {
    if fa.abs() <= fb.abs() {
        return None;
    }
    let s = fb / fa;
    let (p, q) = if a == c {
        (2.0 * half * s, 1.0 - s)
    } else {
        let (q, r) = (fa / fc, fb / fc);
        let p = s * (2.0 * half * q * (q - r) - (b - a) * (r - 1.0));
        (p, (q - 1.0) * (r - 1.0) * (s - 1.0))
    };
    let step = if p > 0.0 { -p.abs() / q } else { p.abs() / q };
    let inside = step * half > 0.0 && step.abs() < 1.5 * half.abs();
    (inside && step.is_finite()).then_some(step)
}

#[cfg(test)]
mod tests {
    use super::root;

    #[test]
    fn finds_roots_to_the_last_digits() {
        assert!((root(0.0, 2.0, |x| x * x - 2.0).unwrap() - 2f64.sqrt()).abs() < 1e-15);
        assert!((root(3.0, -1.0, |x| x.powi(9)).unwrap()).abs() < 1e-15);
        let x = root(0.0, 1.0, |x| x.cos() - x).unwrap();
        assert!((x - 0.739_085_133_215_160_6).abs() < 1e-15);
        assert_eq!(root(1.0, 1.0, |_| 0.0), Some(1.0));
    }

    #[test]
    fn steep_and_flat_functions_end() {
        let mut calls = 0;
        let x = root(0.0, 1.0, |x| {
            calls += 1;
            if x < 0.123 { -1e-30 } else { 1e30 }
        });
        assert!((x.unwrap() - 0.123).abs() < 1e-15);
        assert!(calls < 200, "{calls}");
    }

    #[test]
    fn no_bracket_is_no_root() {
        assert_eq!(root(0.0, 1.0, |x| x + 1.0), None);
        assert_eq!(root(0.0, 1.0, |_| f64::NAN), None);
        assert_eq!(root(-1.0, 1.0, |x| (x + 0.5).sqrt() - 0.5), None);
    }
}
