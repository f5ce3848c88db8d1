use pendular_pair::{Bridge, OutOfRange, Range, Validity};

/// A model of the gap at which a bridge breaks.
pub trait RuptureLaw {
    /// The bridges over which the law holds.
    fn validity(&self) -> Validity;

    /// The bridges between a sphere and a wall over which the law holds; unless it says otherwise
    /// those of [`RuptureLaw::validity`].
    fn wall_validity(&self) -> Validity {
        self.validity()
    }

    /// Which of the two holds for a bridge.
    fn validity_of(&self, bridge: &Bridge) -> Validity {
        if bridge.mate().is_wall() { self.wall_validity() } else { self.validity() }
    }

    /// Static rupture distance S_rup, m, at least 0. A dynamic factor multiplies it.
    ///
    /// # Errors
    /// [`OutOfRange`] if the bridge lies outside [`RuptureLaw::validity_of`] and `range` is strict,
    /// or, with either, where the law's formula has no (non-negative, finite) value.
    fn distance(&self, bridge: &Bridge, range: Range) -> Result<f64, OutOfRange>;
}
