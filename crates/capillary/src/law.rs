use pendular_lane::Lane;
use pendular_pair::{Bridge, OutOfRange, Range, Validity};

/// A model of the static capillary force of a liquid bridge at constant volume.
pub trait CapillaryLaw {
    /// The force over the gap of one bridge.
    type Curve: ForceCurve;

    /// The bridges over which the law holds.
    fn validity(&self) -> Validity;

    /// Folds a bridge into its force curve: all trigonometry, logarithms and fits happen here.
    ///
    /// # Errors
    /// [`OutOfRange`] if the bridge lies outside [`CapillaryLaw::validity`] and `range` is strict,
    /// or, with either, where the law's formula has no value.
    fn curve(&self, bridge: &Bridge, range: Range) -> Result<Self::Curve, OutOfRange>;

    /// The force of one bridge at one gap, N, tension positive: curve and evaluation in one.
    ///
    /// # Errors
    /// As [`CapillaryLaw::curve`].
    fn force(&self, bridge: &Bridge, gap: f64, range: Range) -> Result<f64, OutOfRange> {
        Ok(self.curve(bridge, range)?.force(gap))
    }
}

/// The capillary force of one bridge as a function of the gap alone.
pub trait ForceCurve: Copy {
    /// Force along the line of centres, N; tension (attraction) is positive.
    ///
    /// `gap` S is the distance of the surfaces, m. Overlap (S < 0) reads as S = 0. The value is
    /// finite for every gap, also beyond the rupture distance, which is not this law's business.
    fn force(&self, gap: f64) -> f64;

    /// The forces of bridges side by side: to the bit what [`ForceCurve::force`] gives for each.
    #[inline(always)]
    fn forces<L: Lane>(curves: &L::Each<&Self>, gap: L) -> L {
        let gaps = gap.unpack();
        L::pack(gap.permit(), &L::each(|k| curves[k].force(gaps[k])), |force| *force)
    }
}
