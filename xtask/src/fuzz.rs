//! `cargo xtask fuzz [TARGET] [SECONDS]`: looks for input that breaks a promise, with the nightly
//! toolchain.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use crate::steps::{Outcome, StepResult, output, root, run};
use crate::tools::{Install, cargo_tool};

/// Seconds for each target when nobody says how long.
const DEFAULT_SECONDS: u32 = 60;

/// Runs one target or all of them, installing `cargo-fuzz` into the target folder when it is not
/// there.
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

/// What a run of one target did, by its last lines.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Figures {
    executions: u64,
    coverage: u64,
    inputs: u64,
}

impl Figures {
    /// From the messages of libFuzzer.
    fn parse(log: &str) -> Self {
        let mut figures = Self::default();
        for line in log.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            let after = |name: &str| {
                let at = words.iter().position(|word| *word == name)?;
                words.get(at + 1)?.split('/').next()?.parse().ok()
            };
            if let Some(coverage) = after("cov:") {
                figures.coverage = coverage;
                figures.inputs = after("corp:").unwrap_or(figures.inputs);
            }
            if let Some(executions) = after("stat::number_of_executed_units:") {
                figures.executions = executions;
            }
        }
        figures
    }
}

/// Builds the targets once, then runs as many at a time as there are cores, and prints a table of
/// what they did.
fn run_targets(tool: &PathBuf, targets: &[String], seconds: u32) -> StepResult {
    let mut build = Command::new(tool);
    build
        .current_dir(root())
        // All code here is safe: what breaks is a promise, not memory. Without a sanitizer twice as
        // much is tried.
        .args(["build", "--fuzz-dir", "fuzz", "--sanitizer", "none"])
        .args(if let [one] = targets { Some(one) } else { None })
        .env("RUSTUP_TOOLCHAIN", "nightly")
        .env_remove("CARGO");
    run(&mut build)?;
    let folder = binaries()?;
    let next = AtomicUsize::new(0);
    let rows = Mutex::new(Vec::new());
    let cores = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..cores.min(targets.len()) {
            scope.spawn(|| {
                while let Some(target) = targets.get(next.fetch_add(1, Ordering::Relaxed)) {
                    println!("    {target}, {seconds} s");
                    let outcome = run_target(&folder.join(target), target, seconds);
                    let mut rows = rows.lock().unwrap_or_else(PoisonError::into_inner);
                    rows.push((target.clone(), outcome));
                }
            });
        }
    });
    let mut rows = rows.into_inner().unwrap_or_else(PoisonError::into_inner);
    rows.sort_by(|a, b| a.0.cmp(&b.0));
    println!("\n| target | executions | seconds | edges | inputs |");
    println!("| --- | ---: | ---: | ---: | ---: |");
    let mut faults = Vec::new();
    for (target, outcome) in rows {
        match outcome {
            Ok(Figures {
                executions,
                coverage,
                inputs,
            }) => println!("| {target} | {executions} | {seconds} | {coverage} | {inputs} |"),
            Err(fault) => faults.push(format!("{target}: {fault}")),
        }
    }
    if faults.is_empty() {
        Ok(Outcome::Passed)
    } else {
        Err(faults.join("\n"))
    }
}

/// Runs one target; what is found goes to a folder of its own, the committed corpus is only read.
fn run_target(program: &Path, target: &str, seconds: u32) -> Result<Figures, String> {
    let found = root().join("target/fuzz-corpus").join(target);
    let broken = root().join("fuzz/artifacts").join(target);
    for folder in [&found, &broken] {
        std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    let mut command = Command::new(program);
    command
        .current_dir(root())
        .arg(&found)
        .arg(root().join("fuzz/corpus").join(target))
        .arg(format!("-max_total_time={seconds}"))
        .arg(format!("-artifact_prefix={}/", broken.display()))
        .args(["-max_len=2000", "-len_control=0", "-print_final_stats=1"]);
    Ok(Figures::parse(&output(&mut command)?))
}

/// Where the programs of the targets are.
fn binaries() -> Result<PathBuf, String> {
    let version = output(Command::new("rustup").args(["run", "nightly", "rustc", "-vV"]))?;
    let host = version.lines().find_map(|line| line.strip_prefix("host: "));
    let host = host.ok_or("rustc -vV names no host")?;
    Ok(root().join("fuzz/target").join(host).join("release"))
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
    cargo_tool("cargo-fuzz", install)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_those_of_the_last_lines() {
        let log = "#2\tINITED cov: 3 ft: 4 corp: 1/9b exec/s: 0 rss: 9Mb\n\
                   #99\tDONE   cov: 17 ft: 40 corp: 12/3Kb lim: 41 exec/s: 7 rss: 9Mb\n\
                   stat::number_of_executed_units: 99\n";
        let expected = Figures {
            executions: 99,
            coverage: 17,
            inputs: 12,
        };
        assert_eq!(Figures::parse(log), expected, "of the end");
    }
}
