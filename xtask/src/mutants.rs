//! `cargo xtask mutants [CRATE] [COUNT]`: breaks the core crates on purpose and sees whether a test notices.
//!
//! `cargo-mutants` makes the mutants and runs the tests of the mutated crate; `.cargo/mutants.toml` lists those that
//! are equivalent, each with its reason.

use std::path::Path;
use std::process::Command;

use crate::steps::{Outcome, StepResult, output, root};
use crate::tools::{Install, cargo_tool};

/// The core: the crates that are mutated, and whose coverage is measured.
pub const CRATES: [&str; 6] = [
    "light-math",
    "light-bounds",
    "light-bvh",
    "light-samplers",
    "light-sources",
    "light-media",
];

/// Mutants of each crate when nobody says how many: every n-th of the list, so from all of its files.
const DEFAULT_COUNT: usize = 60;

/// Runs so many mutants of one crate or of each.
///
/// # Errors
/// The survivors, or what could not run.
pub fn mutants(arguments: &[String]) -> StepResult {
    let usage = "usage: cargo xtask mutants [CRATE] [COUNT|all]";
    let (names, count) = match arguments {
        [] => (None, None),
        [one] if CRATES.contains(&one.as_str()) => (Some(one), None),
        [one] => (None, Some(one)),
        [name, count] if CRATES.contains(&name.as_str()) => (Some(name), Some(count)),
        _ => return Err(usage.into()),
    };
    let count = match count.map(String::as_str) {
        None => DEFAULT_COUNT,
        Some("all") => usize::MAX,
        Some(text) => match text.parse() {
            Ok(count) if count > 0 => count,
            _ => {
                return Err(format!(
                    "{text} is no crate of the core and no count; {usage}"
                ));
            }
        },
    };
    let tool = cargo_tool("cargo-mutants", Install::Allowed)?;
    let mut total = Tally::default();
    let mut rows = String::new();
    for name in CRATES.iter().filter(|c| names.is_none_or(|n| n == *c)) {
        let tally = run_crate(&tool, name, count)?;
        rows += &format!("{}\n", tally.row(name));
        total.add(tally);
    }
    println!("{:15} mutants caught timeout unviable missed", "crate");
    print!("{rows}");
    println!("{}", total.row("total"));
    if total.missed == 0 {
        Ok(Outcome::Passed)
    } else {
        Err(format!(
            "{} mutants survive (their lines are above and in target/mutants/CRATE/mutants.out/missed.txt)",
            total.missed
        ))
    }
}

/// How the mutants of a crate ended.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    caught: usize,
    timeout: usize,
    unviable: usize,
    missed: usize,
}

impl Tally {
    fn add(&mut self, other: Self) {
        self.caught += other.caught;
        self.timeout += other.timeout;
        self.unviable += other.unviable;
        self.missed += other.missed;
    }

    fn row(&self, name: &str) -> String {
        let all = self.caught + self.timeout + self.unviable + self.missed;
        format!(
            "{name:15} {all:7} {:6} {:7} {:8} {:6}",
            self.caught, self.timeout, self.unviable, self.missed
        )
    }
}

fn run_crate(tool: &Path, name: &str, count: usize) -> Result<Tally, String> {
    let list = output(command(tool).args(["--list", "--package", name]))?;
    let shards = (list.lines().count() / count).max(1);
    let folder = root().join("target/mutants").join(name);
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    println!(
        "    {name}: one in {shards} of {} mutants",
        list.lines().count()
    );
    // The tool's own exit status tells less than its files: which mutants survived.
    let status = command(tool)
        .args(["--package", name, "--no-times", "--colors", "never"])
        .args(["--sharding", "round-robin", "--shard"])
        .arg(format!("0/{shards}"))
        .arg("--output")
        .arg(&folder)
        .status()
        .map_err(|e| format!("cargo-mutants: {e}"))?;
    // 0: all caught, 2: some missed, 3: some ran out of time; anything else is no result.
    if !matches!(status.code(), Some(0 | 2 | 3)) {
        return Err(format!("cargo mutants of {name} did not finish: {status}"));
    }
    let lines = |file: &str| {
        let path = folder.join("mutants.out").join(file);
        let text =
            std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        Ok::<_, String>(text.lines().count())
    };
    Ok(Tally {
        caught: lines("caught.txt")?,
        timeout: lines("timeout.txt")?,
        unviable: lines("unviable.txt")?,
        missed: lines("missed.txt")?,
    })
}

fn command(tool: &Path) -> Command {
    let mut command = Command::new(tool);
    command
        .arg("mutants")
        .current_dir(root())
        .env_remove("CARGO");
    command
}
