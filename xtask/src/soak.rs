//! `cargo xtask soak [CHOICES] [LIGHT_SAMPLES] [SEED]`: very many samples, each held against the
//! query for its probability or density.

use crate::steps::{Outcome, StepResult, cargo, run};

/// Runs the example of `light-testkit` that does it.
///
/// # Errors
/// The command line, when a sample broke a promise or an argument is no number.
pub fn soak(arguments: &[String]) -> StepResult {
    let mut command = cargo(["run", "--quiet", "--release", "--package", "light-testkit"]);
    command.args(["--features", "soak", "--example", "soak", "--"]);
    run(command.args(arguments))?;
    Ok(Outcome::Passed)
}
