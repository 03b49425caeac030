//! What all benches are measured with.

use std::time::Duration;

use criterion::Criterion;

/// Criterion with short measuring times: the whole suite runs in a few minutes.
pub(crate) fn criterion() -> Criterion {
    Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_millis(1200))
        .sample_size(30)
        .configure_from_args()
}
