//! Checks on folded constants: a bridge may be valid and still leave the reach of `f64`.

use pendular_pair::OutOfRange;

/// `value` if it is positive and finite.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<f64, OutOfRange> {
    OutOfRange::positive(quantity, value)?;
    Ok(value)
}

/// `value` if it is finite.
pub(crate) fn finite(quantity: &'static str, value: f64) -> Result<f64, OutOfRange> {
    OutOfRange::within(quantity, value, (f64::MIN, f64::MAX))?;
    Ok(value)
}

#[cfg(test)]
pub(crate) mod bridges {
    //! Bridges that the unit tests share.

    use pendular_pair::{Bridge, Mate};

    /// Case W11 of Gladkyy & Schwarze (2014), Table 1.
    pub(crate) fn w11() -> Bridge {
        spheres(2.381e-3, 2.381e-3, 13.6e-12, [0.0; 2], 20.6e-3)
    }

    /// Two spheres.
    pub(crate) fn spheres(
        first: f64,
        second: f64,
        volume: f64,
        angles: [f64; 2],
        tension: f64,
    ) -> Bridge {
        Bridge::new(first, Mate::Sphere { radius: second }, volume, angles, tension).unwrap()
    }

    /// A sphere on a plane.
    pub(crate) fn plane(radius: f64, volume: f64, angles: [f64; 2], tension: f64) -> Bridge {
        Bridge::new(radius, Mate::PLANE, volume, angles, tension).unwrap()
    }

    /// The pair of Yade's `checkCapillaryModels.py`: r_i = 19 µm, both angles 10°, and the gap at
    /// which it reads the force.
    pub(crate) fn yade(mate: f64, volume: f64, tension: f64) -> (Bridge, f64) {
        let angle = 10f64.to_radians();
        let gap = 249e-9 - 1e-5 * (19e-6 + mate);
        (spheres(19e-6, mate, volume, [angle; 2], tension), gap)
    }
}
