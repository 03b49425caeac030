//! `cargo xtask oldest`: the libraries with the oldest compiler that they promise to build with.

use std::process::Command;

use crate::debian::Toolchain;
use crate::features::{FeatureSet, Needs, for_each_set};
use crate::steps::{Outcome, StepResult, Steps, output, root, run};

/// The oldest compiler, as the workspace states it.
const OLDEST: &str = env!("CARGO_PKG_RUST_VERSION");

/// Adds the one step.
pub fn add_steps(steps: &mut Steps) {
    steps.run(&format!("libraries with Rust {OLDEST}"), libraries);
}

/// Checks the libraries, whole, with rustup's toolchain, or with Debian's where there is none.
fn libraries() -> StepResult {
    if output(rustup().arg("--version")).is_ok() {
        return check_all(&rustup);
    }
    match Toolchain::of_release(OLDEST) {
        Ok(toolchain) => check_all(&|| toolchain.cargo()),
        Err(reason) => Ok(Outcome::Skipped(format!(
            "no such toolchain (rustup toolchain install {OLDEST}), none from Debian ({reason})"
        ))),
    }
}

fn rustup() -> Command {
    let mut command = Command::new("rustup");
    command
        .args(["run", OLDEST, "cargo"])
        .current_dir(root())
        .env_remove("CARGO")
        .env_remove("RUSTUP_TOOLCHAIN");
    command
}

fn check_all(cargo: &(dyn Fn() -> Command + Sync)) -> StepResult {
    let check = |needs: Needs, arguments: &[&str]| {
        let mut command = cargo();
        command.args(["check", "--release", "--quiet", "--lib", "--target-dir"]);
        let folder = root().join("target/oldest").join(needs.folder());
        run(command.arg(folder).args(arguments))
    };
    for_each_set(FeatureSet::is_of_a_whole, |set| {
        check(set.needs, &set.arguments())
    })?;
    check(Needs::Std, &["--package", "light-scene"]).map(|()| Outcome::Passed)
}
