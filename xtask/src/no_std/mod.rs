//! `cargo xtask no-std`: the proof that nothing needs an operating system, and most of it no
//! allocator.

mod probe;

use std::path::Path;
use std::process::Command;

use crate::debian::Toolchain;
use crate::features::{FeatureSet, Needs, for_each_set};
use crate::steps::{Outcome, StepResult, Steps, cargo, output, root, run};

/// A microcontroller with a float unit for `f32` and none for `f64`.
const TARGET: &str = "thumbv7em-none-eabihf";

/// Adds both proofs as steps.
pub fn add_steps(steps: &mut Steps) {
    steps.run(
        "each crate links without std, and without an allocator where it promises that",
        probe::check,
    );
    steps.run(
        &format!("each crate builds for {TARGET}"),
        check_bare_target,
    );
}

/// Builds the libraries, whole, without std for the bare target, with the installed toolchain or
/// with Debian's.
fn check_bare_target() -> StepResult {
    if is_installed(TARGET)? {
        println!("    with the installed target");
        return build_all(&|_| cargo(["build", "--target", TARGET]));
    }
    match Toolchain::with_sources() {
        Ok(toolchain) => {
            println!(
                "    with Debian's toolchain in {}",
                toolchain.folder().display()
            );
            build_all(&|needs| toolchain.cargo_build(TARGET, needs))
        }
        Err(reason) => Ok(Outcome::Skipped(format!(
            "no target (rustup target add {TARGET}) and no toolchain from Debian ({reason})"
        ))),
    }
}

/// Whether the installed toolchain has the libraries of `target`.
///
/// # Errors
/// If there is no compiler.
pub fn is_installed(target: &str) -> Result<bool, String> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let sysroot = output(Command::new(rustc).args(["--print", "sysroot"]))?;
    let libraries = Path::new(sysroot.trim()).join("lib/rustlib").join(target);
    Ok(libraries.is_dir())
}

fn build_all(build: &(dyn Fn(Needs) -> Command + Sync)) -> StepResult {
    let without_std = |set: &FeatureSet| set.is_of_a_whole() && set.needs != Needs::Std;
    for_each_set(without_std, |set| {
        let mut command = build(set.needs);
        command
            // Whether there is code for it does not depend on how good the code is.
            .env("CARGO_PROFILE_DEV_OPT_LEVEL", "0")
            .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0")
            .args(["--quiet", "--lib", "--target-dir"])
            .arg(root().join("target/bare").join(set.needs.folder()));
        run(command.args(set.arguments()))
    })
}
