//! The one way to run everything: each module is a command of `cargo xtask`.

use std::process::ExitCode;

pub mod conformance;
pub mod exhaustive;

const USAGE: &str = "\
usage: cargo xtask COMMAND

  conformance [DIR]   check the reference vectors (default: testdata/pbrt)
  exhaustive          check all 2^32 octahedral codes
  thin-vectors FROM   remake testdata/pbrt from a full set of vectors
";

/// Runs the command that the program's `arguments` (without its name) ask for.
#[must_use]
pub fn run(arguments: &[String]) -> ExitCode {
    match arguments.split_first() {
        Some((command, rest)) => match command.as_str() {
            "conformance" => conformance::run(rest),
            "exhaustive" => exhaustive::run(rest),
            "thin-vectors" => conformance::thin::run(rest),
            _ => refuse(&format!("no such command: {command}\n\n{USAGE}")),
        },
        None => refuse(USAGE),
    }
}

fn refuse(message: &str) -> ExitCode {
    eprint!("{message}");
    ExitCode::from(2)
}
