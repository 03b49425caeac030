//! Times of things that take turns.

use std::fs;
use std::time::Instant;

/// Counts the seconds that this thread runs, where the system reports them (Linux); wall-clock time
/// elsewhere. Other threads may end meanwhile, which a count of all threads does not survive.
#[derive(Clone, Copy, Debug)]
pub struct ThreadTimer {
    start: Instant,
    before: Option<f64>,
}

impl ThreadTimer {
    /// Starts now.
    #[must_use]
    pub fn start() -> Self {
        Self {
            start: Instant::now(),
            before: thread_seconds(),
        }
    }

    /// Seconds since the start, to a few milliseconds.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        match (self.before, thread_seconds()) {
            (Some(before), Some(now)) => now - before,
            _ => self.start.elapsed().as_secs_f64(),
        }
    }
}

fn thread_seconds() -> Option<f64> {
    let line = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    let nanoseconds: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(nanoseconds * 1e-9)
}

/// The middle of an odd number of values, the higher one of the two in the middle otherwise; `None`
/// without values.
#[must_use]
pub fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.get(sorted.len() / 2).copied()
}

/// Seconds of processor time that one call takes: calls are repeated, twice as often each time,
/// until they take at least `window` seconds together.
pub fn seconds_a_call(window: f64, mut call: impl FnMut()) -> f64 {
    let mut calls = 1_u32;
    loop {
        let timer = ThreadTimer::start();
        (0..calls).for_each(|_| call());
        let seconds = timer.seconds();
        if seconds >= window || calls > 1 << 30 {
            return seconds / f64::from(calls);
        }
        calls *= 2;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians_lie_in_the_middle() {
        assert_eq!(median(&[]), None, "nothing");
        assert_eq!(median(&[3.0, 1.0, 2.0]), Some(2.0), "the second of three");
        assert_eq!(median(&[9.0, 1.0]), Some(9.0), "the higher of two");
    }
}
