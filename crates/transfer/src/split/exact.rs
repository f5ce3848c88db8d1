//! Transfer ratio at the neck of the exact bridge.

use pendular_capillary::tabulated;
use pendular_pair::{Bridge, OutOfRange};

use super::Split;

/// The split of a bridge at the neck of its last stable Young-Laplace shape, from the table of
/// `pendular-capillary`.
///
/// It has a solution for every bridge that breaks, unlike the [parabola](super::parabola), and
/// orders contact angles rightly. Within 3e-3 of the exact share.
///
/// # Errors
/// [`OutOfRange`] where neither the table nor the exact solver has a stable bridge.
///
/// # Example
/// ```
/// use pendular_transfer::{Bridge, Mate, split};
/// let bridge = Bridge::new(1e-3, Mate::Sphere { radius: 1e-3 }, 1e-12, [0.5; 2], 0.07)?;
/// // Equal bodies share alike.
/// assert!((split::exact(&bridge)?.transfer_ratio() - 0.5).abs() < 1e-9);
/// # Ok::<(), pendular_transfer::OutOfRange>(())
/// ```
pub fn exact(bridge: &Bridge) -> Result<Split, OutOfRange> {
    Split::new(tabulated::transfer_ratio(bridge)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pendular_pair::Mate;

    #[test]
    fn glass_on_steel_as_the_exact_bridge_has_it() {
        // Sphere at 15°, plane at 45°: 0.80, 0.68, 0.28 at V/r³ = 0.01, 0.1, 0.3.
        for (volume, share) in [(0.01, 0.80), (0.1, 0.68), (0.3, 0.28)] {
            let angles = [15_f64.to_radians(), 45_f64.to_radians()];
            let bridge = Bridge::new(1.0, Mate::PLANE, volume, angles, 0.07).unwrap();
            let ratio = exact(&bridge).unwrap().transfer_ratio();
            assert!((ratio - share).abs() < 0.006, "{volume}: {ratio}");
        }
    }
}
