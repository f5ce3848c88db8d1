//! How much liquid each body gives to a new bridge.
//!
//! A bridge forms when the films touch, S ≤ hᵢ + hⱼ ([`films_touch`]). Each body gives the liquid
//! on the cap that faces the other:
//!
//! ```text
//! two spheres   Vᵢ = (Lᵢ/2) (1 − √(1 − rⱼ²/(rᵢ + rⱼ)²)),   Vⱼ likewise
//! large wall    Vᵢ = (Lᵢ/2) (1 − √0.75),                    V_w = h_w (π/4) rᵢ²      r_w ≥ rᵢ
//! small wall    Vᵢ = Lᵢ r_w/(6 rᵢ),                         V_w = h_w rᵢ 2 r_w       r_w < rᵢ
//! ```
//! with Lᵢ all the liquid on particle i, r_w the wall's half side, h_w its film thickness.
//!
//! No claim exceeds what its body has: the sphere fractions are below 1/2 (two spheres),
//! 0.067 (large wall) and 1/6 (small wall), and of a wall's film no more than all is claimed, even
//! if the projected area is larger than the wall element. Several bridges that form on one body at
//! the same time can together still claim too much: that is for whoever books them.
//!
//! Between a large and a small wall the particle's fraction jumps (0.067 to 1/6 at r_w = rᵢ): so
//! the source has it. It leaves r_w = rᵢ open; here that is a large wall.
//!
//! # References
//! Shi & McCarthy (2008), Powder Technol. 184, 64 (two spheres); Elskamp & Kruggel-Emden (2018),
//! Chem. Eng. Res. Des. 136, 593, eqs. (8) to (13).

use std::f64::consts::PI;

use pendular_pair::{Mate, OutOfRange};

use crate::TransferError;
use crate::film::not_negative;

/// The second body of a bridge about to form, with the liquid on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WetMate {
    /// Another sphere.
    Sphere {
        /// Radius r_j, m.
        radius: f64,
        /// All liquid L_j on it, m³.
        film_volume: f64,
    },
    /// A wall, or the element of a wall that carries its own film.
    Wall {
        /// Half the wall's width r_w, m; a wire's radius, `f64::INFINITY` for a plane.
        half_side: f64,
        /// All liquid on the wall or element, m³.
        film_volume: f64,
        /// Area of the wall or element over which that liquid lies, m².
        area: f64,
    },
}

impl WetMate {
    /// The body without its liquid.
    #[must_use]
    pub fn mate(self) -> Mate {
        match self {
            Self::Sphere { radius, .. } => Mate::Sphere { radius },
            Self::Wall { half_side, .. } => Mate::Wall { half_side },
        }
    }
}

/// Whether two films touch, S ≤ hᵢ + hⱼ. `gap` S m (negative in overlap), film thicknesses m.
///
/// Two dry bodies (both thicknesses 0) do not form a bridge, in contact or not.
#[must_use]
pub fn films_touch(gap: f64, thicknesses: [f64; 2]) -> bool {
    let reach = thicknesses[0] + thicknesses[1];
    reach > 0.0 && gap <= reach
}

/// Fraction Vᵢ/Lᵢ of the liquid on the first sphere that goes into a bridge with `mate`.
///
/// # Units
/// `radius` rᵢ m, greater than 0. The result lies in [0, 1/2].
///
/// # Errors
/// [`TransferError::OutOfRange`] unless the lengths are positive (a half side may be infinite).
///
/// # Example
/// ```
/// // Equal spheres: (1 − √0.75)/2, a cap of 30°.
/// use pendular_transfer::{Mate, formation};
/// let f = formation::sphere_fraction(1e-3, Mate::Sphere { radius: 1e-3 })?;
/// assert!((f - 0.0669872981077807).abs() < 1e-15);
/// # Ok::<(), pendular_transfer::TransferError>(())
/// ```
pub fn sphere_fraction(radius: f64, mate: Mate) -> Result<f64, TransferError> {
    OutOfRange::positive("radius", radius)?;
    match mate {
        Mate::Sphere { radius: other } => {
            OutOfRange::positive("mate radius", other)?;
            Ok(cap_fraction(1.0 / (1.0 + radius / other)))
        }
        Mate::Wall { half_side } => {
            check_half_side(half_side)?;
            Ok(if half_side >= radius { cap_fraction(0.5) } else { half_side / (6.0 * radius) })
        }
    }
}

/// Area of the wall whose film goes into a bridge with a sphere, m².
///
/// # Units
/// `radius` rᵢ m, greater than 0; `half_side` r_w m, greater than 0, may be infinite.
///
/// # Errors
/// [`TransferError::OutOfRange`] otherwise.
pub fn wall_area(radius: f64, half_side: f64) -> Result<f64, TransferError> {
    OutOfRange::positive("radius", radius)?;
    check_half_side(half_side)?;
    let large = half_side >= radius;
    Ok(if large { PI / 4.0 * radius * radius } else { radius * 2.0 * half_side })
}

