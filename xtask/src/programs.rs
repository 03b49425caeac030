//! Commands that are programs of other packages.

use std::process::{Command, ExitCode};

use crate::steps::{Outcome, StepResult, cargo, run};

/// `cargo xtask conformance [--self-test] [DIR]`: the program of `light-conformance`.
#[must_use]
pub fn conformance(arguments: &[String]) -> ExitCode {
    same_exit(program(&["--package", "light-conformance"], arguments))
}

/// `cargo xtask exhaustive`: the check of all octahedral codes.
#[must_use]
pub fn exhaustive(arguments: &[String]) -> ExitCode {
    let package = ["--release", "--package", "light-testkit"];
    let example = ["--features", "soak", "--example", "exhaustive"];
    same_exit(program(&[&package[..], &example].concat(), arguments))
}

/// `cargo xtask uplift-table`: the program that makes the table that `light-math` ships.
#[must_use]
pub fn uplift_table() -> ExitCode {
    same_exit(program(
        &["--package", "light-math", "--example", "uplift_table"],
        &[],
    ))
}

/// `cargo xtask soak [CHOICES] [LIGHT_SAMPLES] [SEED]`: very many samples, each held against the
/// query for its probability or density.
///
/// # Errors
/// The command line, when a sample broke a promise or an argument is no number.
pub fn soak(arguments: &[String]) -> StepResult {
    let package = ["--release", "--package", "light-testkit"];
    let example = ["--features", "soak", "--example", "soak"];
    step(program(&[&package[..], &example].concat(), arguments))
}

/// `cargo xtask brute-force [SEEDS] [FIRST SEED] [KIND]`: very many lights, each compared with
/// quadrature of its description.
///
/// # Errors
/// The command line, when a light differs or an argument is no number.
pub fn brute_force(arguments: &[String]) -> StepResult {
    let package = ["--release", "--package", "light-testkit"];
    let example = ["--features", "sources", "--example", "brute_force"];
    step(program(&[&package[..], &example].concat(), arguments))
}

/// `cargo xtask march-convergence`: measures how marches through media converge, and draws it.
///
/// # Errors
/// The command line, when the drawing cannot be written.
pub fn march_convergence() -> StepResult {
    let package = ["--release", "--package", "light-media"];
    let example = ["--example", "march_convergence"];
    step(program(&[&package[..], &example].concat(), &[]))
}

/// `cargo xtask median-cut-table [IMAGE...]`: measures median-cut lights on the sky that ships and
/// on the given lat-long images, for `docs/light-sources.md`.
///
/// # Errors
/// The command line, when an image cannot be read or the page not be written.
pub fn median_cut_table(images: &[String]) -> StepResult {
    let images = images.iter().map(|path| {
        let path = std::path::absolute(path).map_err(|error| format!("{path}: {error}"))?;
        Ok(path.to_string_lossy().into_owned())
    });
    let images = images.collect::<Result<Vec<_>, String>>()?;
    step(bench_example("median_cut_table", &images))
}

/// `cargo xtask bench --table [TABLE...]`: measures light hierarchies for `docs/light-bvh.md`.
///
/// # Errors
/// The command line, when a name is none, a law is broken, or the page cannot be written.
pub fn bench_tables(names: &[String]) -> StepResult {
    step(bench_example("bench_tables", names))
}

/// `cargo xtask scaling [--quick | LIGHTS | placed | workers]`: measures how costs grow with the
/// lights, for `docs/light-bvh.md`, and with the workers of a farm, for `docs/farm.md`.
///
/// # Errors
/// The command line, when the lights do not fit the memory or a file cannot be written.
pub fn scaling(arguments: &[String]) -> StepResult {
    step(bench_example("scaling", arguments))
}

fn bench_example(name: &str, arguments: &[String]) -> Command {
    let package = ["--release", "--package", "benches", "--example", name];
    program(&package, arguments)
}

/// The command that builds and runs the program that `selection` names to cargo.
fn program(selection: &[&str], arguments: &[String]) -> Command {
    let mut command = cargo(["run", "--quiet"]);
    command.args(selection).arg("--").args(arguments);
    command
}

/// Runs a command whose exit status is ours.
fn same_exit(mut command: Command) -> ExitCode {
    match command.status() {
        // A program that was killed has no code.
        Ok(status) => ExitCode::from(status.code().map_or(1, |code| code as u8)),
        Err(error) => {
            eprintln!("cargo: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Runs a command as a step of ours.
fn step(mut command: Command) -> StepResult {
    run(&mut command).map(|()| Outcome::Passed)
}
