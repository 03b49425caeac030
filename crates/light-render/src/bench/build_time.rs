use std::time::Instant;

use super::repetition::TIME_PER_MEASUREMENT;

/// Milliseconds of the fastest of several builds, and what was built.
pub(super) fn build_time<T>(make: impl FnMut() -> T) -> (f64, T) {
    let (begin, mut make) = (Instant::now(), make);
    let mut best = f64::INFINITY;
    loop {
        let start = Instant::now();
        let built = make();
        best = best.min(start.elapsed().as_secs_f64() * 1e3);
        if begin.elapsed() > TIME_PER_MEASUREMENT {
            return (best, built);
        }
    }
}
