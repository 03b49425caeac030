//! What is measured of marches in one medium.

use light_media::AnyMedium;
use light_sources::Rgb;

use super::convergence::{MarchError, march_errors, slope, tracked, truth};

/// The errors of marches in a medium, and of trackers there.
pub(super) struct MediumFigures {
    pub(super) name: &'static str,
    pub(super) errors: Vec<MarchError>,
    /// Slopes of the logarithms of the errors against that of the step.
    pub(super) rms_slope: f64,
    pub(super) bias_slope: f64,
    /// Distance of the trackers' mean from the truth, and its standard error.
    pub(super) tracked_off: f64,
    pub(super) tracked_error: f64,
}

impl MediumFigures {
    pub(super) fn measure(name: &'static str, medium: &AnyMedium<Rgb>) -> Self {
        let errors = march_errors(medium);
        // Long steps do not follow the straight line yet.
        let fine = &errors[2..];
        let tracked = tracked(medium);
        Self {
            name,
            rms_slope: slope(fine.iter().map(|e| (e.step, e.rms))),
            bias_slope: slope(fine.iter().map(|e| (e.step, e.bias))),
            tracked_off: (tracked.mean - truth(medium)).abs(),
            tracked_error: tracked.standard_error,
            errors,
        }
    }
}
