/// Why there is no exact bridge.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// The gap is not a number or infinite.
    #[error("the gap {gap} m is not finite")]
    Gap {
        /// Gap that was asked for, m.
        gap: f64,
    },
    /// The gap is beyond the rupture distance: no stable bridge spans it.
    #[error("no stable bridge spans the gap {gap} m: it ruptures at {rupture_distance} m")]
    Ruptured {
        /// Gap that was asked for, m.
        gap: f64,
        /// Rupture distance S_rup, m.
        rupture_distance: f64,
    },
    /// No stable bridge was found even between bodies in contact.
    #[error(
        "no stable bridge of V/R^3 = {v_star} between touching bodies (angles {} and {} rad)",
        contact_angles[0],
        contact_angles[1]
    )]
    NoStableBridge {
        /// Dimensionless volume V* = V/R³.
        v_star: f64,
        /// Contact angles, rad.
        contact_angles: [f64; 2],
    },
    /// The solver could not follow the bridge as far as was asked.
    #[error("the Young-Laplace solver lost the bridge of V/R^3 = {v_star} at a gap of {gap} m")]
    NotConverged {
        /// Dimensionless volume V* = V/R³.
        v_star: f64,
        /// Gap of the last bridge found, m.
        gap: f64,
    },
}
