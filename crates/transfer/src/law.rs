use pendular_pair::{Bridge, OutOfRange, Range, Validity};

/// A model of the gap at which a bridge breaks.
pub trait RuptureLaw {
    /// The bridges over which the law holds.
    fn validity(&self) -> Validity;

    /// Static rupture distance S_rup, m, at least 0. A dynamic factor multiplies it.
    ///
    /// # Errors
    /// [`OutOfRange`] if the bridge lies outside [`RuptureLaw::validity`] and `range` is strict,
    /// or, with either, where the law's formula has no (non-negative, finite) value.
    fn distance(&self, bridge: &Bridge, range: Range) -> Result<f64, OutOfRange>;
}
