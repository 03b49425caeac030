//! Commands that are programs of other packages: what they write and their exit status are the
//! command's.

use std::process::ExitCode;

use crate::steps::cargo;

/// `cargo xtask conformance [--self-test] [DIR]`: the program of `light-conformance`.
#[must_use]
pub fn conformance(arguments: &[String]) -> ExitCode {
    program(&["--package", "light-conformance"], arguments)
}

/// `cargo xtask exhaustive`: the check of all octahedral codes.
#[must_use]
pub fn exhaustive(arguments: &[String]) -> ExitCode {
    let package = ["--release", "--package", "light-testkit"];
    let example = ["--features", "soak", "--example", "exhaustive"];
    program(&[&package[..], &example].concat(), arguments)
}

/// `cargo xtask uplift-table`: the program that makes the table that `light-math` ships.
#[must_use]
pub fn uplift_table() -> ExitCode {
    program(&["--package", "light-math", "--example", "uplift_table"], &[])
}

/// Builds and runs the program that `selection` names to cargo.
fn program(selection: &[&str], arguments: &[String]) -> ExitCode {
    let mut command = cargo(["run", "--quiet"]);
    command.args(selection).arg("--").args(arguments);
    match command.status() {
        // A program that was killed has no code.
        Ok(status) => ExitCode::from(status.code().map_or(1, |code| code as u8)),
        Err(error) => {
            eprintln!("cargo: {error}");
            ExitCode::FAILURE
        }
    }
}
