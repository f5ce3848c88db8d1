use pendular_pair::{Mate, OutOfRange};

use super::{Pair, Split, parabola, shipped};
use crate::{TableFault, TransferError};

/// V* at the upper end of every table.
const TOP: f64 = 0.5;
/// Nodes per decade of V*.
const PER_DECADE: i32 = 16;
/// Decades from the upper end down: the lowest node is V* = 5e-8.
const DECADES: i32 = 7;

/// Transfer ratio of one pair of bodies over V*, by linear interpolation.
///
/// The nodes lie evenly in ln V*, 16 to a decade, from V* = 5e-8 to 0.5 or over that part of it
/// where the parabola has a solution. V* = V/R³ with R of [`Pair::scale`].
///
/// # Range
/// Outside its nodes a table answers with an error, not with a guess. Bridges of very little
/// liquid do occur, though: [`TransferTable::clamped`] gives the value at the nearer end and says
/// that it did. Where the parabola has no solution for small volumes (unequal contact angles) that
/// value is one near 0 or 1, which is where the ratio goes.
///
/// Interpolation adds less than 5e-4 to the parabola's own error.
///
/// # Cost
/// [`TransferTable::compute`] solves the parabola at up to 113 volumes: about 1 ms in a release
/// build. A lookup is a binary search.
///
/// # Example
/// ```
/// use pendular_transfer::{Mate, split::TransferTable};
/// // A POM sphere (40°) on a large steel wall (45°) keeps a little more than half.
/// let angles = [40f64.to_radians(), 45f64.to_radians()];
/// let table = TransferTable::for_pair(5e-3, Mate::PLANE, angles)?;
/// let split = table.ratio(0.1)?;
/// assert!((split.transfer_ratio() - 0.529).abs() < 1e-3);
/// assert!(table.ratio(0.6).is_err());
/// # Ok::<(), pendular_transfer::TransferError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TransferTable {
    scale: f64,
    v_star: Vec<f64>,
    ratio: Vec<f64>,
}

/// What [`TransferTable::clamped`] found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lookup {
    /// The split to use.
    pub split: Split,
    /// Whether V* lay outside the table, so that the split is that of the nearer end.
    pub extrapolated: bool,
}

impl TransferTable {
    /// The table of a pair: the shipped one if there is one, else a computed one.
    ///
    /// Shipped are the pairs of Elskamp & Kruggel-Emden (2018); both ways give the same numbers.
    ///
    /// # Units
    /// `radius` rᵢ m, `contact_angles` [θᵢ, θⱼ] rad (sphere, mate).
    ///
    /// # Errors
    /// As [`Pair::new`] and [`TransferTable::compute`].
    pub fn for_pair(
        radius: f64,
        mate: Mate,
        contact_angles: [f64; 2],
    ) -> Result<Self, TransferError> {
        let pair = Pair::new(radius, mate, contact_angles)?;
        if let Some(table) = shipped::find(&pair)? {
            return Ok(table);
        }
        Self::compute(&pair)
    }

    /// Solves the parabola at every node.
    ///
    /// # Errors
    /// The parabola's error at V* = 0.5 if there are no two neighbouring nodes with a solution.
    pub fn compute(pair: &Pair) -> Result<Self, TransferError> {
        let at = |v_star: f64| parabola::split(pair, pair.volume(v_star));
        let (mut nodes, mut first_error) = (Vec::new(), None);
        for v_star in Self::grid().rev() {
            match at(v_star) {
                Ok(split) => nodes.push((v_star, split.transfer_ratio())),
                Err(_) if nodes.len() > 1 => break,
                Err(error) => {
                    nodes.clear();
                    first_error.get_or_insert(error);
                }
            }
        }
        nodes.reverse();
        let none = TransferError::Table { line: 0, reason: TableFault::TooShort };
        Self::from_nodes(pair, &nodes).map_err(|_| first_error.unwrap_or(none))
    }

    /// V* of all nodes that a table can have, rising from 5e-8 to 0.5.
    pub fn grid() -> impl DoubleEndedIterator<Item = f64> {
        (-PER_DECADE * DECADES..=0).map(|k| TOP * 10f64.powf(f64::from(k) / f64::from(PER_DECADE)))
    }

    /// A table from its nodes (V*, Tᵢ).
    pub(super) fn from_nodes(pair: &Pair, nodes: &[(f64, f64)]) -> Result<Self, TableFault> {
        if nodes.len() < 2 {
            return Err(TableFault::TooShort);
        }
        if nodes.windows(2).any(|w| w[0].0.partial_cmp(&w[1].0) != Some(std::cmp::Ordering::Less)) {
            return Err(TableFault::Order);
        }
        if nodes.iter().any(|(_, t)| !(0.0..=1.0).contains(t)) {
            return Err(TableFault::Ratio);
        }
        let (v_star, ratio) = nodes.iter().copied().unzip();
        Ok(Self { scale: pair.scale(), v_star, ratio })
    }

    /// The same table seen from the second body.
    pub(super) fn swapped(mut self) -> Self {
        self.ratio.iter_mut().for_each(|t| *t = 1.0 - *t);
        self
    }

