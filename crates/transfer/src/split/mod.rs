//! Who gets the liquid of a ruptured bridge.

mod exact;
mod pair;
pub mod parabola;
mod profile;
mod shipped;
mod table;

pub use exact::exact;
pub use pair::{Kind, Pair};
pub use shipped::{NamedPair, pairs as shipped_pairs, read_pairs};
pub use table::{Lookup, TransferTable};

use pendular_pair::OutOfRange;

/// How the volume of a ruptured bridge is shared: one number, so that nothing can get lost.
///
/// ```
/// use pendular_transfer::Split;
/// let [first, second] = Split::new(0.25)?.shares(8.0);
/// assert_eq!([first, second], [2.0, 6.0]);
/// # Ok::<(), pendular_transfer::OutOfRange>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Split(f64);

impl Split {
    /// Half to each body.
    pub const HALF: Self = Self(0.5);

    /// A split from the transfer ratio Tᵢ, the share that goes to the first body.
    ///
    /// # Errors
    /// [`OutOfRange`] unless 0 ≤ Tᵢ ≤ 1.
    pub fn new(transfer_ratio: f64) -> Result<Self, OutOfRange> {
        OutOfRange::within("transfer ratio", transfer_ratio, (0.0, 1.0))?;
        Ok(Self(transfer_ratio))
    }

    /// Share Tᵢ of the first body, 0 to 1.
    #[must_use]
    pub fn transfer_ratio(self) -> f64 {
        self.0
    }

    /// Volumes [V Tᵢ, V − V Tᵢ] that go to the first and to the second body, m³.
    #[must_use]
    pub fn shares(self, volume: f64) -> [f64; 2] {
        let first = volume * self.0;
        [first, volume - first]
    }

    /// The same split seen from the second body.
    #[must_use]
    pub fn swapped(self) -> Self {
        Self(1.0 - self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_add_up_and_are_never_negative() {
        for t in [0.0, 1e-17, 0.1, 1.0 / 3.0, 0.5, 0.7, 1.0 - 1e-16, 1.0] {
            for v in [0.0, 1e-300, 3.3e-12, 1e-9, 7e5] {
                let [a, b] = Split::new(t).unwrap().shares(v);
                assert!(a >= 0.0 && b >= 0.0);
                assert!((a + b - v).abs() <= f64::EPSILON * v);
            }
        }
    }

    #[test]
    fn only_ratios_are_taken() {
        assert!(Split::new(f64::NAN).is_err());
        assert!(Split::new(-0.1).is_err());
        assert!(Split::new(1.1).is_err());
        assert_eq!(Split::new(0.25).unwrap().swapped().transfer_ratio(), 0.75);
    }
}
