//! `cargo xtask ci`: everything that a machine can check without being asked twice.

use std::process::Command;

use crate::debian::Toolchain;
use crate::features::for_each_set;
use crate::steps::{Outcome, StepResult, Steps, output, root, run};
use crate::tools::Install;
use crate::{check, counts, dependencies, fuzz, no_std};

/// The oldest toolchain that the libraries promise to build with.
const OLDEST: &str = env!("CARGO_PKG_RUST_VERSION");

/// Seconds that each fuzz target gets.
const FUZZ_SECONDS: u32 = 5;

/// Adds all steps: the everyday ones, then what needs more tools or more time.
pub fn add_steps(steps: &mut Steps) {
    check::add_steps(steps);
    no_std::add_steps(steps);
    steps.run(&format!("libraries with Rust {OLDEST}"), oldest_toolchain);
    dependencies::add_steps(steps, Install::Forbidden);
    steps.run("fuzz targets, a few seconds each", || {
        fuzz::smoke(FUZZ_SECONDS)
    });
    steps.run("instruction counts", || counts::counts(&[]));
}

/// Checks every feature set of the libraries with the oldest compiler: rustup's, or Debian's.
fn oldest_toolchain() -> StepResult {
    let target = root().join("target/oldest");
    let check = |mut command: Command, set: &[&str]| {
        command
            .args(["check", "--quiet", "--lib", "--target-dir"])
            .arg(&target)
            .args(set);
        run(&mut command)
    };
    let rustup = || {
        let mut command = Command::new("rustup");
        command.args(["run", OLDEST, "cargo"]).current_dir(root());
        command.env_remove("CARGO").env_remove("RUSTUP_TOOLCHAIN");
        command
    };
    let has_rustup = output(rustup().arg("--version")).is_ok();
    let debian = if has_rustup {
        None
    } else {
        match Toolchain::of_release(OLDEST) {
            Ok(toolchain) => Some(toolchain),
            Err(reason) => {
                return Ok(Outcome::Skipped(format!(
                    "no such toolchain (rustup toolchain install {OLDEST}), none from Debian ({reason})"
                )));
            }
        }
    };
    let cargo = || debian.as_ref().map_or_else(rustup, Toolchain::cargo);
    for_each_set(|_| true, |set| check(cargo(), &set.arguments()))?;
    check(cargo(), &["--package", "light-scene"]).map(|()| Outcome::Passed)
}