    /// The nodes (V*, Tᵢ) in rising order of V*.
    pub fn nodes(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.v_star.iter().copied().zip(self.ratio.iter().copied())
    }

    /// Smallest and largest V* of the table.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        (self.v_star[0], self.v_star[self.v_star.len() - 1])
    }

    /// V* = V/R³ of a volume in m³, on the pair's own R ([`Pair::scale`]).
    #[must_use]
    pub fn v_star(&self, volume: f64) -> f64 {
        (volume.cbrt() / self.scale).powi(3)
    }

    /// The split at V*, by linear interpolation between the nodes.
    ///
    /// # Errors
    /// [`TransferError::OutOfRange`] outside [`TransferTable::range`].
    pub fn ratio(&self, v_star: f64) -> Result<Split, TransferError> {
        OutOfRange::within("dimensionless volume V/R^3", v_star, self.range())?;
        self.interpolate(v_star)
    }

    /// The split at a volume in m³, as [`TransferTable::ratio`].
    ///
    /// # Errors
    /// [`TransferError::OutOfRange`] outside [`TransferTable::range`].
    pub fn at_volume(&self, volume: f64) -> Result<Split, TransferError> {
        self.ratio(self.v_star(volume))
    }

    /// The split at a volume in m³; outside the table that of its nearer end, and flagged.
    ///
    /// # Errors
    /// [`TransferError::OutOfRange`] if the volume is negative or not finite.
    pub fn clamped(&self, volume: f64) -> Result<Lookup, TransferError> {
        OutOfRange::within("bridge volume", volume, (0.0, f64::MAX))?;
        let (low, high) = self.range();
        let v_star = self.v_star(volume);
        let inside = v_star.clamp(low, high);
        Ok(Lookup { split: self.interpolate(inside)?, extrapolated: inside != v_star })
    }

    fn interpolate(&self, v_star: f64) -> Result<Split, TransferError> {
        let above = self.v_star.partition_point(|v| *v <= v_star).clamp(1, self.v_star.len() - 1);
        let below = above - 1;
        let t = (v_star - self.v_star[below]) / (self.v_star[above] - self.v_star[below]);
        Ok(Split::new(self.ratio[below] * (1.0 - t) + self.ratio[above] * t)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair(mate: Mate, deg: [f64; 2]) -> Pair {
        Pair::new(5e-3, mate, deg.map(f64::to_radians)).unwrap()
    }

    #[test]
    fn interpolation_is_close_to_the_solver() {
        let mates = [Mate::Sphere { radius: 2.5e-3 }, Mate::PLANE, Mate::Wall { half_side: 1e-3 }];
        for (mate, deg) in mates.into_iter().zip([[15.0, 15.0], [40.0, 45.0], [15.0, 45.0]]) {
            let p = pair(mate, deg);
            let table = TransferTable::compute(&p).unwrap();
            let nodes: Vec<(f64, f64)> = table.nodes().collect();
            for w in nodes.windows(2) {
                let middle = (w[0].0 * w[1].0).sqrt();
                let exact = parabola::split(&p, p.volume(middle)).unwrap().transfer_ratio();
                let got = table.ratio(middle).unwrap().transfer_ratio();
                assert!((got - exact).abs() < 5e-4, "{mate:?} {middle}: {got} {exact}");
            }
        }
    }

    #[test]
    fn nodes_are_met_and_outside_is_an_error() {
        let p = pair(Mate::Sphere { radius: 3e-3 }, [40.0; 2]);
        let table = TransferTable::compute(&p).unwrap();
        assert_eq!(table.range().1, 0.5);
        assert!((table.range().0 / 5e-8 - 1.0).abs() < 1e-12);
        for (v, t) in table.nodes() {
            assert_eq!(table.ratio(v).unwrap().transfer_ratio(), t);
        }
        for v in [1e-9, 0.50001, f64::NAN, -1.0] {
            let said = table.ratio(v).unwrap_err().to_string();
            assert!(said.contains("V/R^3"), "{said}");
        }
    }

    #[test]
    fn clamping_is_flagged() {
        let p = pair(Mate::PLANE, [15.0, 45.0]);
        let table = TransferTable::compute(&p).unwrap();
        let inside = table.clamped(p.volume(0.1)).unwrap();
        assert_eq!((inside.extrapolated, inside.split), (false, table.ratio(0.1).unwrap()));
        let thin = table.clamped(p.volume(1e-12)).unwrap();
        assert!(thin.extrapolated);
        assert_eq!(thin.split, table.ratio(table.range().0).unwrap());
        assert!(thin.split.transfer_ratio() > 0.9, "the better wetted sphere keeps it");
        assert!(table.clamped(p.volume(3.0)).unwrap().extrapolated);
        assert!(table.clamped(0.0).unwrap().extrapolated);
        assert!(table.clamped(f64::NAN).is_err());
        assert!(table.clamped(-1e-12).is_err());
    }

    #[test]
    fn a_pair_without_solution_says_why() {
        let error = TransferTable::compute(&pair(Mate::PLANE, [100.0, 45.0])).unwrap_err();
        assert!(error.to_string().contains("90 degrees"), "{error}");
    }
}
