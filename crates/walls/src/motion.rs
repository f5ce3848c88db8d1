use std::f64::consts::TAU;

use glam::DVec3;

use crate::WallError;

/// One harmonic term A sin(2π f t + φ) of a [`Motion`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// Amplitude vector A, m: direction and half the stroke.
    pub amplitude: DVec3,
    /// Frequency f, Hz.
    pub frequency: f64,
    /// Phase φ, rad.
    pub phase: f64,
}

/// How a part moves: a translation as a sum of harmonic terms.
///
/// ```text
/// u(t) = s(t) Σ A sin(2π f t + φ)      v(t) = du/dt
/// s(t) = 1 without a ramp
/// s(t) = 10 x³ − 15 x⁴ + 6 x⁵,  x = t/T clamped to 0 … 1, with a ramp of duration T
/// ```
///
/// Terms of one frequency with different directions and phases draw an ellipse. With the ramp,
/// displacement, velocity and acceleration start at zero and join the steady motion smoothly.
///
/// ```
/// use pendular_walls::{Harmonic, Motion, glam::DVec3};
/// let shake = Motion::harmonic(Harmonic {
///     amplitude: DVec3::new(0.0, 0.0, 1e-3),
///     frequency: 50.0,
///     phase: 0.0,
/// });
/// // A quarter period after zero: at the top, at rest.
/// assert!((shake.displacement(5e-3).z - 1e-3).abs() < 1e-15);
/// assert!(shake.velocity(5e-3).z.abs() < 1e-12);
/// // Fastest at t = 0: 2π f A.
/// assert!((shake.velocity(0.0).z - 0.1 * std::f64::consts::PI).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motion {
    /// The terms; none for a part at rest.
    pub terms: Vec<Harmonic>,
    /// Duration T of the start-up ramp from t = 0, s; 0 for none.
    pub ramp: f64,
}

/// Greatest slope of the ramp's polynomial, at x = 1/2.
const STEEPEST: f64 = 1.875;

impl Motion {
    /// A part at rest.
    pub const STILL: Self = Self { terms: Vec::new(), ramp: 0.0 };

    /// A motion of one term, without a ramp.
    #[must_use]
    pub fn harmonic(term: Harmonic) -> Self {
        Self { terms: vec![term], ramp: 0.0 }
    }

    /// The same motion, started over `ramp` seconds from t = 0.
    #[must_use]
    pub fn with_ramp(self, ramp: f64) -> Self {
        Self { ramp, ..self }
    }

    /// Whether the part never moves.
    #[must_use]
    pub fn is_still(&self) -> bool {
        self.terms.is_empty()
    }

