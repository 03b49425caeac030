//! `cargo xtask fuzz [TARGET] [SECONDS]`: looks for input that breaks a promise, with the nightly toolchain.

use std::path::PathBuf;
use std::process::Command;

use crate::steps::{Outcome, StepResult, output, root, run};

/// Seconds for each target when nobody says how long.
const DEFAULT_SECONDS: u32 = 60;

/// Runs one target or all of them, installing `cargo-fuzz` into the target folder when it is not there.
///
/// # Errors
/// What was found, or what is missing.
pub fn fuzz(arguments: &[String]) -> StepResult {
    let targets = targets()?;
    let (chosen, seconds) = match arguments {
        [] => (targets, DEFAULT_SECONDS),
        [one] => match one.parse() {
            Ok(seconds) => (targets, seconds),
            Err(_) => (vec![one.clone()], DEFAULT_SECONDS),
        },
        [target, seconds] => {
            let seconds = seconds
                .parse()
                .map_err(|_| format!("not a number of seconds: {seconds}"))?;
            (vec![target.clone()], seconds)
        }
        _ => return Err("usage: cargo xtask fuzz [TARGET] [SECONDS]".into()),
    };
    let tool = cargo_fuzz(Install::Allowed)?;
    run_targets(&tool, &chosen, seconds)
}

/// A few seconds of each target, if the tools are there.
///
/// # Errors
/// What was found.
pub fn smoke(seconds: u32) -> StepResult {
    match cargo_fuzz(Install::Forbidden) {
        Ok(tool) => run_targets(&tool, &targets()?, seconds),
        Err(reason) => Ok(Outcome::Skipped(reason)),
    }
}

/// Whether to build the tool when it is missing.
#[derive(Clone, Copy, PartialEq)]
enum Install {
    Allowed,
    Forbidden,
}

fn run_targets(tool: &PathBuf, targets: &[String], seconds: u32) -> StepResult {
    for target in targets {
        println!("    {target}, {seconds} s");
        // What is found goes to the first folder, the committed corpus is only read.
        let found = root().join("target/fuzz-corpus").join(target);
        std::fs::create_dir_all(&found).map_err(|e| e.to_string())?;
        let mut command = Command::new(tool);
        command
            .current_dir(root())
            .args(["run", "--fuzz-dir", "fuzz", target])
            .arg(found)
            .arg(root().join("fuzz/corpus").join(target))
            .arg("--")
            .arg(format!("-max_total_time={seconds}"))
            .args(["-max_len=2000", "-verbosity=0"])
            .env("RUSTUP_TOOLCHAIN", "nightly")
            .env_remove("CARGO");
        run(&mut command)?;
    }
    Ok(Outcome::Passed)
}

/// The targets, by their files.
fn targets() -> Result<Vec<String>, String> {
    let folder = root().join("fuzz/fuzz_targets");
    let entries = std::fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let files = entries.filter_map(|entry| entry.ok().map(|e| e.path()));
    let mut names: Vec<String> = files
        .filter_map(|file| Some(file.file_stem()?.to_string_lossy().into_owned()))
        .collect();
    names.sort();
    Ok(names)
}

/// The program `cargo-fuzz`, and the nightly toolchain that it needs.
fn cargo_fuzz(install: Install) -> Result<PathBuf, String> {
    let nightly = output(Command::new("rustup").args(["run", "nightly", "rustc", "--version"]));
    nightly.map_err(|_| "no nightly toolchain (rustup toolchain install nightly)")?;
    let ours = root().join("target/tools/bin/cargo-fuzz");
    for tool in [PathBuf::from("cargo-fuzz"), ours.clone()] {
        if output(Command::new(&tool).arg("--version")).is_ok() {
            return Ok(tool);
        }
    }
    if install == Install::Forbidden {
        return Err("no cargo-fuzz (cargo xtask fuzz installs it)".into());
    }
    println!("    installing cargo-fuzz into target/tools");
    let mut build = Command::new("cargo");
    build.args(["install", "cargo-fuzz", "--locked", "--quiet", "--root"]);
    run(build.arg(root().join("target/tools")))?;
    Ok(ours)
}
