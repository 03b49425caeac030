use alloc::vec::Vec;

#[cfg(feature = "rayon")]
use rayon::iter::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};

/// Runs both, on two threads with the feature `rayon` if `work`, a number of lights, is large
/// enough.
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

/// Runs both, `there` on another thread with the feature `rayon`.
#[cfg(all(feature = "std", feature = "bytemuck"))]
pub(crate) fn overlap<T>(there: impl FnOnce() + Send, here: impl FnOnce() -> T) -> T {
    #[cfg(feature = "rayon")]
    return rayon::in_place_scope(|scope| {
        scope.spawn(|_| there());
        here()
    });
    #[cfg(not(feature = "rayon"))]
    {
        there();
        here()
    }
}

/// Whether work on so many lights takes longer than waking another thread.
pub(crate) const fn is_worth_a_thread(work: usize) -> bool {
    work >= 2048
}

/// The results of `each` for all `jobs`, in their order, on all threads with the feature `rayon`.
pub(crate) fn map<J: Send, T: Send>(jobs: Vec<J>, each: impl Fn(J) -> T + Send + Sync) -> Vec<T> {
    #[cfg(feature = "rayon")]
    return jobs.into_par_iter().map(each).collect();
    #[cfg(not(feature = "rayon"))]
    jobs.into_iter().map(each).collect()
}

/// The results of `each` for all numbers below `count`, in their order, on all threads with the
/// feature `rayon`.
pub(crate) fn table<T: Send>(count: usize, each: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    /// Fewer are done before another thread wakes.
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
