//! `cargo xtask mutants [CRATE] [COUNT|all|missed|FILE] [OFFSET]`: breaks the core crates on
//! purpose and sees whether a test notices.
//!
//! `cargo-mutants` makes the mutants and runs the tests of the mutated crate, but for its doc
//! tests; `.cargo/mutants.toml` lists those that are equivalent, each with its reason. Another
//! `OFFSET` takes other mutants; `missed` takes those that survived the run before, and the path of
//! a `FILE` below the crate's `src` all of that file.

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

/// Mutants of each crate when nobody says how many: every n-th of the list, so from all of its
/// files.
const DEFAULT_COUNT: usize = 60;

/// The survivors of a crate's last run, in its folder.
const MISSED: &str = "missed.txt";

const USAGE: &str = "usage: cargo xtask mutants [CRATE] [COUNT|all|missed|FILE] [OFFSET]";

/// Which mutants of a crate are made.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Choice {
    /// So many or fewer, evenly spread over the list, from the given place in it on.
    Spread { count: usize, offset: usize },
    /// Those that survived the run before.
    Missed,
    /// Those of one file, by its path below `src`.
    File(String),
}

/// Runs so many mutants of one crate or of each.
///
/// # Errors
/// The survivors, or what could not run.
pub fn mutants(arguments: &[String]) -> StepResult {
    let (names, rest) = match arguments {
        [name, rest @ ..] if CRATES.contains(&name.as_str()) => (Some(name), rest),
        rest => (None, rest),
    };
    let choice = choice(rest)?;
    let tool = cargo_tool("cargo-mutants", Install::Allowed)?;
    let mut total = Tally::default();
    let mut rows = String::new();
    for name in CRATES.iter().filter(|c| names.is_none_or(|n| n == *c)) {
        let tally = run_crate(&tool, name, &choice)?;
        rows += &format!("{}\n", tally.row(name));
        total.add(tally);
    }
    println!("| crate | all mutants | tried | caught | timed out | do not compile | missed |");
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: |");
    print!("{rows}");
    println!("{}", total.row("total"));
    if total.missed == 0 {
        Ok(Outcome::Passed)
    } else {
        Err(format!(
            "{} mutants survive (their lines are above and in target/mutants/CRATE/{MISSED})",
            total.missed
        ))
    }
}

fn choice(arguments: &[String]) -> Result<Choice, String> {
    let number = |text: &String| {
        text.parse()
            .map_err(|_| format!("{text} is no crate of the core and no number; {USAGE}"))
    };
    let (count, offset) = match arguments {
        [] => {
            return Ok(Choice::Spread {
                count: DEFAULT_COUNT,
                offset: 0,
            });
        }
        [one] if one == "missed" => return Ok(Choice::Missed),
        [file] if file.ends_with(".rs") => return Ok(Choice::File(file.clone())),
        [count] => (count, 0),
        [count, offset] => (count, number(offset)?),
        _ => return Err(USAGE.into()),
    };
    let count = if count == "all" {
        usize::MAX
    } else {
        number(count)?
    };
    if count == 0 {
        return Err(format!("0 is no count; {USAGE}"));
    }
    Ok(Choice::Spread { count, offset })
}

/// How the mutants of a crate ended.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    known: usize,
    caught: usize,
    timeout: usize,
    unviable: usize,
    missed: usize,
}

impl Tally {
    fn add(&mut self, other: Self) {
        self.known += other.known;
        self.caught += other.caught;
        self.timeout += other.timeout;
        self.unviable += other.unviable;
        self.missed += other.missed;
    }

    /// A row of the table in `RELIABILITY.md`.
    fn row(&self, name: &str) -> String {
        let tried = self.caught + self.timeout + self.unviable + self.missed;
        format!(
            "| {name} | {} | {tried} | {} | {} | {} | {} |",
            self.known, self.caught, self.timeout, self.unviable, self.missed
        )
    }
}

