use std::f64::consts::{FRAC_PI_2, PI};

use super::complex::Complex;
use super::gauss::Rule;

/// Unknowns of a meridian: ln β_i, the phase φ = q L and ln L, with β_i the half-filling angle of
/// the first body, q the suction over the surface tension and L the length of the meridian.
pub(super) type State = [f64; 3];

/// A bridge without its gap, in units of its harmonic radius R.
///
/// The meridian runs from the first body (always a sphere) to the second (a sphere or a plane).
/// With y its radius and α its slope angle, z = y exp(iα) obeys dz/ds = i (1 + q z), so that
///
/// ```text
/// z(s) = z₀ e^{iqs} + (e^{iqs} − 1)/q
/// ```
///
/// for nodoid, catenoid (q = 0), unduloid, cylinder and sphere alike.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Problem {
    /// r_i/R
    pub(super) radius: f64,
    /// R/r_j, 0 for a plane
    pub(super) curvature: f64,
    /// θ_i, θ_j in rad
    pub(super) angles: [f64; 2],
    /// V/R³
    pub(super) volume: f64,
    pub(super) rule: Rule,
}

/// What a state amounts to, with the derivatives by its three unknowns.
#[derive(Debug, Clone, Copy)]
pub(super) struct Values {
    /// Slope angle at the second body minus the one that its contact angle wants.
    pub(super) angle: f64,
    pub(super) volume: f64,
    pub(super) gap: f64,
    /// Rows: angle, volume, gap. Columns: the unknowns.
    pub(super) gradient: [[f64; 3]; 3],
}

/// A point of the meridian.
#[derive(Debug, Clone, Copy)]
pub(super) struct Point {
    /// y exp(iα)
    pub(super) z: Complex,
    /// dz by ln β_i, φ and ln L
    pub(super) dz: [Complex; 3],
}

impl Problem {
    /// z₀ at the first body and its derivative by β_i.
    pub(super) fn start(&self, beta: f64) -> (Complex, Complex) {
        let slope = beta + self.angles[0] - FRAC_PI_2;
        let start = Complex::polar(self.radius * beta.sin(), slope);
        (start, Complex::polar(self.radius, slope + beta))
    }

    /// The point at share `t` of the meridian's length; `start` from [`Problem::start`].
    pub(super) fn point(state: &State, start: (Complex, Complex), t: f64) -> Point {
        let [beta, phase, length] = [state[0].exp(), state[1], state[2].exp()];
        Self::point_of(beta, phase, length, start, t)
    }

    fn point_of(beta: f64, phase: f64, length: f64, start: (Complex, Complex), t: f64) -> Point {
        let (sin, cos) = (0.5 * phase * t).sin_cos();
        let turned = Complex::new(1.0 - 2.0 * sin * sin, 2.0 * sin * cos);
        let chord = if phase.abs() < 1e-9 { t } else { 2.0 * sin / phase };
        // (e^{iφt} − 1)/φ without cancellation
        let bend = Complex::new(-sin, cos).scale(chord);
        let z0 = start.0 * turned;
        let arc = bend.scale(length);
        let by_phase = z0.turn().scale(t) + bend_by_phase(phase, t, turned, bend).scale(length);
        Point { z: z0 + arc, dz: [(start.1 * turned).scale(beta), by_phase, arc] }
    }

    /// Angle mismatch, volume and gap of a state; `None` where it is no profile.
    pub(super) fn evaluate(&self, state: &State) -> Option<Values> {
        let [beta, phase, length] = [state[0].exp(), state[1], state[2].exp()];
        if !(beta < PI && phase.abs() < 20.0 && length < 1e6) {
            return None;
        }
        let start = self.start(beta);
        let mut out = Values { angle: 0.0, volume: 0.0, gap: 0.0, gradient: [[0.0; 3]; 3] };
        for &(t, weight) in self.rule.points() {
            out.add_slice(Self::point_of(beta, phase, length, start, t), weight * length);
        }
        out.gradient[1][2] += out.volume;
        out.gradient[2][2] += out.gap;
        out.take_first_body(self.radius, beta);
        let end = Self::point_of(beta, phase, length, start, 1.0);
        out.take_second_body(self, end)?;
        let finite = out.angle.is_finite() && out.volume.is_finite() && out.gap.is_finite();
        finite.then_some(out)
    }
}

/// d/dφ of (e^{iφt} − 1)/φ.
fn bend_by_phase(phase: f64, t: f64, turned: Complex, bend: Complex) -> Complex {
    if phase.abs() < 1e-3 {
        let x = phase * t;
        return Complex::new(-0.5 + x * x / 8.0, -x / 3.0 + x * x * x / 30.0).scale(t * t);
    }
    (turned.turn().scale(t) + bend.scale(-1.0)).scale(1.0 / phase)
}

