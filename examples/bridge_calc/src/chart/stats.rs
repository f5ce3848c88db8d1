//! Statistics of errors.

/// Median, 95th percentile and worst of some errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stats {
    pub(crate) count: usize,
    pub(crate) median: f64,
    pub(crate) most: f64,
    pub(crate) worst: f64,
}

impl Stats {
    /// Statistics of absolute values; `None` of nothing.
    pub(crate) fn of(errors: impl IntoIterator<Item = f64>) -> Option<Self> {
        let mut all: Vec<f64> = errors.into_iter().map(f64::abs).collect();
        all.sort_by(f64::total_cmp);
        // The smallest value that at least this share does not exceed.
        let at = |share: f64| {
            let rank = (share * all.len() as f64).ceil() as usize;
            all.get(rank.saturating_sub(1)).copied()
        };
        Some(Self { count: all.len(), median: at(0.5)?, most: at(0.95)?, worst: at(1.0)? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_by_hand() {
        let stats = Stats::of((1..=100).map(|k| -f64::from(k))).unwrap();
        assert_eq!(stats, Stats { count: 100, median: 50.0, most: 95.0, worst: 100.0 });
        let one = Stats::of([3.0]).unwrap();
        assert_eq!((one.median, one.most, one.worst), (3.0, 3.0, 3.0));
        assert_eq!(Stats::of([]), None);
    }
}