fn run_crate(tool: &Path, name: &str, choice: &Choice) -> Result<Tally, String> {
    let known = output(command(tool).args(["--list", "--package", name]))?;
    let known = known.lines().count();
    let folder = root().join("target/mutants").join(name);
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut first = command(tool);
    let mut names = None;
    match choice {
        &Choice::Spread { count, offset } => {
            let shards = known.div_ceil(count).max(1);
            println!("    {name}: one in {shards} of {known} mutants");
            first.args(["--sharding", "round-robin", "--shard"]);
            first.arg(format!("{}/{shards}", offset % shards));
        }
        Choice::Missed => {
            let missed = read(&folder.join(MISSED))?;
            if missed.is_empty() {
                println!("    {name}: no mutant survived the run before");
                return Ok(Tally {
                    known,
                    ..Tally::default()
                });
            }
            names = Some(missed);
        }
        Choice::File(file) => {
            let path = format!("crates/{name}/src/{file}");
            if !root().join(&path).is_file() {
                return Err(format!("{path} is no file; {USAGE}"));
            }
            first.args(["--file", &path]);
        }
    }
    // Unit tests are one program, built in a fraction of the time, for which no other test is
    // built; the others only have to find what these miss.
    let units = run_tests(first, name, names, &folder.join("unit"), &["--lib"])?;
    let mut tally = Tally {
        known,
        ..units.tally
    };
    let mut missed = units.missed;
    if !missed.is_empty() {
        println!(
            "    {name}: {} left to the tests of the crate",
            tally.missed
        );
        let (mut second, rest) = (command(tool), folder.join("tests"));
        // What pins values bit for bit needs the software float functions.
        second.args(["--features", "libm"]);
        let rest = run_tests(second, name, Some(missed), &rest, &["--test", "*"])?;
        tally.missed = 0;
        tally.add(rest.tally);
        missed = rest.missed;
    }
    let path = folder.join(MISSED);
    std::fs::write(&path, &missed).map_err(|e| format!("{}: {e}", path.display()))?;
    print!("{missed}");
    Ok(tally)
}

/// What `cargo-mutants` left behind.
struct Run {
    tally: Tally,
    /// The survivors, one a line.
    missed: String,
}

/// Runs the `tests` on the mutants that `run` chooses, of which only those of `names` count, one a
/// line, if there are any.
fn run_tests(
    mut run: Command,
    package: &str,
    names: Option<String>,
    folder: &Path,
    tests: &[&str],
) -> Result<Run, String> {
    std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for name in names.iter().flat_map(|names| names.lines()) {
        run.args(["--re", &format!("^{}$", escape(name))]);
    }
    // The tool's own exit status tells less than its files: which mutants survived.
    let status = run
        .args(["--package", package, "--no-times", "--colors", "never"])
        .arg("--output")
        .arg(folder)
        // Of all that cargo does: what follows `--` would choose what runs, but not what is built.
        .args(tests.iter().map(|test| format!("--cargo-arg={test}")))
        .status()
        .map_err(|e| format!("cargo-mutants: {e}"))?;
    // 0: all caught, 2: some missed, 3: some ran out of time; anything else is no result.
    if !matches!(status.code(), Some(0 | 2 | 3)) {
        return Err(format!(
            "cargo mutants of {package} did not finish: {status}"
        ));
    }
    // Mutants that delete a field are made whatever the names.
    let counts = |line: &&str| names.as_ref().is_none_or(|n| n.lines().any(|n| n == *line));
    let lines = |file: &str| {
        let all = read(&folder.join("mutants.out").join(file))?;
        let lines = all.lines().filter(counts);
        Ok::<_, String>(lines.map(|line| format!("{line}\n")).collect::<String>())
    };
    let count = |file: &str| Ok::<_, String>(lines(file)?.lines().count());
    let missed = lines("missed.txt")?;
    Ok(Run {
        tally: Tally {
            known: 0,
            caught: count("caught.txt")?,
            timeout: count("timeout.txt")?,
            unviable: count("unviable.txt")?,
            missed: missed.lines().count(),
        },
        missed,
    })
}

fn read(path: &Path) -> Result<String, String> {
    std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))
}

/// The regular expression that matches this text alone.
fn escape(text: &str) -> String {
    // Not `<` and `>`: with a backslash they stand for the ends of a word.
    let special = |c: char| r"\.+*?()|[]{}^$#&-~".contains(c);
    text.chars().fold(String::new(), |mut escaped, c| {
        if special(c) {
            escaped.push('\\');
        }
        escaped.push(c);
        escaped
    })
}

fn command(tool: &Path) -> Command {
    let mut command = Command::new(tool);
    command
        .arg("mutants")
        .current_dir(root())
        // The tool works on a fresh copy of the tree each time; what does not change is compiled
        // once.
        .env("CARGO_TARGET_DIR", root().join("target/mutants/build"))
        // Nobody reads a backtrace of a mutant: without debug information the tests link faster.
        .env("CARGO_PROFILE_DEV_DEBUG", "false")
        .env_remove("CARGO");
    command
}

#[cfg(test)]
mod tests;
