//! Chunks on several threads.

use std::sync::Arc;
use std::sync::atomic::Ordering::{AcqRel, Acquire, Release};
use std::sync::atomic::{AtomicBool, AtomicUsize};

use rayon::prelude::*;
use rayon::{ThreadPool, Yield};

use crate::SimulationError;
use crate::chunk::Chunk;

/// The most threads of a simulation. Where a system runs out of memory for threads the program ends
/// at once; more than this is taken for a mistake.
pub const MOST_THREADS: usize = 1024;

/// A pool of threads; none where one is enough.
pub(super) fn pool(threads: usize) -> Result<Option<Arc<ThreadPool>>, SimulationError> {
    let failed = |reason: String| SimulationError::Threads { threads, reason };
    if !(1..=MOST_THREADS).contains(&threads) {
        return Err(failed(format!("allowed: 1 to {MOST_THREADS}")));
    }
    if threads == 1 {
        return Ok(None);
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map(|pool| Some(Arc::new(pool))).map_err(|e| failed(e.to_string()))
}

/// Does work on one thread of a pool while so many others stay awake to take part in it.
///
/// Between two parts of a step they have nothing to do for some microseconds. To go to sleep and to
/// be woken takes longer. Where they share cores with others they let those go first.
pub(super) fn attended<R: Send>(
    pool: &ThreadPool,
    others: usize,
    work: impl FnOnce() -> R + Send,
) -> R {
    let others = others.min(pool.current_num_threads() - 1);
    let (there, end) = (AtomicUsize::new(0), AtomicBool::new(false));
    let attend = |leader: Option<usize>| {
        if rayon::current_thread_index() == leader || there.fetch_add(1, AcqRel) >= others {
            return;
        }
        while !end.load(Acquire) {
            if rayon::yield_now() != Some(Yield::Executed) {
                std::thread::yield_now();
            }
        }
    };
    pool.install(|| {
        let leader = rayon::current_thread_index();
        rayon::scope(|scope| {
            scope.spawn_broadcast(|_, _| attend(leader));
            // However the work ends, they need not wait any more.
            let _end = SetAtEnd(&end);
            // One that found a part of the work first would attend later, within that part, while the
            // work waits for it.
            while there.load(Acquire) + 1 < pool.current_num_threads() {
                std::thread::yield_now();
            }
            work()
        })
    })
}

/// Sets a flag when it is dropped.
struct SetAtEnd<'a>(&'a AtomicBool);

impl Drop for SetAtEnd<'_> {
    fn drop(&mut self) {
        self.0.store(true, Release);
    }
}

/// Whether it pays to hand chunks to threads.
pub(super) fn parallel(chunks: usize, threads: usize) -> bool {
    chunks > 1 && threads > 1 && rayon::current_num_threads() > 1
}

/// Runs over all chunks, on several threads where that pays.
pub(super) fn each<C: Send>(
    chunks: &mut [Chunk<C>],
    threads: usize,
    one: impl Fn(&mut Chunk<C>) + Sync + Send,
) {
    if parallel(chunks.len(), threads) {
        chunks.par_iter_mut().with_max_len(1).for_each(one);
    } else {
        chunks.iter_mut().for_each(one);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, Instant};

    #[test]
    fn others_take_part_and_go_when_the_work_ends() {
        let pool = pool(3).unwrap().unwrap();
        let (there, start) = (AtomicUsize::new(0), Instant::now());
        // Each part waits for the two others: one thread alone would see one.
        let part = |_| {
            there.fetch_add(1, AcqRel);
            while there.load(Acquire) < 3 && start.elapsed() < Duration::from_secs(60) {
                std::thread::yield_now();
            }
            there.load(Acquire)
        };
        let work = || (0..3_u32).into_par_iter().with_max_len(1).map(part).min();
        assert_eq!(attended(&pool, 2, work), Some(3));
        let failed = attended(&pool, 2, || Err::<(), _>("no more"));
        assert_eq!(failed, Err("no more"));
        let panics = std::panic::AssertUnwindSafe(|| attended(&pool, 2, || panic!("no more")));
        assert!(std::panic::catch_unwind(panics).is_err());
        assert_eq!(attended(&pool, 1, || 1), 1);
    }

    /// They must all be there before the work begins: this stood still after some thousand times.
    #[test]
    fn short_work_again_and_again_does_not_stand_still() {
        let pool = pool(8).unwrap().unwrap();
        let start = Instant::now();
        let mut times = 0_u32;
        while times < 50_000 && start.elapsed() < Duration::from_secs(2) {
            let work = || (0..8_u32).into_par_iter().with_max_len(1).sum::<u32>();
            assert_eq!(attended(&pool, 7, work), 28);
            times += 1;
        }
        assert!(times > 0);
    }
}
