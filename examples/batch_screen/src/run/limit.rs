//! When a run looks at the stability limit of its packing.

/// Steps between looks, at least: one takes as long as some 400 steps do on one thread.
const EVERY: u64 = 32_768;

/// Whether a row at a step looks at the stability limit: the first and the last one do, and the
/// first one after every so many steps. It depends on the steps alone, so that a run that is taken up
/// again looks when the whole one does.
pub(super) fn is_due(step: u64, before: Option<u64>, last: u64) -> bool {
    step >= last || before.is_none_or(|before| before / EVERY < step / EVERY)
}

#[cfg(test)]
mod tests {
    use super::super::row_at;
    use super::*;

    #[test]
    fn the_limit_is_looked_at_first_and_last_and_now_and_then() {
        let looks = |interval: f64, last: u64| -> Vec<u64> {
            let rows = (0..).map(|k| row_at(k, interval, 1e-6)).take_while(|&step| step < last);
            let rows: Vec<u64> = rows.chain([last]).collect();
            let before = |k: usize| k.checked_sub(1).map(|k| rows[k]);
            let due = |k: &usize| is_due(rows[*k], before(*k), last);
            (0..rows.len()).filter(due).map(|k| rows[k]).collect()
        };
        // Rows closer than looks: at the first row from every multiple of 32768 on.
        assert_eq!(looks(10e-3, 100_000), [0, 40_000, 70_000, 100_000]);
        // Rows farther apart: at each of them.
        assert_eq!(looks(40e-3, 100_000), [0, 40_000, 80_000, 100_000]);
        // Many rows cost no more looks.
        assert_eq!(looks(1e-6, 70_000), [0, 32_768, 65_536, 70_000]);
    }
}
