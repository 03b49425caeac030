//! `cargo xtask counts [--write]`: instructions that the hot paths take, which repeat to the last
//! digit on any machine.

use std::collections::BTreeMap;
use std::fs;
use std::num::NonZero;
use std::path::Path;
use std::process::Command;
use std::thread;

use crate::steps::{Outcome, StepResult, cargo, is_there, output, root, run, side_by_side};

/// What is written down, one `NAME COUNT` a line.
const WRITTEN: &str = "benches/counts.txt";

/// How much a count may grow before it is a fault: compilers differ a little from release to
/// release.
const TOLERANCE: f64 = 0.10;

/// Compares the counts with the written ones, or writes them.
///
/// # Errors
/// What grew, or what could not be measured.
pub fn counts(arguments: &[String]) -> StepResult {
    if !is_there("valgrind") {
        return Ok(Outcome::Skipped("no valgrind".into()));
    }
    let measured = measure()?;
    match arguments {
        [] => compare(&read()?, &measured),
        [flag] if flag == "--write" => write(&measured),
        _ => Err("usage: cargo xtask counts [--write]".into()),
    }
}

/// Instructions a call, by name.
type Counts = BTreeMap<String, u64>;

/// Runs `benches/src/bin/counts.rs`, which lists its names, under callgrind, once a name.
fn measure() -> Result<Counts, String> {
    // Not an example: that would compile the renderer too, for other examples.
    let program = ["--package", "benches", "--bin", "counts"];
    run(&mut cargo(
        ["build", "--quiet", "--release"].iter().chain(&program),
    ))?;
    let program = root().join("target/release/counts");
    let names = output(&mut Command::new(&program))?;
    let names: Vec<(&str, &str)> = (names.lines())
        .filter_map(|line| line.split_once(' '))
        .collect();
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let parts: Vec<_> = names.chunks(names.len().div_ceil(cores).max(1)).collect();
    let counts = side_by_side(&parts, |part| -> Result<Counts, String> {
        part.iter().map(|name| count(&program, *name)).collect()
    });
    counts
        .into_iter()
        .try_fold(Counts::new(), |mut all, of_part| {
            all.extend(of_part?);
            Ok(all)
        })
}

/// A name, and its instructions a call.
fn count(program: &Path, (name, calls): (&str, &str)) -> Result<(String, u64), String> {
    let mut valgrind = Command::new("valgrind");
    valgrind
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(format!("--toggle-collect=*counts::count_{name}*"))
        .arg(program)
        .arg(name);
    let report = output(&mut valgrind)?;
    let total = collected(&report).ok_or(format!("{name}: callgrind counted nothing"))?;
    let calls: u64 = calls
        .parse()
        .map_err(|_| format!("{name}: not a number: {calls}"))?;
    println!("    {name}: {} instructions", total / calls);
    Ok((name.to_owned(), total / calls))
}

/// The number in callgrind's line `==1== Collected : 123`.
fn collected(report: &str) -> Option<u64> {
    let line = report
        .lines()
        .find_map(|line| line.split_once("Collected : "))?;
    line.1.trim().parse().ok().filter(|&count| count > 0)
}

fn compare(written: &Counts, measured: &Counts) -> StepResult {
    for (name, &count) in measured {
        let Some(&old) = written.get(name) else {
            return Err(format!(
                "{name} is not in {WRITTEN}; see cargo xtask counts --write"
            ));
        };
        let growth = count as f64 / old as f64 - 1.0;
        if growth > TOLERANCE {
            return Err(format!(
                "{name} takes {count} instructions, {old} are written down"
            ));
        }
        if growth < -TOLERANCE {
            println!("    {name} got better than {old}: cargo xtask counts --write");
        }
    }
    Ok(Outcome::Passed)
}

fn read() -> Result<Counts, String> {
    let text = fs::read_to_string(root().join(WRITTEN)).map_err(|e| format!("{WRITTEN}: {e}"))?;
    let pairs = text.lines().filter_map(|line| line.split_once(' '));
    pairs
        .map(|(name, count)| match count.parse() {
            Ok(count) => Ok((name.to_owned(), count)),
            Err(_) => Err(format!("{WRITTEN}: not a number: {count}")),
        })
        .collect()
}

fn write(measured: &Counts) -> StepResult {
    let lines: String = measured
        .iter()
        .map(|(name, count)| format!("{name} {count}\n"))
        .collect();
    fs::write(root().join(WRITTEN), lines).map_err(|e| format!("{WRITTEN}: {e}"))?;
    Ok(Outcome::Passed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_growth_fails() {
        let counts = |count| Counts::from([("pmf".to_owned(), count)]);
        assert_eq!(
            compare(&counts(100), &counts(105)),
            Ok(Outcome::Passed),
            "a little more"
        );
        assert_eq!(
            compare(&counts(100), &counts(50)),
            Ok(Outcome::Passed),
            "better"
        );
        assert!(compare(&counts(100), &counts(120)).is_err(), "a fifth more");
        assert!(
            compare(&Counts::new(), &counts(1)).is_err(),
            "not written down"
        );
    }

    #[test]
    fn the_total_is_found_in_the_report() {
        assert_eq!(
            collected("==7== Events\n==7== Collected : 4200\n"),
            Some(4200),
            "a count"
        );
        assert_eq!(
            collected("==7== Collected : 0"),
            None,
            "a name that never ran"
        );
    }
}
