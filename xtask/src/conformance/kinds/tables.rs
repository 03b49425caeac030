//! What the tables have in common.

use crate::conformance::{Findings, Rule, Tolerance};
use lights::math::distribution::{SummedAreaTable, TableError, Window};
use lights::math::glam::Vec2;

/// A table of zeros.
pub(super) const ALL_ZERO: Rule = Rule {
    name: "all_zero",
    reason: "the reference samples a table of zeros evenly with density 0; ours is refused when built",
};

/// The reference adds up to 24 numbers in single precision, ours adds in double.
pub(super) const RUNNING_SUM: Tolerance = Tolerance::new(1e-5, 2e-6);

/// A sample where the last bits of the running sum decide.
pub(super) struct Perturbation {
    /// How far u is moved.
    pub(super) ulps: f32,
    pub(super) rule: Rule,
}

/// Moving u by four units in the last place of the running sum.
pub(super) const U_ROUNDING: Perturbation = Perturbation {
    ulps: 4.0 * f32::EPSILON,
    rule: Rule {
        name: "u_rounding",
        reason: "u lies on the edge of a bin, or in a bin as narrow as a rounding of the running sum: \
                 the answers for u moved by 4 ulps enclose the reference",
    },
};

/// The reference takes absolute values; we refuse negative weights.
pub(super) fn refuses_signs(
    func: &[f32],
    build: impl Fn(&[f32]) -> Result<(), TableError>,
    findings: &mut Findings,
) {
    if let Some(index) = func.iter().position(|&f| f < 0.0) {
        findings.equal(
            "negative weight",
            build(func),
            Err(TableError::Negative { index }),
        );
    }
}

/// Small differences of large sums.
pub(super) const CANCELLATION: Rule = Rule {
    name: "cancellation",
    reason: "the reference rounds the sums up to the window's four corners to single precision before it subtracts \
             them; ours counts in whole numbers. The difference is within a few roundings of the largest of the four",
};

/// What these roundings may add to an integral over a window with upper corner `max`.
pub(super) fn cancellation(table: &SummedAreaTable<Vec<u64>>, max: Vec2) -> f32 {
    8.0 * f32::EPSILON * table.integral(&Window::new(Vec2::ZERO, max))
}
