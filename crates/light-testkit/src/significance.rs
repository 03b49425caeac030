//! The level of all statistical tests, derived from one number.

use core::sync::atomic::{AtomicU32, Ordering};

/// The chance that any statistical test of the workspace fails although all of its code is right.
///
/// Seeds are fixed, so a test that passes once passes forever; the level says how surprising a
/// result has to be before it counts as a fault.
pub const FAMILY_ERROR: f64 = 1e-3;

/// The most test programs (one for the unit tests of a crate, one for its integration tests) that
/// take statistical tests. A test of this crate counts them.
pub const PROGRAMS: u32 = 18;

/// The most single tests (one chi-squared, one Kolmogorov-Smirnov, one mean) that a program takes:
/// more of them panic.
pub const TESTS_PER_PROGRAM: u32 = 1 << 16;

/// The chance that one single test fails although the code is right: [`FAMILY_ERROR`] divided
/// evenly (Bonferroni).
pub const SIGNIFICANCE: f64 = FAMILY_ERROR / (PROGRAMS as f64 * TESTS_PER_PROGRAM as f64);

static TAKEN: AtomicU32 = AtomicU32::new(0);

/// Counts one single test of this program.
pub(crate) fn take() {
    let taken = TAKEN.fetch_add(1, Ordering::Relaxed) + 1;
    assert!(
        taken <= TESTS_PER_PROGRAM,
        "more than {TESTS_PER_PROGRAM} statistical tests in one program: raise TESTS_PER_PROGRAM, \
         which lowers the level"
    );
}

/// How many single tests this program has taken so far.
#[must_use]
pub fn tests_taken() -> u32 {
    TAKEN.load(Ordering::Relaxed)
}
