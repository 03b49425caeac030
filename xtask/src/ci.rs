//! `cargo xtask ci`: everything that a machine can check without being asked twice.

use std::process::Command;

use crate::steps::{Outcome, StepResult, Steps, root, run};
use crate::{check, counts, fuzz, no_std};

/// The oldest toolchain that the workspace promises to build with.
const OLDEST: &str = env!("CARGO_PKG_RUST_VERSION");

/// Seconds that each fuzz target gets.
const FUZZ_SECONDS: u32 = 5;

/// Adds all steps: the everyday ones, then what needs more tools or more time.
pub fn add_steps(steps: &mut Steps) {
    check::add_steps(steps);
    no_std::add_steps(steps);
    steps.run(&format!("build with Rust {OLDEST}"), oldest_toolchain);
    steps.run("fuzz targets, a few seconds each", || {
        fuzz::smoke(FUZZ_SECONDS)
    });
    steps.run("instruction counts", || counts::counts(&[]));
}

fn oldest_toolchain() -> StepResult {
    let installed = Command::new("rustup")
        .args(["run", OLDEST, "rustc", "--version"])
        .output();
    if !installed.is_ok_and(|out| out.status.success()) {
        return Ok(Outcome::Skipped(format!(
            "no such toolchain (rustup toolchain install {OLDEST})"
        )));
    }
    let mut check = Command::new("rustup");
    check.args([
        "run",
        OLDEST,
        "cargo",
        "check",
        "--workspace",
        "--quiet",
        "--target-dir",
    ]);
    check.arg(root().join("target/oldest")).current_dir(root());
    run(check.env_remove("CARGO").env_remove("RUSTUP_TOOLCHAIN")).map(|()| Outcome::Passed)
}