impl Values {
    /// Adds a slice of the profile: dx = cos α ds and dV = π y² dx.
    fn add_slice(&mut self, point: Point, ds: f64) {
        let y = point.z.modulus();
        let inverse = 1.0 / y;
        let cos = point.z.re * inverse;
        self.gap += cos * ds;
        self.volume += PI * y * point.z.re * ds;
        for (k, dz) in point.dz.iter().enumerate() {
            let dy = point.z.dot(*dz) * inverse;
            self.gradient[1][k] += PI * ds * (y * dz.re + point.z.re * dy);
            self.gradient[2][k] += ds * inverse * (dz.re - cos * dy);
        }
    }

    /// Takes the first sphere's cap out of volume and gap.
    fn take_first_body(&mut self, radius: f64, beta: f64) {
        let y = radius * beta.sin();
        let half = (0.5 * beta).sin();
        let height = 2.0 * radius * half * half;
        self.gap -= height;
        self.volume -= cap_volume(y * y, height);
        // d(height)/d(ln β)
        let grown = y * beta;
        self.gradient[2][0] -= grown;
        self.gradient[1][0] -= PI * y * y * grown;
    }

    /// Takes the second body's cap out and compares its contact angle.
    fn take_second_body(&mut self, problem: &Problem, end: Point) -> Option<()> {
        let y = end.z.modulus();
        let sin = problem.curvature * y;
        if !(y > 0.0 && sin < 1.0) {
            return None;
        }
        let cos = ((1.0 - sin) * (1.0 + sin)).sqrt();
        let height = sin * y / (1.0 + cos);
        self.gap -= height;
        self.volume -= cap_volume(y * y, height);
        let wanted = FRAC_PI_2 - sin.asin() - problem.angles[1];
        let unit = Complex::polar(1.0, wanted);
        self.angle = unit.cross(end.z).atan2(unit.dot(end.z));
        for (k, dz) in end.dz.iter().enumerate() {
            let dy = end.z.dot(*dz) / y;
            self.gradient[0][k] = end.z.cross(*dz) / (y * y) + problem.curvature * dy / cos;
            self.gradient[1][k] -= PI * y * y * sin / cos * dy;
            self.gradient[2][k] -= sin / cos * dy;
        }
        Some(())
    }
}

/// Volume of a spherical cap with the square of its base radius and its height.
pub(super) fn cap_volume(base_squared: f64, height: f64) -> f64 {
    PI / 6.0 * height * (3.0 * base_squared + height * height)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn problem() -> Problem {
        Problem { radius: 0.75, curvature: 0.5, angles: [0.3, 0.7], volume: 0.1, rule: Rule::Fine }
    }

    #[test]
    fn gradients_agree_with_differences() {
        for phase in [1.3, 5e-4, 0.0, -0.4] {
            let state = [-1.0, phase, -0.8];
            let values = problem().evaluate(&state).unwrap();
            for k in 0..3 {
                let step = 1e-6;
                let (mut up, mut down) = (state, state);
                up[k] += step;
                down[k] -= step;
                let up = problem().evaluate(&up).unwrap();
                let down = problem().evaluate(&down).unwrap();
                let slopes = [
                    (up.angle - down.angle) / (2.0 * step),
                    (up.volume - down.volume) / (2.0 * step),
                    (up.gap - down.gap) / (2.0 * step),
                ];
                for (row, slope) in slopes.iter().enumerate() {
                    let error = (values.gradient[row][k] - slope).abs();
                    assert!(error < 1e-8, "phase {phase}: row {row}, column {k}: {error}");
                }
            }
        }
    }

    #[test]
    fn the_meridian_obeys_its_equation() {
        // dz/ds = i (1 + q z)
        let state: State = [-1.0, 1.7, -0.4];
        let (length, q) = (state[2].exp(), state[1] / state[2].exp());
        let start = problem().start(state[0].exp());
        let at = |t| Problem::point(&state, start, t).z;
        let step = 1e-5;
        let slope = (at(0.3 + step) + at(0.3 - step).scale(-1.0)).scale(0.5 / (step * length));
        let right = (Complex::new(1.0, 0.0) + at(0.3).scale(q)).turn();
        assert!((slope.re - right.re).abs() < 1e-9 && (slope.im - right.im).abs() < 1e-9);
        assert!(at(0.0) == start.0);
    }
}
