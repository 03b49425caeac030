//! `cargo xtask bench [FILTER]`: criterion's benches, with ratios to the reference.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde_json::Value;

use crate::steps::{Outcome, StepResult, cargo, output, root};

/// The name that the baseline of a group has.
const REFERENCE: &str = "reference";

/// One bench of a group.
#[derive(Clone, Debug, PartialEq)]
struct Timing {
    group: String,
    name: String,
    input: String,
    nanoseconds: f64,
}

/// Runs the benches whose name contains the filter, and prints what each took.
///
/// # Errors
/// The command that failed, or a result that cannot be read.
pub fn bench(arguments: &[String]) -> StepResult {
    let start = SystemTime::now();
    for target in ["pieces", "samplers", "sources"] {
        println!("    {target}");
        let mut command = cargo(["bench", "--package", "benches", "--bench", target, "--"]);
        output(command.args(arguments))?;
    }
    let mut files = Vec::new();
    find_results(&root().join("target/criterion"), start, &mut files);
    let mut timings = files
        .iter()
        .map(|file| read(file))
        .collect::<Result<Vec<_>, _>>()?;
    timings.sort_by(|a, b| (&a.group, &a.input, &a.name).cmp(&(&b.group, &b.input, &b.name)));
    print!("{}", table(&timings));
    Ok(Outcome::Passed)
}

/// The folders `new` in which criterion wrote since `start`.
fn find_results(folder: &Path, start: SystemTime, found: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for path in entries.filter_map(|entry| entry.ok().map(|e| e.path())) {
        let estimates = path.join("estimates.json");
        let written = estimates.metadata().and_then(|m| m.modified());
        if path.ends_with("new") && written.is_ok_and(|time| time >= start) {
            found.push(path);
        } else if path.is_dir() {
            find_results(&path, start, found);
        }
    }
}

fn read(folder: &Path) -> Result<Timing, String> {
    let json = |file: &str| -> Result<Value, String> {
        let path = folder.join(file);
        let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        serde_json::from_str(&text).map_err(|e| format!("{}: {e}", path.display()))
    };
    let (bench, estimates) = (json("benchmark.json")?, json("estimates.json")?);
    let text = |field: &str| bench[field].as_str().unwrap_or_default().to_owned();
    // Benches of many queries say how many: the figure is the time of one.
    let elements = bench["throughput"]["Elements"].as_f64().unwrap_or(1.0);
    let nanoseconds = estimates["median"]["point_estimate"].as_f64();
    Ok(Timing {
        group: text("group_id"),
        name: text("function_id"),
        input: text("value_str"),
        nanoseconds: nanoseconds.ok_or("no median in estimates.json")? / elements,
    })
}

/// One line a bench: its time, and how many times faster it is than the reference of its group on
/// the same input.
fn table(timings: &[Timing]) -> String {
    let mut lines = format!("{:<44} {:>12} {:>14}\n", "bench", "ns", "vs reference");
    for t in timings {
        let same = |r: &&Timing| r.name == REFERENCE && r.group == t.group && r.input == t.input;
        let ratio = match timings.iter().find(same) {
            Some(r) if t.name != REFERENCE => format!("{:.2} x", r.nanoseconds / t.nanoseconds),
            _ => String::new(),
        };
        let name = [t.group.as_str(), &t.name, &t.input].join("/");
        lines += &format!(
            "{:<44} {:>12.1} {ratio:>14}\n",
            name.trim_end_matches('/'),
            t.nanoseconds
        );
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_are_to_the_reference_on_the_same_input() {
        let timing = |name: &str, input: &str, nanoseconds| Timing {
            group: "pmf".into(),
            name: name.into(),
            input: input.into(),
            nanoseconds,
        };
        let timings = [
            timing("reference", "100", 8.0),
            timing("bvh", "100", 2.0),
            timing("bvh", "10000", 4.0),
        ];
        let table = table(&timings);
        let lines: Vec<&str> = table.lines().collect();
        assert!(lines[2].ends_with("4.00 x"), "a ratio in {table}");
        assert!(
            !lines[1].ends_with('x') && !lines[3].ends_with('x'),
            "none in {table}"
        );
    }
}
