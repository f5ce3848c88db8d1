use std::f64::consts::PI;

use pendular_pair::OutOfRange;

/// Stokes number of a collision in a liquid film: inertia over viscous drag.
///
/// ```text
/// St = m v/(6 π η R*²)
/// ```
///
/// # Units
/// `mass` m: the reduced mass of the pair, kg. `speed` v, m/s, at least 0. `viscosity` η, Pa s.
/// `reduced_radius` R*, m.
///
/// # Errors
/// [`OutOfRange`] unless mass, viscosity and radius are positive and finite and the speed is not
/// negative.
///
/// # References
/// Krull, Strohner & Antonyuk (2025), eq. (21).
pub fn stokes_number(
    mass: f64,
    speed: f64,
    viscosity: f64,
    reduced_radius: f64,
) -> Result<f64, OutOfRange> {
    OutOfRange::positive("reduced mass", mass)?;
    OutOfRange::within("speed", speed, (0.0, f64::MAX))?;
    OutOfRange::positive("viscosity", viscosity)?;
    OutOfRange::positive("reduced radius", reduced_radius)?;
    let stokes = mass * speed / (6.0 * PI * viscosity * reduced_radius * reduced_radius);
    OutOfRange::within("Stokes number", stokes, (0.0, f64::MAX))?;
    Ok(stokes)
}

/// Stokes number below which the film keeps the bodies together.
///
/// ```text
/// St* = (1 + 1/e_dry) ln(h_init/h_min)
/// ```
///
/// With a drag that fades in overlap the logarithm is ln(h_init/s_r) + 1 ([`crate::Overlap::Fade`]).
///
/// # Units
/// `e_dry` from 0 (then St* is infinite) to 1. `initial_gap` h_init and `min_gap` h_min, m.
///
/// # Errors
/// [`OutOfRange`] outside 0 ≤ e_dry ≤ 1, 0 < h_min ≤ h_init, or where a length is not finite.
///
/// # References
/// Barnocky & Davis (1988), Phys. Fluids 31, 1324. Krull, Strohner & Antonyuk (2025), section
/// 3.1.1.
pub fn critical_stokes_number(
    e_dry: f64,
    initial_gap: f64,
    min_gap: f64,
) -> Result<f64, OutOfRange> {
    OutOfRange::within("dry restitution", e_dry, (0.0, 1.0))?;
    let logarithm = squeeze(initial_gap, min_gap)?;
    Ok(if e_dry == 0.0 { f64::INFINITY } else { (1.0 + 1.0 / e_dry) * logarithm })
}

/// Restitution of a collision through a liquid film.
///
/// ```text
/// e_wet = e_dry − (1 + e_dry)/St ln(h_init/h_min),   0 below St*
/// ```
///
/// # Units
/// `e_dry` from 0 to 1, `stokes` St (0 gives 0), `initial_gap` h_init and `min_gap` h_min, m.
///
/// # Errors
/// [`OutOfRange`] as [`critical_stokes_number`], and for a negative or NaN Stokes number.
///
/// # Example
/// ```
/// use pendular_lubrication::wet_restitution;
/// // by hand: 0.8 − 1.8/37 · ln 25
/// let e = wet_restitution(0.8, 37.0, 50e-6, 2e-6)?;
/// assert!((e - 0.643406).abs() < 1e-6);
/// # Ok::<(), pendular_lubrication::OutOfRange>(())
/// ```
///
/// # References
/// Davis, Rager & Good (2002), J. Fluid Mech. 468, 107. Krull, Strohner & Antonyuk (2025),
/// eq. (20), whose printed `+` must be `−`: liquid takes energy.
pub fn wet_restitution(
    e_dry: f64,
    stokes: f64,
    initial_gap: f64,
    min_gap: f64,
) -> Result<f64, OutOfRange> {
    OutOfRange::within("dry restitution", e_dry, (0.0, 1.0))?;
    OutOfRange::within("Stokes number", stokes, (0.0, f64::INFINITY))?;
    let logarithm = squeeze(initial_gap, min_gap)?;
    if stokes == 0.0 {
        return Ok(0.0);
    }
    Ok((e_dry - (1.0 + e_dry) / stokes * logarithm).max(0.0))
}

/// ln(h_init/h_min), checked.
fn squeeze(initial_gap: f64, min_gap: f64) -> Result<f64, OutOfRange> {
    OutOfRange::positive("minimum gap", min_gap)?;
    OutOfRange::within("initial gap", initial_gap, (min_gap, f64::MAX))?;
    Ok(initial_gap.ln() - min_gap.ln())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eq_20_takes_energy_and_vanishes_at_its_own_critical_number() {
        let critical = critical_stokes_number(0.8, 50e-6, 2e-6).unwrap();
        // (1 + 1.25) ln 25
        assert!((critical - 7.242470).abs() < 1e-5);
        let e = |stokes| wet_restitution(0.8, stokes, 50e-6, 2e-6).unwrap();
        assert!(e(critical * (1.0 + 1e-9)) < 1e-8);
        assert_eq!(e(critical * 0.999), 0.0);
        // The printed plus sign would give more than e_dry and never vanish.
        let printed = |stokes: f64| 0.8 + 1.8 / stokes * 25.0_f64.ln();
        assert!(printed(critical) > 1.0 && e(1e3) < 0.8 && e(f64::INFINITY) == 0.8);
    }

    #[test]
    fn follows_from_two_passages_of_the_film() {
        // v' = v − K/m ln on the way in, e_dry, and the same loss on the way out
        let (mass, viscosity, radius, speed, e_dry) = (5e-5, 0.05, 1e-3, 0.5, 0.7);
        let loss = 6.0 * PI * viscosity * radius * radius / mass * 20.0_f64.ln();
        let left = e_dry * (speed - loss) - loss;
        let stokes = stokes_number(mass, speed, viscosity, radius).unwrap();
        let wet = wet_restitution(e_dry, stokes, 20e-6, 1e-6).unwrap();
        assert!(wet > 0.1 && (wet - left / speed).abs() < 1e-14);
    }

    #[test]
    fn ends_and_errors() {
        assert_eq!(critical_stokes_number(0.0, 2.0, 1.0), Ok(f64::INFINITY));
        assert_eq!(wet_restitution(0.0, 10.0, 2.0, 1.0), Ok(0.0));
        assert_eq!(wet_restitution(1.0, 0.0, 2.0, 1.0), Ok(0.0));
        assert_eq!(wet_restitution(1.0, 5.0, 1.0, 1.0), Ok(1.0));
        let bad = |r: Result<f64, OutOfRange>| r.unwrap_err().quantity;
        assert_eq!(bad(wet_restitution(1.1, 5.0, 2.0, 1.0)), "dry restitution");
        assert_eq!(bad(wet_restitution(0.5, f64::NAN, 2.0, 1.0)), "Stokes number");
        assert_eq!(bad(wet_restitution(0.5, 5.0, 0.5, 1.0)), "initial gap");
        assert_eq!(bad(critical_stokes_number(0.5, 5.0, 0.0)), "minimum gap");
        assert_eq!(bad(stokes_number(1.0, 1.0, -1.0, 1.0)), "viscosity");
        assert_eq!(bad(stokes_number(1.0, f64::NAN, 1.0, 1.0)), "speed");
        assert_eq!(bad(stokes_number(1e300, 1e300, 1.0, 1.0)), "Stokes number");
    }
}
