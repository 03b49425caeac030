use core::time::Duration;

/// How long builds and queries of one sampler are repeated for the fastest. Nobody compares the
/// times of a debug build, as that of tests: a few repetitions do.
pub(super) const TIME_PER_MEASUREMENT: Duration =
    Duration::from_millis(if cfg!(debug_assertions) { 20 } else { 600 });