/// Volumes [Vᵢ, Vⱼ] that sphere i and its mate would give to a new bridge, m³.
///
/// # Units
/// `radius` rᵢ m, greater than 0; `film_volume` Lᵢ m³, at least 0.
///
/// # Errors
/// [`TransferError::OutOfRange`] unless all lengths and areas are positive (a half side may be
/// infinite) and all volumes finite and not negative.
pub fn claims(radius: f64, film_volume: f64, mate: WetMate) -> Result<[f64; 2], TransferError> {
    not_negative("film volume", film_volume)?;
    let first = film_volume * sphere_fraction(radius, mate.mate())?;
    let second = match mate {
        WetMate::Sphere { radius: other, film_volume } => {
            not_negative("film volume", film_volume)?;
            film_volume * sphere_fraction(other, Mate::Sphere { radius })?
        }
        WetMate::Wall { half_side, film_volume, area } => {
            not_negative("film volume", film_volume)?;
            OutOfRange::positive("wall area", area)?;
            film_volume * (wall_area(radius, half_side)? / area).min(1.0)
        }
    };
    Ok([first, second])
}

/// (1 − √(1 − s²))/2 for the sine s of a cap's half angle, without cancellation.
fn cap_fraction(sine: f64) -> f64 {
    let s2 = sine * sine;
    0.5 * s2 / (1.0 + (1.0 - s2).sqrt())
}

fn check_half_side(half_side: f64) -> Result<(), OutOfRange> {
    if half_side == f64::INFINITY {
        return Ok(());
    }
    OutOfRange::positive("wall half side", half_side)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn unequal_spheres_by_hand() {
        // r = 3 and 1: sines 1/4 and 3/4; √(1 − 1/16) = √15/4, √(1 − 9/16) = √7/4.
        let mate = WetMate::Sphere { radius: 1.0, film_volume: 2.0 };
        let [first, second] = claims(3.0, 4.0, mate).unwrap();
        assert_relative_eq!(first, 2.0 * (1.0 - 15f64.sqrt() / 4.0), max_relative = 1e-14);
        assert_relative_eq!(second, 1.0 - 7f64.sqrt() / 4.0, max_relative = 1e-14);
    }

    #[test]
    fn the_cap_is_a_share_of_the_sphere_area() {
        // Cap area 2π r d over 4π r², with d the immersion of E18 eq. (7).
        let (ri, rj): (f64, f64) = (5e-3, 3.5e-3);
        let d = ri - (ri * ri - (ri * rj / (ri + rj)).powi(2)).sqrt();
        let f = sphere_fraction(ri, Mate::Sphere { radius: rj }).unwrap();
        assert_relative_eq!(f, d / (2.0 * ri), max_relative = 1e-12);
    }

    #[test]
    fn large_wall_small_wall_and_the_seam() {
        let plane = sphere_fraction(1.0, Mate::PLANE).unwrap();
        assert_relative_eq!(plane, 0.5 * (1.0 - 0.75f64.sqrt()), max_relative = 1e-14);
        assert_eq!(sphere_fraction(1.0, Mate::Wall { half_side: 1.0 }).unwrap(), plane);
        let wire = sphere_fraction(5e-3, Mate::Wall { half_side: 1e-3 }).unwrap();
        assert_relative_eq!(wire, 1.0 / 30.0, max_relative = 1e-15);
        assert_relative_eq!(wall_area(5e-3, 1e-3).unwrap(), 1e-5, max_relative = 1e-15);
        assert_relative_eq!(wall_area(2.0, f64::INFINITY).unwrap(), PI, max_relative = 1e-15);
    }

    #[test]
    fn a_wall_gives_its_film_thickness_times_the_projection() {
        let wall = WetMate::Wall { half_side: f64::INFINITY, film_volume: 6e-9, area: 1e-3 };
        let [_, given] = claims(5e-3, 0.0, wall).unwrap();
        assert_relative_eq!(given, 6e-6 * PI / 4.0 * 25e-6, max_relative = 1e-14);
    }

    #[test]
    fn no_body_gives_more_than_it_has() {
        // The projection of the sphere is 20 times the element: all of the film, not more.
        let tiny = WetMate::Wall { half_side: f64::INFINITY, film_volume: 1e-9, area: 1e-6 };
        assert_eq!(claims(5e-3, 1e-9, tiny).unwrap()[1], 1e-9);
        for ratio in [1e-12, 1e-3, 1.0, 1e3, 1e12] {
            let mate = WetMate::Sphere { radius: ratio, film_volume: 1.0 };
            let given = claims(1.0, 1.0, mate).unwrap();
            assert!(given.iter().all(|v| (0.0..=0.5).contains(v)), "{ratio}: {given:?}");
        }
    }

    #[test]
    fn claims_are_symmetric_in_the_spheres() {
        let one = claims(2.0, 3.0, WetMate::Sphere { radius: 5.0, film_volume: 7.0 }).unwrap();
        let two = claims(5.0, 7.0, WetMate::Sphere { radius: 2.0, film_volume: 3.0 }).unwrap();
        assert_eq!(one, [two[1], two[0]]);
    }

    #[test]
    fn films_touch_at_the_sum_and_dry_bodies_never() {
        assert!(films_touch(3.0, [1.0, 2.0]));
        assert!(!films_touch(3.1, [1.0, 2.0]));
        assert!(!films_touch(-1.0, [0.0, 0.0]));
        assert!(!films_touch(f64::NAN, [1.0, 1.0]));
    }

    #[test]
    fn bad_values_are_typed_errors() {
        assert!(sphere_fraction(f64::NAN, Mate::PLANE).is_err());
        assert!(claims(1.0, -1.0, WetMate::Sphere { radius: 1.0, film_volume: 0.0 }).is_err());
        let wall = WetMate::Wall { half_side: 0.0, film_volume: 0.0, area: 1.0 };
        assert!(claims(1.0, 0.0, wall).is_err());
    }
}
