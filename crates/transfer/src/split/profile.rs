//! The parabola between two contact lines: geometry only.

use std::f64::consts::{FRAC_PI_2, PI};

/// Two spheres, their contact angles and the gap between them: what the profile hangs on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bodies {
    /// Radii r_i, r_j, m.
    pub(super) radii: [f64; 2],
    /// Contact angles θ_i, θ_j, rad.
    pub(super) angles: [f64; 2],
    /// Gap S, m.
    pub(super) gap: f64,
    /// Whether the second body's cap is taken off the volume.
    pub(super) second_cap: bool,
}

/// A parabola Y = a x² + b x + c that meets both contact angles.
///
/// `x` runs from the contact line of the first body (0) to that of the second (`length`).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Profile {
    /// Half-filling angles β_i, β_j, rad: the contact lines lie at r sin β.
    pub half_filling: [f64; 2],
    /// Coefficient a, 1/m.
    pub a: f64,
    /// Coefficient b = Y'(0).
    pub b: f64,
    /// Coefficient c = Y(0), m.
    pub c: f64,
    /// Distance d_lb between the two contact lines along the axis, m.
    pub length: f64,
    /// Immersion depths d_i, d_j, m.
    pub immersion: [f64; 2],
    /// Place x_min of the neck, m.
    pub neck_position: f64,
    /// Radius Y(x_min) of the neck, m; greater than 0.
    pub neck_radius: f64,
    /// Volumes V_i, V_j on the two sides of the neck, m³.
    pub volumes: [f64; 2],
}

impl Bodies {
    /// The largest half-filling angle of a body with a neck beyond its contact line: Y' = 0 there.
    pub(super) fn fullest(&self, body: usize) -> f64 {
        FRAC_PI_2 - self.angles[body]
    }

    /// Slope of the profile towards a body, −Y'(0) or Y'(d_lb): cot(θ + β), not below 0.
    fn slope(&self, body: usize, half_filling: f64) -> f64 {
        (FRAC_PI_2 - (self.angles[body] + half_filling)).tan().max(0.0)
    }

    fn immersion(&self, body: usize, half_filling: f64) -> f64 {
        let s = (0.5 * half_filling).sin();
        2.0 * self.radii[body] * s * s
    }

    /// What is left of Y(d_lb) − Y(0) = d_lb (Y'(0) + Y'(d_lb))/2, true for every parabola, m.
    ///
    /// It rises with β_j and falls with β_i, strictly: there is at most one β_j for each β_i.
    pub(super) fn mismatch(&self, beta: [f64; 2]) -> f64 {
        let [yi, yj] = self.contact_radii(beta);
        let slopes = self.slope(1, beta[1]) - self.slope(0, beta[0]);
        yj - yi - 0.5 * self.length(beta) * slopes
    }

    fn contact_radii(&self, beta: [f64; 2]) -> [f64; 2] {
        [self.radii[0] * beta[0].sin(), self.radii[1] * beta[1].sin()]
    }

    fn length(&self, beta: [f64; 2]) -> f64 {
        self.immersion(0, beta[0]) + self.immersion(1, beta[1]) + self.gap
    }

    /// The parabola with these half-filling angles; only a solution if [`Bodies::mismatch`] is 0.
    pub(super) fn profile(&self, beta: [f64; 2]) -> Profile {
        let slopes = [self.slope(0, beta[0]), self.slope(1, beta[1])];
        let length = self.length(beta);
        let radii = self.contact_radii(beta);
        let a = (slopes[0] + slopes[1]) / (2.0 * length);
        // A cylinder has its neck everywhere: call it the middle.
        let share = if a > 0.0 { slopes[0] / (slopes[0] + slopes[1]) } else { 0.5 };
        let neck_position = share * length;
        let neck_radius = radii[0] - 0.5 * slopes[0] * neck_position;
        let sides = [neck_position, length - neck_position];
        let immersion = [self.immersion(0, beta[0]), self.immersion(1, beta[1])];
        let side = |k: usize| {
            let cap = if k == 0 || self.second_cap { cap(radii[k], immersion[k]) } else { 0.0 };
            solid(a, neck_radius, sides[k]) - cap
        };
        let (b, c) = (-slopes[0], radii[0]);
        let volumes = [side(0), side(1)];
        let half_filling = beta;
        Profile { half_filling, a, b, c, length, immersion, neck_position, neck_radius, volumes }
    }
}

/// π ∫ (y + a t²)² dt from 0 to `t`: the solid of revolution between the neck and a contact line.
fn solid(a: f64, neck_radius: f64, t: f64) -> f64 {
    let rise = a * t * t;
    let y = neck_radius;
    PI * t * (y * y + 2.0 / 3.0 * y * rise + 0.2 * rise * rise)
}

/// Volume of a spherical cap of base radius `y` and height `d`.
fn cap(y: f64, d: f64) -> f64 {
    PI / 6.0 * d * (3.0 * y * y + d * d)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn caps_and_solids_by_hand() {
        // Half a unit sphere; a cylinder; a cone-like solid from a pure t² profile.
        assert_relative_eq!(cap(1.0, 1.0), 2.0 / 3.0 * PI, max_relative = 1e-15);
        assert_relative_eq!(solid(0.0, 2.0, 3.0), 12.0 * PI, max_relative = 1e-15);
        assert_relative_eq!(solid(1.0, 0.0, 2.0), PI * 32.0 / 5.0, max_relative = 1e-15);
    }

    #[test]
    fn the_mismatch_is_monotone() {
        let bodies =
            Bodies { radii: [5e-3, 1e-3], angles: [0.3, 0.8], gap: 3e-4, second_cap: true };
        let steps = |k| (1..60).map(move |n| 0.01 * f64::from(n) * k);
        for x in steps(1.0) {
            let rising: Vec<f64> = steps(1.0).map(|y| bodies.mismatch([x, y])).collect();
            assert!(rising.windows(2).all(|w| w[0] < w[1]));
            let falling: Vec<f64> = steps(1.0).map(|y| bodies.mismatch([y, x])).collect();
            assert!(falling.windows(2).all(|w| w[0] > w[1]));
        }
    }
}
