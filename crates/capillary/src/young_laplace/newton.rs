/// Most steps that one solve may take.
const STEPS: usize = 30;

/// Solves a small linear system by elimination with row pivoting; `None` if it is singular.
pub(super) fn solve_linear<const N: usize>(
    mut matrix: [[f64; N]; N],
    mut right: [f64; N],
) -> Option<[f64; N]> {
    for k in 0..N {
        let pivot = (k..N).max_by(|&a, &b| matrix[a][k].abs().total_cmp(&matrix[b][k].abs()))?;
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        let top = matrix[k];
        if top[k] == 0.0 || !top[k].is_finite() {
            return None;
        }
        for row in k + 1..N {
            let factor = matrix[row][k] / top[k];
            for (entry, above) in matrix[row].iter_mut().zip(top).skip(k) {
                *entry -= factor * above;
            }
            right[row] -= factor * right[k];
        }
    }
    let mut solution = [0.0; N];
    for k in (0..N).rev() {
        let known: f64 = (k + 1..N).map(|c| matrix[k][c] * solution[c]).sum();
        solution[k] = (right[k] - known) / matrix[k][k];
    }
    solution.iter().all(|x| x.is_finite()).then_some(solution)
}

/// Newton's method with a bounded step; `None` if it does not settle.
///
/// `system` gives residual and Jacobian, or nothing where it has no value. The unknowns are all of
/// order one (logarithms, phases), so steps are measured by their largest component.
pub(super) fn newton<const N: usize>(
    mut x: [f64; N],
    system: impl Fn(&[f64; N]) -> Option<([f64; N], [[f64; N]; N])>,
) -> Option<[f64; N]> {
    let mut before = f64::INFINITY;
    for _ in 0..STEPS {
        let (residual, jacobian) = system(&x)?;
        let step = solve_linear(jacobian, residual)?;
        let size = step.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
        let factor = if size > 0.5 { 0.5 / size } else { 1.0 };
        for (entry, s) in x.iter_mut().zip(step) {
            *entry -= factor * s;
        }
        // Done at rounding, or where rounding keeps the step from shrinking (close to a fold).
        if size < 1e-13 || (size < 1e-8 && size > 0.25 * before) {
            return Some(x);
        }
        before = size;
    }
    None
}

/// Root of a function that changes sign between 0 and `high` (Illinois rule); the last point at
/// which it had a value, `None` if it has none inside.
pub(super) fn bracketed_root<T: Copy>(
    low: (f64, f64),
    high: (f64, f64),
    tolerance: f64,
    function: impl Fn(f64) -> Option<(f64, T)>,
) -> Option<T> {
    let ((mut a, mut at_a), (mut b, mut at_b)) = (low, high);
    let mut found = None;
    let mut side = 0;
    for _ in 0..80 {
        let x = if at_a == at_b { 0.5 * (a + b) } else { b - at_b * (b - a) / (at_b - at_a) };
        let (value, what) = function(x)?;
        found = Some(what);
        if value == 0.0 || (b - a).abs() < tolerance {
            break;
        }
        if (value > 0.0) == (at_b > 0.0) {
            if side == 1 {
                at_a *= 0.5;
            }
            (b, at_b, side) = (x, value, 1);
        } else {
            if side == -1 {
                at_b *= 0.5;
            }
            (a, at_a, side) = (x, value, -1);
        }
        if value.abs() < 1e-14 {
            break;
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_systems() {
        let x = solve_linear([[0.0, 2.0], [4.0, 1.0]], [2.0, 9.0]).unwrap();
        assert_eq!(x, [2.0, 1.0]);
        assert!(solve_linear([[1.0, 2.0], [2.0, 4.0]], [1.0, 1.0]).is_none());
    }

    #[test]
    fn newton_and_bracket_find_the_square_root_of_two() {
        let x = newton([1.0], |x| Some(([x[0] * x[0] - 2.0], [[2.0 * x[0]]]))).unwrap();
        assert!((x[0] - 2.0_f64.sqrt()).abs() < 1e-15);
        assert!(newton([1.0], |x| Some(([x[0] * x[0] + 2.0], [[2.0 * x[0]]]))).is_none());
        let f = |x: f64| Some((x * x - 2.0, x));
        let x = bracketed_root((0.0, -2.0), (2.0, 2.0), 1e-15, f).unwrap();
        assert!((x - 2.0_f64.sqrt()).abs() < 1e-14);
    }
}
