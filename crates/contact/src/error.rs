/// A parameter of a contact law outside its allowed range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("{quantity} = {value:?} is outside the allowed range {:?} to {:?}", allowed.0, allowed.1)]
pub struct ContactError {
    /// What was out of range, in words.
    pub quantity: &'static str,
    /// Its value, SI.
    pub value: f64,
    /// The allowed range, lower and upper end. An end that f64 cannot hold strictly, such as
    /// "greater than 0", is given as the bound itself.
    pub allowed: (f64, f64),
}

/// Checks that `value` is positive and finite.
pub(crate) fn positive(quantity: &'static str, value: f64) -> Result<(), ContactError> {
    if value > 0.0 && value < f64::INFINITY {
        return Ok(());
    }
    Err(ContactError { quantity, value, allowed: (0.0, f64::INFINITY) })
}

/// Checks that `value` lies in the closed range `allowed`; NaN never does.
pub(crate) fn within(
    quantity: &'static str,
    value: f64,
    allowed: (f64, f64),
) -> Result<(), ContactError> {
    if allowed.0 <= value && value <= allowed.1 {
        return Ok(());
    }
    Err(ContactError { quantity, value, allowed })
}
