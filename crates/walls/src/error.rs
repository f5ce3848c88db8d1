use std::path::PathBuf;

/// Where a mesh came from, for messages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// Arrays handed over by the caller.
    Arrays,
    /// A file.
    File(PathBuf),
}

impl std::fmt::Display for Origin {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Arrays => f.write_str("mesh from arrays"),
            Self::File(path) => write!(f, "{}", path.display()),
        }
    }
}

/// What is wrong with a wall.
#[derive(Debug, thiserror::Error)]
pub enum WallError {
    /// A file cannot be read at all.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// A file is not a well-formed STL file.
    #[error("{}: not a well-formed STL file: {reason}", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// A mesh without a triangle.
    #[error("{origin}: no triangle")]
    Empty {
        /// The mesh.
        origin: Origin,
    },
    /// A vertex of a triangle has a coordinate that is NaN or infinite.
    #[error("{origin}: triangle {triangle} has a coordinate that is not finite")]
    NotFinite {
        /// The mesh.
        origin: Origin,
        /// Index of the triangle, from 0.
        triangle: usize,
    },
    /// A triangle without area: two corners coincide, or all three lie on a line.
    #[error("{origin}: triangle {triangle} has no area")]
    Degenerate {
        /// The mesh.
        origin: Origin,
        /// Index of the triangle, from 0.
        triangle: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names vertex {vertex}, but there are {count} vertices")]
    NoVertex {
        /// Index of the triangle, from 0.
        triangle: usize,
        /// The vertex it names.
        vertex: u32,
        /// Number of vertices.
        count: usize,
    },
    /// A number outside its allowed range.
    #[error("{part}: {quantity} = {value:?} is outside the allowed range {:?} to {:?}", allowed.0, allowed.1)]
    OutOfRange {
        /// Name of the part, or of the kind of shape before it has one.
        part: String,
        /// What was out of range, in words.
        quantity: &'static str,
        /// Its value (SI).
        value: f64,
        /// The allowed range, lower and upper end.
        allowed: (f64, f64),
    },
    /// Two parts share a name; results are listed by name.
    #[error("two parts are called \"{name}\"")]
    DuplicateName {
        /// The name.
        name: String,
    },
}

impl WallError {
    /// Checks that `value` is positive and finite.
    pub(crate) fn positive(part: &str, quantity: &'static str, value: f64) -> Result<(), Self> {
        if value > 0.0 && value < f64::INFINITY {
            return Ok(());
        }
        Err(Self::OutOfRange { part: part.into(), quantity, value, allowed: (0.0, f64::INFINITY) })
    }

    /// Checks that all coordinates are finite.
    pub(crate) fn finite(
        part: &str,
        quantity: &'static str,
        values: glam::DVec3,
    ) -> Result<(), Self> {
        let allowed = (-f64::MAX, f64::MAX);
        match values.to_array().into_iter().find(|v| !v.is_finite()) {
            None => Ok(()),
            Some(value) => Err(Self::OutOfRange { part: part.into(), quantity, value, allowed }),
        }
    }

    /// Checks that `value` lies in the closed range `allowed`; NaN never does.
    pub(crate) fn within(
        part: &str,
        quantity: &'static str,
        value: f64,
        allowed: (f64, f64),
    ) -> Result<(), Self> {
        if allowed.0 <= value && value <= allowed.1 {
            return Ok(());
        }
        Err(Self::OutOfRange { part: part.into(), quantity, value, allowed })
    }

    /// Checks that a count is at least `least`.
    pub(crate) fn count(
        part: &str,
        quantity: &'static str,
        value: u32,
        least: u32,
    ) -> Result<(), Self> {
        Self::within(part, quantity, value.into(), (least.into(), u32::MAX.into()))
    }
}
