//! What became of a row.

use std::fmt;

use pendular_capillary::young_laplace::SolveError;

/// How far an answer can be trusted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Trust {
    Ok,
    Extrapolated,
}

/// Why a row has no answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Trouble {
    NotANumber,
    Invalid,
    OutOfRange,
    NoValue,
    NoBridge,
    Ruptured,
    NoSolution,
    Lost,
}

/// A result, or why there is none.
pub(crate) type Answer = Result<(f64, Trust), Trouble>;

impl fmt::Display for Trust {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Ok => "ok",
            Self::Extrapolated => "extrapolated",
        })
    }
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotANumber => "not-a-number",
            Self::Invalid => "invalid",
            Self::OutOfRange => "out-of-range",
            Self::NoValue => "no-value",
            Self::NoBridge => "no-bridge",
            Self::Ruptured => "ruptured",
            Self::NoSolution => "no-solution",
            Self::Lost => "lost",
        })
    }
}

impl From<SolveError> for Trouble {
    fn from(error: SolveError) -> Self {
        match error {
            SolveError::Gap { .. } => Self::Invalid,
            SolveError::Ruptured { .. } => Self::Ruptured,
            SolveError::NoStableBridge { .. } => Self::NoBridge,
            _ => Self::Lost,
        }
    }
}

/// The two columns of an answer: 17 significant digits or nothing, and the status.
pub(crate) fn columns(answer: Answer) -> [String; 2] {
    match answer {
        Ok((value, trust)) if value.is_finite() => [digits(value), trust.to_string()],
        Ok(_) => [String::new(), Trouble::NoValue.to_string()],
        Err(trouble) => [String::new(), trouble.to_string()],
    }
}

/// A number with 17 significant digits: reads back to the same bits.
pub(crate) fn digits(value: f64) -> String {
    format!("{value:.16e}")
}
