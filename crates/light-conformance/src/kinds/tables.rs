//! What the tables have in common.

use crate::fault_injection::Answer;
use crate::oracle::table::ExactTable;
use crate::oracle::{Certainty, ExactWindows, Jitter};
use crate::{Case, Findings, Malformed, Rule, Tolerance};
use core::fmt::Display;
use glam::DVec2;
use lights::math::distribution::{TableError, Window};

/// A table of zeros.
const ALL_ZERO: Rule = Rule {
    name: "all_zero",
    reason: "the reference samples a table of zeros evenly with density 0; ours is refused when \
             built",
};

/// The reference adds up to 24 numbers in single precision, ours adds in double.
pub(super) const RUNNING_SUM: Tolerance = Tolerance::new(1e-5, 2e-6);

pub(super) const U_ROUNDING: Rule = Rule {
    name: "u_rounding",
    reason: "u or the point lies on the edge of a bin, or in a bin as narrow as a rounding of the \
             running sum; ours is an answer in double precision for u moved by roundings",
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

/// The table that was built; none, with the reason noted, if all weights are 0.
pub(super) fn unless_zero<T>(
    built: Result<T, TableError>,
    weights: &[f32],
    findings: &mut Findings,
) -> Result<Option<T>, Malformed> {
    match built {
        Ok(table) => Ok(Some(table)),
        Err(TableError::AllZero) if weights.iter().all(|&w| w == 0.0) => {
            findings.exempt(&ALL_ZERO);
            Ok(None)
        }
        Err(error) => Err(Malformed(error.to_string())),
    }
}

/// Compares the integral of a table with the reference's.
pub(super) fn check_integral(
    ours: f32,
    case: &Case<'_>,
    findings: &mut Findings,
) -> Result<(), Malformed> {
    let ours = findings.ours("integral", ours);
    let theirs = case.get("integral")?.float()?;
    findings.near("integral", ours, theirs, Tolerance::GENERAL);
    findings.settled(Certainty::Determined);
    Ok(())
}

/// Small differences of large sums.
pub(super) const CANCELLATION: Rule = Rule {
    name: "cancellation",
    reason: "the reference rounds the sums up to the window's four corners to single precision \
             before it subtracts them; ours is the answer in double precision",
};

/// The oracle of a table.
pub(super) fn windows(func: &[f32], nx: usize, ny: usize) -> ExactWindows {
    ExactWindows(table(func, nx, ny))
}

/// The same without windows; signs do not count.
pub(super) fn table(func: &[f32], nx: usize, ny: usize) -> ExactTable {
    ExactTable {
        nx,
        ny,
        weights: func.iter().map(|&f| f64::from(f.abs())).collect(),
    }
}

/// The corners of a window, moved by roundings.
pub(super) fn moved_window(window: &Window, jitter: &mut Jitter) -> [DVec2; 2] {
    [window.min, window.max].map(|p| p.as_dvec2().map(|x| jitter.relative(x)))
}

/// Compares the random number that leads to `place` with the reference's, by `near`; a reference
/// without one reads null.
pub(super) fn check_inverse<'a, T: Answer>(
    place: impl Display,
    ours: Option<T>,
    theirs: &Case<'a>,
    read: impl Fn(&Case<'a>) -> Result<T, Malformed>,
    near: impl Fn(&mut Findings, &str, T, T, Tolerance),
    findings: &mut Findings,
) -> Result<(), Malformed> {
    match findings.ours_if_any("inverse", ours) {
        None => findings.check(theirs.is_null(), || format!("invert({place}): none")),
        Some(ours) => {
            let ours = findings.ours("inverse u", ours);
            near(findings, "invert", ours, read(theirs)?, RUNNING_SUM);
        }
    }
    findings.settled(Certainty::Determined);
    Ok(())
}
