//! Every law against the exact bridge, each exact bridge solved once.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use pendular_capillary::young_laplace::{ExactBridge, SolveError};
use pendular_capillary::{AnyCapillary, Bridge, CapillaryLaw, ForceCurve, Range};

use super::ChartError;
use super::grid::{GAPS, Pair, pairs};
use crate::rupture::RuptureChoice;
use crate::transfer::Method;

/// Number of capillary laws.
pub(crate) const LAWS: usize = AnyCapillary::ALL.len();
/// The rupture laws that are held against the exact end: all but the exact one itself.
pub(crate) const RUPTURES: usize = RuptureChoice::COUNT - 1;
/// The transfer methods that are held against the exact share.
pub(crate) const METHODS: [Method; 2] = [Method::Parabola, Method::Tabulated];

/// One exact bridge and what the laws make of it.
pub(crate) struct Sample {
    pub(crate) pair: Pair,
    /// Place of V* on the pair's axis of volumes.
    pub(crate) place: usize,
    pub(crate) bridge: Bridge,
    /// Relative error of each law's force at each gap; `None` where the law has no value.
    pub(crate) force: [Option<[f64; GAPS.len()]>; LAWS],
    /// Relative, signed error of each rupture law.
    pub(crate) rupture: [Option<f64>; RUPTURES],
    /// Signed error of each transfer method's share.
    pub(crate) share: [Option<f64>; METHODS.len()],
}

/// Measures the whole grid on all cores.
pub(crate) fn measure() -> Result<Vec<Sample>, ChartError> {
    let pairs = pairs();
    let (next, found) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    let work = || -> Result<(), ChartError> {
        // The volumes of one pair stay on one thread: the table solves each pair once.
        while let Some(pair) = pairs.get(next.fetch_add(1, Ordering::Relaxed)) {
            let samples = of_pair(pair)?;
            found.lock().map_err(|_| ChartError::Thread)?.extend(samples);
        }
        Ok(())
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        workers.into_iter().try_for_each(|w| w.join().map_err(|_| ChartError::Thread)?)
    })?;
    let mut samples: Vec<Sample> = found.into_inner().map_err(|_| ChartError::Thread)?;
    let order = |s: &Sample| (!s.pair.equal, s.pair.ratio.to_bits(), s.pair.places, s.place);
    samples.sort_by_key(order);
    Ok(samples)
}

pub(crate) fn of_pair(pair: &Pair) -> Result<Vec<Sample>, ChartError> {
    let volumes = pair.volumes().into_iter().enumerate();
    let sample = |(place, v_star)| {
        let bridge = pair.bridge(v_star)?;
        match ExactBridge::new(&bridge) {
            Ok(exact) => of_bridge(pair, place, &exact).map(Some),
            // No bridge, nothing to measure.
            Err(SolveError::NoStableBridge { .. }) => Ok(None),
            Err(error) => Err(error.into()),
        }
    };
    volumes.filter_map(|at| sample(at).transpose()).collect()
}

fn of_bridge(pair: &Pair, place: usize, exact: &ExactBridge) -> Result<Sample, ChartError> {
    let (bridge, end) = (*exact.bridge(), exact.rupture());
    let mut forces = [0.0; GAPS.len()];
    for (force, share) in forces.iter_mut().zip(GAPS) {
        *force = exact.force(share * end.distance)?;
    }
    let errors = |law: AnyCapillary| {
        let curve = law.curve(&bridge, Range::Extrapolate).ok()?;
        let mut errors = [0.0; GAPS.len()];
        for ((error, share), force) in errors.iter_mut().zip(GAPS).zip(forces) {
            *error = (curve.force(share * end.distance) / force - 1.0).abs();
        }
        Some(errors)
    };
    let rupture = RuptureChoice::all().map(|law| law.distance(&bridge, false).ok());
    let mut ruptures = [None; RUPTURES];
    for (error, answer) in ruptures.iter_mut().zip(rupture) {
        *error = answer.map(|(distance, _)| distance / end.distance - 1.0);
    }
    let share = METHODS.map(|m| m.share(&bridge, false).ok().map(|(share, _)| share - end.share));
    let force = AnyCapillary::ALL.map(errors);
    Ok(Sample { pair: *pair, place, bridge, force, rupture: ruptures, share })
}