    /// Displacement u from the rest position at `time` (s), m.
    #[must_use]
    pub fn displacement(&self, time: f64) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for term in &self.terms {
            sum += term.amplitude * (TAU * term.frequency * time + term.phase).sin();
        }
        sum * self.ramp_at(time).0
    }

    /// Velocity v = du/dt at `time` (s), m/s.
    #[must_use]
    pub fn velocity(&self, time: f64) -> DVec3 {
        let (mut place, mut rate) = (DVec3::ZERO, DVec3::ZERO);
        for term in &self.terms {
            let omega = TAU * term.frequency;
            let (sin, cos) = (omega * time + term.phase).sin_cos();
            place += term.amplitude * sin;
            rate += term.amplitude * (omega * cos);
        }
        let (share, slope) = self.ramp_at(time);
        rate * share + place * slope
    }

    /// The largest displacement along each axis, as an upper bound, m.
    #[must_use]
    pub fn amplitude_bound(&self) -> DVec3 {
        self.terms.iter().map(|t| t.amplitude.abs()).sum()
    }

    /// Upper bound of the speed at any time, m/s.
    #[must_use]
    pub fn speed_bound(&self) -> f64 {
        let steady: DVec3 =
            self.terms.iter().map(|t| t.amplitude.abs() * (TAU * t.frequency)).sum();
        let start = if self.ramp > 0.0 {
            self.amplitude_bound() * (STEEPEST / self.ramp)
        } else {
            DVec3::ZERO
        };
        (steady + start).length()
    }

    /// Factor s of the ramp and its rate ds/dt, 1/s.
    fn ramp_at(&self, time: f64) -> (f64, f64) {
        if self.ramp <= 0.0 || time >= self.ramp {
            return (1.0, 0.0);
        }
        let x = (time / self.ramp).max(0.0);
        let share = x * x * x * (10.0 - x * (15.0 - 6.0 * x));
        let slope = 30.0 * x * x * (1.0 - x) * (1.0 - x) / self.ramp;
        (share, slope)
    }

    /// Checks that every number is finite, frequencies and the ramp not negative.
    pub(crate) fn check(&self, part: &str) -> Result<(), WallError> {
        let check =
            |quantity, value: f64| WallError::within(part, quantity, value, (0.0, f64::MAX));
        check("ramp duration", self.ramp)?;
        for term in &self.terms {
            WallError::finite(part, "amplitude", term.amplitude)?;
            WallError::finite(part, "phase", DVec3::splat(term.phase))?;
            check("frequency", term.frequency)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn motion() -> impl Strategy<Value = Motion> {
        let term = (prop::array::uniform3(-2e-3..2e-3), 0.0..80.0, -4.0..4.0).prop_map(
            |(amplitude, frequency, phase)| Harmonic {
                amplitude: DVec3::from_array(amplitude),
                frequency,
                phase,
            },
        );
        let ramp = prop_oneof![Just(0.0), 0.01..0.5];
        (prop::collection::vec(term, 0..4), ramp).prop_map(|(terms, ramp)| Motion { terms, ramp })
    }

    proptest! {
        #[test]
        fn velocity_is_the_slope_of_the_displacement(m in motion(), time in -0.1..1.0) {
            // Away from the corner that a displaced start has at the ramp's ends there is none:
            // the ramp is smooth, so the central difference holds everywhere.
            let h = 1e-6;
            let slope = (m.displacement(time + h) - m.displacement(time - h)) / (2.0 * h);
            // Error h²/6 u''' <= 1e-12/6 · 3 · 2e-3 · (2π 80)³ ~ 1e-7, rounding 1e-10.
            prop_assert!((slope - m.velocity(time)).length() < 1e-6);
        }

        #[test]
        fn the_bounds_bound(m in motion(), time in -0.1..1.0) {
            prop_assert!(m.velocity(time).length() <= m.speed_bound() * (1.0 + 1e-12));
            let most = m.amplitude_bound() * (1.0 + 1e-12);
            prop_assert!(m.displacement(time).abs().cmple(most).all());
        }
    }

    #[test]
    fn two_terms_draw_an_ellipse() {
        let term = |amplitude, phase| Harmonic { amplitude, frequency: 50.6, phase };
        let m = Motion {
            terms: vec![term(DVec3::Z * 9e-4, 0.0), term(DVec3::X * 1e-4, TAU / 4.0)],
            ramp: 0.0,
        };
        for k in 0..100 {
            let u = m.displacement(k as f64 * 3.1e-4);
            let on_ellipse = (u.z / 9e-4).powi(2) + (u.x / 1e-4).powi(2);
            assert!((on_ellipse - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_ramp_starts_at_rest_and_ends_in_the_steady_motion() {
        let term = Harmonic { amplitude: DVec3::X, frequency: 3.0, phase: 0.7 };
        let steady = Motion::harmonic(term);
        let ramped = steady.clone().with_ramp(0.5);
        assert_eq!(ramped.displacement(0.0), DVec3::ZERO);
        assert_eq!(ramped.velocity(0.0), DVec3::ZERO);
        assert_eq!(ramped.displacement(-1.0), DVec3::ZERO);
        assert_eq!(ramped.displacement(0.5), steady.displacement(0.5));
        assert_eq!(ramped.velocity(0.75), steady.velocity(0.75));
        // Half way the polynomial is 1/2.
        assert!((ramped.displacement(0.25).x - 0.5 * steady.displacement(0.25).x).abs() < 1e-15);
    }

    #[test]
    fn bad_numbers_are_refused() {
        let term = Harmonic { amplitude: DVec3::X, frequency: 3.0, phase: 0.7 };
        let said = |m: Motion| m.check("screen").unwrap_err().to_string();
        assert!(said(Motion::harmonic(Harmonic { frequency: -1.0, ..term })).contains("frequency"));
        assert!(said(Motion::harmonic(Harmonic { phase: f64::NAN, ..term })).contains("phase"));
        let amplitude = DVec3::new(0.0, f64::INFINITY, 0.0);
        assert!(said(Motion::harmonic(Harmonic { amplitude, ..term })).contains("amplitude"));
        assert!(said(Motion::harmonic(term).with_ramp(-1.0)).contains("ramp"));
        assert!(Motion::STILL.check("screen").is_ok());
    }
}
