//! What a law costs, in nanoseconds, measured through [`AnyCapillary`] as a scene would call it.

use std::hint::black_box;
use std::time::{Duration, Instant};

use pendular_capillary::{AnyCapillary, AnyCurve, Bridge, CapillaryLaw, ForceCurve, Mate, Range};

/// Nanoseconds per call.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cost {
    /// `force(gap)` on a curve that is made.
    pub(crate) force: f64,
    /// Making a curve, for bodies of known kinds.
    pub(crate) curve: f64,
    /// Making the first curve for a pair of angles that was never seen.
    pub(crate) first: f64,
    /// Curve and force in one.
    pub(crate) one_shot: f64,
}

/// Repetitions in a round, of which the fastest counts: the others were disturbed.
const TRIES: usize = 8;
/// Rounds over all laws, apart in time, so that one disturbance does not meet all of a law's tries.
const ROUNDS: u32 = 5;
/// A repetition lasts at least this long.
const SPAN: Duration = Duration::from_millis(2);

impl Cost {
    /// The smaller of each: time is only ever added by what disturbs.
    fn least(self, other: Self) -> Self {
        Self {
            force: self.force.min(other.force),
            curve: self.curve.min(other.curve),
            first: self.first.min(other.first),
            one_shot: self.one_shot.min(other.one_shot),
        }
    }
}

/// Costs of every law; `None` for one that has no value anywhere.
pub(crate) fn measure() -> [Option<Cost>; AnyCapillary::ALL.len()] {
    let mut best = [None; AnyCapillary::ALL.len()];
    for round in 0..ROUNDS {
        for (best, law) in best.iter_mut().zip(AnyCapillary::ALL) {
            let now = of_law(law, round);
            *best = match (*best, now) {
                (Some(cost), Some(now)) => Some(Cost::least(cost, now)),
                (before, now) => before.or(now),
            };
        }
    }
    best
}

/// Measures a law on the examples of the exact law that it has a value for.
fn of_law(law: AnyCapillary, round: u32) -> Option<Cost> {
    let has_value = |bridge: &Bridge| law.curve(bridge, Range::Extrapolate).is_ok();
    let mut bridges = AnyCapillary::YoungLaplace.examples();
    bridges.retain(has_value);
    let calls: Vec<(Bridge, f64)> =
        bridges.iter().flat_map(|bridge| gaps(bridge).map(|gap| (*bridge, gap))).collect();
    let curves: Vec<(AnyCurve, f64)> = calls
        .iter()
        .filter_map(|(bridge, gap)| Some((law.curve(bridge, Range::Extrapolate).ok()?, *gap)))
        .collect();
    if curves.is_empty() {
        return None;
    }
    let force = || black_box(&curves).iter().map(|(curve, gap)| curve.force(*gap)).sum::<f64>();
    let curve = || {
        for bridge in black_box(&bridges) {
            let _ = black_box(law.curve(bridge, Range::Extrapolate));
        }
        0.0
    };
    let one_shot = || {
        let answer = |(b, gap): &(Bridge, f64)| law.force(b, *gap, Range::Extrapolate).ok();
        black_box(&calls).iter().filter_map(answer).sum::<f64>()
    };
    Some(Cost {
        force: fastest(force) / curves.len() as f64,
        curve: fastest(curve) / bridges.len() as f64,
        first: first(law, &bridges, round),
        one_shot: fastest(one_shot) / calls.len() as f64,
    })
}

/// Gaps of a bridge from contact to about its rupture (Lian's ∛V).
fn gaps(bridge: &Bridge) -> [f64; 8] {
    [0.0, 0.03, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9].map(|share| share * bridge.volume().cbrt())
}

/// Nanoseconds of the fastest of many calls.
fn fastest(work: impl Fn() -> f64) -> f64 {
    let once = Instant::now();
    black_box(work());
    let repeats = (SPAN.as_nanos() / once.elapsed().as_nanos().max(1)).clamp(1, 100_000) as u32;
    let mut best = f64::INFINITY;
    for _ in 0..TRIES {
        let start = Instant::now();
        for _ in 0..repeats {
            black_box(work());
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(repeats));
    }
    best
}

/// Median time of curves for pairs of angles that come up for the first time.
fn first(law: AnyCapillary, bridges: &[Bridge], round: u32) -> f64 {
    let on_plane = bridges.iter().all(|bridge| bridge.mate().is_wall());
    let mate = if on_plane { Mate::PLANE } else { Mate::Sphere { radius: 1.5e-3 } };
    let mut times: Vec<f64> = (0..15)
        .filter_map(|k| {
            // Angles that no other bridge of this program has.
            let step = f64::from(15 * round + k);
            let angles = [11.0 + 0.0137 * step, 23.0 - 0.0211 * step];
            let bridge = Bridge::new(1e-3, mate, 2e-11, angles.map(f64::to_radians), 0.07).ok()?;
            let start = Instant::now();
            let _ = black_box(law.curve(&bridge, Range::Extrapolate));
            Some(start.elapsed().as_secs_f64() * 1e9)
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(f64::NAN)
}
