//! `cargo xtask embedded [--write]`: the core on microcontrollers in an emulator, with a scene in
//! flash: the same bits as on the host, and what they cost.

mod board;
mod elf;
mod firmware;
mod page;
mod report;

use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

use crate::steps::{Outcome, StepResult, Steps, cargo, output, output_within, root};

use board::{BOARDS, Board, Builder};
use elf::Program;
use firmware::{Firmware, Measured};
use report::Report;

/// The programs of `embedded/`: what each may take on each board, in bytes, where a promise was
/// made.
const PROGRAMS: [Firmware; 5] = [
    Firmware {
        name: "tables",
        code: [Some(4 << 10); 2],
    },
    Firmware {
        name: "tree",
        code: [Some(24 << 10); 2],
    },
    Firmware {
        name: "sampler",
        code: [Some(24 << 10); 2],
    },
    Firmware {
        name: "choices",
        code: [None; 2],
    },
    Firmware {
        name: "lights",
        code: [None; 2],
    },
];

/// Bytes of stack that the programs keep to.
const STACK: u32 = 4 << 10;

/// The most time for a program in the emulator. The longest takes some seconds; one that does not
/// come to its end would run forever.
const LIMIT: Duration = Duration::from_secs(300);

/// Adds a step for the host and one for each board. `--write` writes what the first one measured
/// into the README.
pub fn add_steps(steps: &mut Steps, arguments: &[String]) {
    let writes = match arguments {
        [] => false,
        [flag] if flag == "--write" => true,
        _ => {
            steps.run("embedded", || {
                Err("usage: cargo xtask embedded [--write]".into())
            });
            return;
        }
    };
    let mut hosts = Vec::new();
    steps.run("embedded: the host's answers", || {
        or_skipped(host_reports().map(|reports| {
            hosts = reports;
            Outcome::Passed
        }))
    });
    if hosts.is_empty() {
        return;
    }
    let mut measured = Vec::new();
    for board in &BOARDS {
        steps.run(&format!("embedded: {}", board.name), || {
            or_skipped(check(board, &hosts, &mut measured))
        });
    }
    if writes {
        steps.run("embedded: the table of the README", || {
            page::write(&measured)
        });
    }
}

/// A step that lacks the packages of others, which this workspace locks apart, did not run.
fn or_skipped(result: StepResult) -> StepResult {
    match result {
        Err(error) if is_without_registry(&error) => Ok(Outcome::Skipped(
            "packages of others are not on this machine: cargo fetch --manifest-path \
             embedded/Cargo.toml"
                .into(),
        )),
        result => result,
    }
}

/// Whether cargo lacks a package and cannot fetch it.
fn is_without_registry(error: &str) -> bool {
    error.contains("failed to download") || error.contains("offline mode")
}

/// What each program answers on this machine.
fn host_reports() -> Result<Vec<Report>, String> {
    output(&mut build_for_host(&["build", "--release"]))?;
    // The examples of the README.
    output(&mut build_for_host(&["test", "--release", "--doc"]))?;
    let answer = |firmware: &Firmware| {
        let program = folder().join("release").join(firmware.name);
        Report::of(&output(&mut Command::new(program))?)
    };
    PROGRAMS.iter().map(answer).collect()
}

/// A build for this machine, unoptimised: the answers are the same bits, and programs that take
/// milliseconds need not be fast.
fn build_for_host(arguments: &[&str]) -> Command {
    let mut command = build(cargo(arguments));
    command
        .env("CARGO_PROFILE_RELEASE_LTO", "off")
        .env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "0");
    command
}

/// The arguments that every build of the workspace in `embedded/` has.
fn build(mut cargo: Command) -> Command {
    cargo
        .args(["--quiet", "--manifest-path"])
        .arg(root().join("embedded/Cargo.toml"))
        .arg("--target-dir")
        .arg(folder());
    cargo
}

fn folder() -> PathBuf {
    root().join("target/embedded")
}

/// Builds all programs for a board, runs them, and holds them to the host's answers and to their
/// promises.
fn check(
    board: &'static Board,
    hosts: &[Report],
    all: &mut Vec<(&'static Board, Vec<Measured>)>,
) -> StepResult {
    let builder = match Builder::new(board) {
        Ok(builder) => builder,
        Err(reason) => return Ok(Outcome::Skipped(reason)),
    };
    // Bytes of code and stack are those of one compiler.
    println!("    {}", builder.compiler()?);
    output(&mut build(builder.cargo_build()))?;
    let mut measured = Vec::new();
    for (&firmware, host) in PROGRAMS.iter().zip(hosts) {
        let name = firmware.name;
        let path = folder().join(board.target).join("release").join(name);
        let bytes = fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        let program = Program::new(&bytes).map_err(|e| format!("{name}: {e}"))?;
        let report = Report::of(&output_within(LIMIT, &mut builder.emulator(&path))?)?;
        report
            .must_equal(host)
            .map_err(|e| format!("{name}: {e}"))?;
        println!("    {name}: identical bits");
        report.print(board);
        program.print();
        measured.push(Measured {
            firmware,
            report,
            program,
        });
    }
    // Not which one ran as the first: another one may have been skipped.
    let index = BOARDS.iter().position(|b| b.name == board.name);
    let index = index.ok_or("no such board")?;
    let broken: Vec<String> = measured
        .iter()
        .flat_map(|m| broken_promises(m, index))
        .collect();
    all.push((board, measured));
    if broken.is_empty() {
        Ok(Outcome::Passed)
    } else {
        Err(broken.join("; "))
    }
}

fn broken_promises(measured: &Measured, board: usize) -> Vec<String> {
    let Measured {
        firmware,
        report,
        program,
    } = measured;
    let name = firmware.name;
    let mut broken = Vec::new();
    if let Some(code) = firmware.code[board] {
        if program.code > code {
            broken.push(format!(
                "{name}: {} bytes of code, not {code}",
                program.code
            ));
        }
    }
    let stack = report.stack();
    if stack > STACK {
        broken.push(format!("{name}: {stack} bytes of stack, not {STACK}"));
    }
    let doubles = program.doubles();
    if !doubles.is_empty() {
        broken.push(format!("{name}: 64-bit floats: {}", doubles.join(" ")));
    }
    broken
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_fetched_is_not_checked() {
        for missing in [
            "failed to download from `https://index.crates.io/config.json`",
            "As a reminder, you're using offline mode (--offline)",
        ] {
            let outcome = or_skipped(Err(missing.into())).expect("skipped");
            assert!(matches!(outcome, Outcome::Skipped(_)), "{missing}");
        }
        let fault = "tree: 24600 bytes of code, not 24576";
        assert_eq!(or_skipped(Err(fault.into())), Err(fault.into()), "a fault");
        assert_eq!(or_skipped(Ok(Outcome::Passed)), Ok(Outcome::Passed));
    }
}
