use alloc::vec::Vec;

#[cfg(feature = "rayon")]
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};

/// Runs both, on two threads where the feature `rayon` allows it and `work` is worth it.
pub(crate) fn join<A: Send, B: Send>(
    work: usize,
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    #[cfg(feature = "rayon")]
    if is_worth_a_thread(work) {
        return rayon::join(a, b);
    }
    let _ = work;
    (a(), b())
}

/// Whether work on so many lights is not done before another thread has woken up.
pub(crate) const fn is_worth_a_thread(work: usize) -> bool {
    work >= 2048
}

/// What `each` makes of every one of `jobs`, in their order, on all threads that the feature `rayon` allows.
pub(crate) fn map<J: Send, T: Send>(jobs: Vec<J>, each: impl Fn(J) -> T + Send + Sync) -> Vec<T> {
    #[cfg(feature = "rayon")]
    return jobs.into_par_iter().map(each).collect();
    #[cfg(not(feature = "rayon"))]
    jobs.into_iter().map(each).collect()
}

/// What `each` makes of every number below `count`, in their order, on all threads that the feature `rayon` allows.
pub(crate) fn table<T: Send>(count: usize, each: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    /// Fewer are made before another thread has woken up.
    #[cfg(feature = "rayon")]
    const WORTH_A_THREAD: usize = 4096;

    #[cfg(feature = "rayon")]
    return (0..count)
        .into_par_iter()
        .with_min_len(WORTH_A_THREAD)
        .map(each)
        .collect();
    #[cfg(not(feature = "rayon"))]
    (0..count).map(each).collect()
}
