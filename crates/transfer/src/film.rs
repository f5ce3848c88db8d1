//! Liquid films: thickness from volume and back.
//!
//! ```text
//! sphere   h = ∛(3 L/(4π) + r³) − r        L = (4π/3) h (h² + 3 h r + 3 r²)
//! wall     h = L/A
//! ```
//! Every film is taken to be even over its body (Elskamp & Kruggel-Emden 2018, eq. 34; the
//! volume there is printed as the bridge's and is meant to be all the liquid L on the particle).

use std::f64::consts::PI;

use pendular_pair::OutOfRange;

use crate::TransferError;

/// Thickness h of an even film on a sphere, m.
///
/// Exact for thin films too: the difference of two nearly equal lengths is rewritten.
///
/// # Units
/// `radius` r m, greater than 0; `volume` L m³, at least 0.
///
/// # Errors
/// [`TransferError::OutOfRange`] for anything else, and where h is no finite number.
///
/// # Example
/// ```
/// // A layer as thick as the sphere's radius holds seven times the sphere.
/// let sphere = 4.0 / 3.0 * std::f64::consts::PI;
/// let h = pendular_transfer::film::thickness(1.0, 7.0 * sphere)?;
/// assert!((h - 1.0).abs() < 1e-15);
/// # Ok::<(), pendular_transfer::TransferError>(())
/// ```
pub fn thickness(radius: f64, volume: f64) -> Result<f64, TransferError> {
    OutOfRange::positive("radius", radius)?;
    not_negative("film volume", volume)?;
    let added = 3.0 * volume / (4.0 * PI) / radius / radius / radius;
    let k = (1.0 + added).cbrt();
    let h = radius * (added / (k * k + k + 1.0));
    finite("film thickness", h)
}

/// Volume L of an even film on a sphere, m³.
///
/// # Units
/// `radius` r m, greater than 0; `thickness` h m, at least 0.
///
/// # Errors
/// [`TransferError::OutOfRange`] for anything else, and where L is no finite number.
pub fn volume(radius: f64, thickness: f64) -> Result<f64, TransferError> {
    OutOfRange::positive("radius", radius)?;
    not_negative("film thickness", thickness)?;
    let h = thickness;
    finite("film volume", 4.0 * PI / 3.0 * h * (h * h + 3.0 * h * radius + 3.0 * radius * radius))
}

/// Thickness of an even film on a wall, m: its volume over its area.
///
/// # Units
/// `area` m², greater than 0; `volume` m³, at least 0.
///
/// # Errors
/// [`TransferError::OutOfRange`] for anything else, and where the result is no finite number.
pub fn wall_thickness(area: f64, volume: f64) -> Result<f64, TransferError> {
    OutOfRange::positive("wall area", area)?;
    not_negative("film volume", volume)?;
    finite("film thickness", volume / area)
}

pub(crate) fn not_negative(quantity: &'static str, value: f64) -> Result<(), OutOfRange> {
    OutOfRange::within(quantity, value, (0.0, f64::MAX))
}

fn finite(quantity: &'static str, value: f64) -> Result<f64, TransferError> {
    not_negative(quantity, value)?;
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Erratum: with all the liquid on the particle the shell between r and r + h holds it.
    #[test]
    fn the_shell_holds_all_liquid_on_the_particle() {
        for (r, liquid) in [(5e-3_f64, 3.6e-8), (1.5e-3, 1e-9), (19e-6, 2e-19)] {
            let h = thickness(r, liquid).unwrap();
            let shell = 4.0 / 3.0 * PI * ((r + h).powi(3) - r.powi(3));
            assert_relative_eq!(shell, liquid, max_relative = 1e-9);
            assert_relative_eq!(volume(r, h).unwrap(), liquid, max_relative = 1e-14);
        }
    }

    #[test]
    fn a_thin_film_is_volume_over_area_without_cancellation() {
        let (r, liquid) = (5e-3_f64, 1e-24_f64);
        let flat = liquid / (4.0 * PI * r * r);
        // The next term is −h/r relative, 6e-19 here.
        assert_relative_eq!(thickness(r, liquid).unwrap(), flat, max_relative = 1e-15);
        let printed = (3.0 * liquid / (4.0 * PI) + r.powi(3)).cbrt() - r;
        assert!((printed - flat).abs() > 0.5 * flat, "the printed form has lost every digit");
    }

    #[test]
    fn dry_is_zero_and_bad_values_are_named() {
        assert_eq!(thickness(1.0, 0.0).unwrap(), 0.0);
        assert_eq!(wall_thickness(2.0, 1.0).unwrap(), 0.5);
        let said = thickness(1.0, f64::NAN).unwrap_err().to_string();
        assert!(said.contains("film volume"), "{said}");
        assert!(volume(-1.0, 0.0).is_err());
        assert!(wall_thickness(0.0, 1.0).is_err());
        assert!(thickness(1e-200, 1e300).is_err(), "no silent infinity or NaN");
        assert!(wall_thickness(1e-300, 1e300).is_err());
    }
}
