use crate::error::positive;
use crate::{ContactError, NormalContact};

/// What came of one head-on collision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Speed after over speed before; 0 where the bodies stay together.
    pub restitution: f64,
    /// Time from touch to the end of the force, s.
    pub duration: f64,
    /// Largest overlap, m.
    pub max_overlap: f64,
}

/// Steps after which an impact is given up as one that does not end.
const MAX_STEPS: u32 = 20_000_000;

/// Integrates one head-on collision of bodies of `reduced_mass` m* (kg) at relative `speed` (m/s)
/// by velocity Verlet with `time_step` (s), second order also with a dashpot.
///
/// The impact ends with the overlap, or when the force has vanished while the bodies separate.
/// It is given up, with restitution 0, after 20 million steps.
///
/// ```
/// use pendular_contact::{Linear, impact};
/// let law = Linear::from_restitution(1e5, 0.8, 1e-4)?;
/// let rebound = impact(&law, 1e-4, 0.5, 1e-3 * law.contact_time(1e-4)?)?;
/// assert!((rebound.restitution - 0.8).abs() < 1e-5);
/// # Ok::<(), pendular_contact::ContactError>(())
/// ```
///
/// # Errors
/// [`ContactError`] unless mass, speed and step are positive and finite.
pub fn impact<N: NormalContact>(
    law: &N,
    reduced_mass: f64,
    speed: f64,
    time_step: f64,
) -> Result<Impact, ContactError> {
    positive("reduced mass", reduced_mass)?;
    positive("speed", speed)?;
    positive("time step", time_step)?;
    let mut memory = N::Memory::default();
    let (h, mut overlap, mut velocity) = (time_step, 0.0_f64, speed);
    let mut acceleration = -law.force(0.0, velocity, &mut memory) / reduced_mass;
    let mut deepest = 0.0_f64;
    for step in 1..=MAX_STEPS {
        let (before, half) = (overlap, velocity + 0.5 * h * acceleration);
        overlap += h * half;
        deepest = deepest.max(overlap);
        if overlap <= 0.0 {
            // the part of the step until the overlap is 0
            let share = before / (before - overlap);
            let left = velocity + share * h * acceleration;
            return Ok(Impact {
                restitution: (-left / speed).max(0.0),
                duration: h * (f64::from(step - 1) + share),
                max_overlap: deepest,
            });
        }
        let predicted = half + 0.5 * h * acceleration;
        let force = law.force(overlap, predicted, &mut memory);
        acceleration = -force / reduced_mass;
        velocity = half + 0.5 * h * acceleration;
        if force == 0.0 && velocity < 0.0 {
            return Ok(Impact {
                restitution: -velocity / speed,
                duration: h * f64::from(step),
                max_overlap: deepest,
            });
        }
    }
    Ok(Impact { restitution: 0.0, duration: f64::INFINITY, max_overlap: deepest })
}
