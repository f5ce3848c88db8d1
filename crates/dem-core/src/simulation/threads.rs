//! Chunks on several threads.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;
use rayon::{ThreadPool, Yield};

use crate::SimulationError;
use crate::chunk::Chunk;

/// A pool of threads; none where one is enough.
pub(super) fn pool(threads: usize) -> Result<Option<ThreadPool>, SimulationError> {
    if threads <= 1 {
        return Ok(None);
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let failed = |e: rayon::ThreadPoolBuildError| SimulationError::Threads {
        threads,
        reason: e.to_string(),
    };
    pool.map(Some).map_err(failed)
}

/// Does work on one thread of a pool while the others stay awake to take part in it.
///
/// Between two parts of a step they have nothing to do for some microseconds. To go to sleep and to
/// be woken takes longer. Where they share cores with others they let those go first.
pub(super) fn attended<R: Send>(pool: &ThreadPool, work: impl FnOnce() -> R + Send) -> R {
    let attend = |leader: usize, end: &AtomicBool| {
        while rayon::current_thread_index() != Some(leader) && !end.load(Ordering::Acquire) {
            if rayon::yield_now() != Some(Yield::Executed) {
                std::thread::yield_now();
            }
        }
    };
    pool.install(|| {
        let leader = rayon::current_thread_index().unwrap_or(0);
        let end = AtomicBool::new(false);
        rayon::scope(|scope| {
            scope.spawn_broadcast(|_, _| attend(leader, &end));
            // However the work ends, they need not wait any more.
            let _end = SetAtEnd(&end);
            work()
        })
    })
}

/// Sets a flag when it is dropped.
struct SetAtEnd<'a>(&'a AtomicBool);

impl Drop for SetAtEnd<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

/// Whether it pays to hand chunks to threads.
pub(super) fn parallel(chunks: usize, threads: usize) -> bool {
    chunks > 1 && threads > 1 && rayon::current_num_threads() > 1
}

/// Runs over all chunks, in parallel inside a pool of more than one thread.
pub(super) fn each<C: Send>(chunks: &mut [Chunk<C>], one: impl Fn(&mut Chunk<C>) + Sync + Send) {
    if chunks.len() > 1 && rayon::current_thread_index().is_some() {
        chunks.par_iter_mut().with_max_len(1).for_each(one);
    } else {
        chunks.iter_mut().for_each(one);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn others_take_part_and_go_when_the_work_ends() {
        let pool = pool(3).unwrap().unwrap();
        let sum = attended(&pool, || (0..10_000_u32).into_par_iter().with_max_len(1).sum::<u32>());
        assert_eq!(sum, 49_995_000);
        let failed = attended(&pool, || Err::<(), _>("no more"));
        assert_eq!(failed, Err("no more"));
        let panics = std::panic::AssertUnwindSafe(|| attended(&pool, || panic!("no more")));
        let panicked = std::panic::catch_unwind(panics);
        assert!(panicked.is_err());
        assert_eq!(attended(&pool, || 1), 1);
    }
}
