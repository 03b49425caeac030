/// Runs both, on two threads where the feature `rayon` allows it and `is_worth_it`.
pub(crate) fn join<A: Send, B: Send>(
    work: usize,
    a: impl FnOnce() -> A + Send,
    b: impl FnOnce() -> B + Send,
) -> (A, B) {
    /// Less work than this many lights is done before another thread has woken up.
    #[cfg(feature = "rayon")]
    const WORTH_A_THREAD: usize = 2048;

    #[cfg(feature = "rayon")]
    if work >= WORTH_A_THREAD {
        return rayon::join(a, b);
    }
    let _ = work;
    (a(), b())
}
