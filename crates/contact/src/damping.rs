use std::f64::consts::{FRAC_PI_2, PI};

use crate::ContactError;
use crate::error::positive;

/// What the dashpot may do while the bodies separate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Dashpot {
    /// Spring and dashpot together never pull: the force is cut at 0 and the contact ends there.
    #[default]
    PushesOnly,
    /// The dashpot may pull until the overlap is 0.
    MayPull,
}

/// Damping ratio ζ of a spring-dashpot contact that rebounds with restitution `e`.
///
/// The two treatments of separation need different dashpots for the same rebound. Exact for the
/// linear contact, ζ = γ/(2 √(k m*)), and for Hertz' with a dashpot that grows like δ^(1/4), where
/// x = δ^(5/4) is a linear oscillator.
///
/// ```text
/// may pull:     e = exp(−π ζ/√(1 − ζ²))           so ζ = −ln e/√(π² + ln² e)
/// pushes only:  e = exp(−2 c cot c),  ζ = cos c   for e ≥ exp(−2),
///               e = exp(−2 b coth b), ζ = cosh b  below
/// ```
///
/// # Errors
/// [`ContactError`] unless 0 < e ≤ 1. No finite dashpot gives e = 0.
///
/// # References
/// Schwager & Pöschel (2007), Granul. Matter 9, 465, for the cut; Antypov & Elliott (2011), EPL 94,
/// 50004, for Hertz.
pub fn damping_ratio(e: f64, dashpot: Dashpot) -> Result<f64, ContactError> {
    if !(e > 0.0 && e <= 1.0) {
        return Err(ContactError { quantity: "restitution", value: e, allowed: (0.0, 1.0) });
    }
    let decrement = -e.ln();
    Ok(match dashpot {
        Dashpot::MayPull => decrement / PI.hypot(decrement),
        Dashpot::PushesOnly if decrement < 2.0 => {
            // c cot c falls from 1 to 0 on (0, π/2)
            bisect((0.0, FRAC_PI_2), |c| 0.5 * decrement - c / c.tan()).cos()
        }
        Dashpot::PushesOnly => {
            // b ≤ b coth b ≤ b + 1
            let half = 0.5 * decrement;
            bisect((half - 1.0, half), |b| if b == 0.0 { 1.0 } else { b / b.tanh() } - half).cosh()
        }
    })
}

/// Restitution of a contact with damping ratio `zeta` ζ ≥ 0: the inverse of [`damping_ratio`].
///
/// ζ ≥ 1 with a dashpot that may pull gives 0: the bodies stay.
///
/// # Errors
/// [`ContactError`] for a negative or NaN ζ.
pub fn restitution(zeta: f64, dashpot: Dashpot) -> Result<f64, ContactError> {
    crate::error::within("damping ratio", zeta, (0.0, f64::MAX))?;
    Ok(match dashpot {
        Dashpot::MayPull if zeta >= 1.0 => 0.0,
        Dashpot::MayPull => (-PI * zeta / (1.0 - zeta * zeta).sqrt()).exp(),
        Dashpot::PushesOnly if zeta < 1.0 => exponent(zeta.acos(), f64::tan),
        Dashpot::PushesOnly => exponent(zeta.acosh(), f64::tanh),
    })
}

/// exp(−2 x/f(x)) with f(x) → x as x → 0.
fn exponent(x: f64, f: fn(f64) -> f64) -> f64 {
    (-2.0 * if x == 0.0 { 1.0 } else { x / f(x) }).exp()
}

/// Duration of a contact that pushes only, times the undamped angular frequency √(k/m*).
pub(crate) fn cut_duration(zeta: f64) -> f64 {
    let (x, f) = if zeta < 1.0 {
        (zeta.acos(), zeta.acos().sin())
    } else {
        (zeta.acosh(), zeta.acosh().sinh())
    };
    if x == 0.0 { 2.0 } else { 2.0 * x / f }
}

/// The zero of a rising function, to the last digit that bisection of `range` can tell.
fn bisect(range: (f64, f64), rising: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = range;
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return middle;
        }
        if rising(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/// Dashpot coefficient γ (N s/m) of a linear contact, as usually written.
///
/// ```text
/// γ = −2 ln e √(k_n m*)/√(π² + ln² e)
/// ```
///
/// It gives the rebound e only where the dashpot may pull. With the force cut at 0 it gives more:
/// 0.836, 0.550, 0.325 for e = 0.83, 0.5, 0.2. [`crate::Linear::from_restitution`] corrects for that.
///
/// # Errors
/// [`ContactError`] unless the stiffness (N/m) and reduced mass (kg) are positive and finite and
/// 0 < e ≤ 1.
pub fn dashpot(stiffness: f64, e: f64, reduced_mass: f64) -> Result<f64, ContactError> {
    positive("stiffness", stiffness)?;
    positive("reduced mass", reduced_mass)?;
    let zeta = damping_ratio(e, Dashpot::MayPull)?;
    Ok(2.0 * zeta * stiffness.sqrt() * reduced_mass.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOTH: [Dashpot; 2] = [Dashpot::PushesOnly, Dashpot::MayPull];

    #[test]
    fn restitution_and_ratio_are_inverse() {
        for dashpot in BOTH {
            for e in [1.0, 0.999, 0.83, 0.5, 0.14, 0.135, 0.1, 1e-3, 1e-100] {
                let back = restitution(damping_ratio(e, dashpot).unwrap(), dashpot).unwrap();
                let allowed = if dashpot == Dashpot::MayPull { 1e-6 } else { 1e-9 };
                assert!((back / e - 1.0).abs() < allowed || e < 1e-50, "{dashpot:?} {e} {back}");
            }
            assert!(damping_ratio(1.0, dashpot).unwrap().abs() < 1e-15);
        }
    }

    #[test]
    fn known_values() {
        // critical damping, cut: e = exp(−2) (Schwager & Pöschel 2007)
        let critical = restitution(1.0, Dashpot::PushesOnly).unwrap();
        assert!((critical - 0.1353352832366127).abs() < 1e-15);
        let near = restitution(1.0 + 1e-9, Dashpot::PushesOnly).unwrap();
        assert!((near - critical).abs() < 1e-9);
        // the numbers in the documentation of `dashpot`
        for (e, cut) in [(0.83, 0.836), (0.5, 0.550), (0.2, 0.325)] {
            let zeta = damping_ratio(e, Dashpot::MayPull).unwrap();
            assert!((restitution(zeta, Dashpot::PushesOnly).unwrap() - cut).abs() < 5e-4, "{e}");
        }
    }

    #[test]
    fn no_dashpot_gives_restitution_zero() {
        for e in [0.0, -0.1, 1.0 + 1e-15, f64::NAN] {
            for dashpot in BOTH {
                assert_eq!(damping_ratio(e, dashpot).unwrap_err().quantity, "restitution");
            }
        }
        assert!(restitution(-1.0, Dashpot::MayPull).is_err());
        assert!(damping_ratio(f64::MIN_POSITIVE, Dashpot::PushesOnly).unwrap().is_finite());
    }
}
