//! Marches converge to the truth, and to what trackers say, with the slopes that theory gives.

use crate::support::convergence::{march_errors, media, slope, tracked, truth};

#[test]
fn the_error_of_a_march_falls_with_its_step_and_its_bias_with_the_square() {
    for (name, medium) in media() {
        let errors = march_errors(&medium);
        // The coarsest steps are not yet on the line.
        let fine = &errors[2..];
        let rms = slope(fine.iter().map(|e| (e.step, e.rms)));
        let bias = slope(fine.iter().map(|e| (e.step, e.bias)));
        assert!((rms - 1.0).abs() < 0.1, "{name}: slope {rms} of the error");
        assert!((bias - 2.0).abs() < 0.2, "{name}: slope {bias} of the bias");
    }
}

#[test]
fn trackers_have_no_bias() {
    for (name, medium) in media() {
        let (mean, truth) = (tracked(&medium), truth(&medium));
        assert!(mean.agrees_with(truth), "{name}: {mean:?}, {truth}");
    }
}
