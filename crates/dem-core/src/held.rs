//! What holds one sphere while its neighbours stand still: an upper bound of the fastest motion.

use glam::DVec3;

/// Degrees of freedom of a sphere: its place, and its turn times √0.4 r.
const N: usize = 6;
/// Sweeps of Jacobi's method; six digits take three to five.
const SWEEPS: usize = 30;

/// A symmetric 6×6 matrix: stiffness over mass (1/s²) or damping over mass (1/s) of one sphere.
///
/// The turn is scaled with the root of the inertia 0.4 m r², so that the mass matrix is m times
/// one. A contact resists motion along its normal n with k_n, and its slip v_t + r ω × n with k_t.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Held([[f64; N]; N]);

impl Held {
    /// Adds a contact: `normal` from this sphere outwards, coefficients along it and across it.
    pub(crate) fn add(&mut self, normal: DVec3, along: f64, across: f64) {
        let n = normal.to_array();
        let arm = 2.5_f64.sqrt();
        // n × ψ as a matrix.
        let cross = [[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]];
        for i in 0..3 {
            for j in 0..3 {
                let one = f64::from(u8::from(i == j));
                let plane = across * (one - n[i] * n[j]);
                self.0[i][j] += along * n[i] * n[j] + plane;
                self.0[i + 3][j + 3] += 2.5 * plane;
                self.0[i][j + 3] -= arm * across * cross[i][j];
                self.0[j + 3][i] -= arm * across * cross[i][j];
            }
        }
    }

    pub(crate) fn times(&self, factor: f64) -> Self {
        Self(self.0.map(|row| row.map(|entry| factor * entry)))
    }

    pub(crate) fn plus(&self, other: &Self) -> Self {
        let row = |i: usize| std::array::from_fn(|j| self.0[i][j] + other.0[i][j]);
        Self(std::array::from_fn(row))
    }

    /// The largest eigenvalue, by Jacobi's rotations.
    pub(crate) fn largest(mut self) -> f64 {
        for _ in 0..SWEEPS {
            let upper = (0..N).flat_map(|i| (i + 1..N).map(move |j| (i, j)));
            let off: f64 = upper.clone().map(|(i, j)| self.0[i][j].abs()).sum();
            let trace: f64 = (0..N).map(|i| self.0[i][i]).sum();
            if off.is_nan() || off <= 1e-12 * trace {
                break;
            }
            upper.for_each(|(i, j)| self.rotate(i, j));
        }
        // What is no number holds without a limit.
        let diagonal = (0..N).map(|i| self.0[i][i]);
        diagonal.fold(0.0, |most, one| if one.is_nan() { f64::INFINITY } else { one.max(most) })
    }

    /// Turns rows and columns p and q so that their common entry vanishes.
    fn rotate(&mut self, p: usize, q: usize) {
        let a = &mut self.0;
        if a[p][q] == 0.0 {
            return;
        }
        let theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
        let tan = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
        let cos = 1.0 / (tan * tan + 1.0).sqrt();
        let sin = tan * cos;
        for row in a.iter_mut() {
            (row[p], row[q]) = (cos * row[p] - sin * row[q], sin * row[p] + cos * row[q]);
        }
        let (first, second) = (a[p], a[q]);
        a[p] = std::array::from_fn(|k| cos * first[k] - sin * second[k]);
        a[q] = std::array::from_fn(|k| sin * first[k] + cos * second[k]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_contact_by_hand() {
        // Along the normal k_n; across it 3.5 k_t, since a solid sphere turns as it slides.
        let normal = DVec3::new(2.0, -1.0, 2.0) / 3.0;
        for (along, across) in [(1.0, 0.0), (1.0, 0.2), (1.0, 0.8)] {
            let mut block = Held::default();
            block.add(normal, along, across);
            let expected = f64::max(along, 3.5 * across);
            assert!((block.largest() - expected).abs() < 1e-12, "{along} {across}");
        }
    }

    #[test]
    fn six_contacts_of_a_cube_are_isotropic() {
        // 6 (k_n + 2 k_t)/3 for the place, 2.5 · 6 · 2 k_t/3 for the turn: uncoupled.
        let mut block = Held::default();
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            for side in [axis, -axis] {
                block.add(side, 1.0, 0.3);
            }
        }
        assert!((block.largest() - f64::max(2.0 * 1.6, 10.0 * 0.3)).abs() < 1e-12);
    }

    #[test]
    fn it_is_the_largest_of_all_quotients() {
        let mut block = Held::default();
        for (k, axis) in [DVec3::X, DVec3::new(0.6, 0.8, 0.0), DVec3::new(0.0, -0.6, 0.8)]
            .into_iter()
            .enumerate()
        {
            block.add(axis, 1.0 + k as f64, 0.5);
        }
        // The power method from a vector that no eigenvector is orthogonal to by chance.
        let mut x = [0.3, -0.7, 0.45, 0.91, 0.13, -0.55];
        let mut norm = 0.0;
        for _ in 0..500 {
            let y = block.0.map(|row| row.iter().zip(&x).map(|(a, b)| a * b).sum::<f64>());
            norm = y.iter().map(|y| y * y).sum::<f64>().sqrt();
            x = y.map(|y| y / norm);
        }
        assert!((block.largest() / norm - 1.0).abs() < 1e-9, "{} {norm}", block.largest());
    }
}
