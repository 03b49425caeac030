//! `cargo xtask deny`: the dependencies against the policy in `deny.toml`, by `cargo-deny`.

use std::path::Path;
use std::process::Command;

use crate::steps::{Outcome, StepResult, Steps, output, root};
use crate::tools::{Install, cargo_tool};

/// Adds the two steps; the second needs the network.
pub fn add_steps(steps: &mut Steps, install: Install) {
    steps.run("licences, sources and bans of dependencies", || {
        with_tool(install, |tool| {
            check(tool, &["bans", "licenses", "sources"]).map(|()| Outcome::Passed)
        })
    });
    steps.run("advisories on dependencies", || {
        with_tool(install, advisories)
    });
}

/// A missing tool skips a step that may not install it.
fn with_tool(install: Install, step: impl FnOnce(&Path) -> StepResult) -> StepResult {
    match cargo_tool("cargo-deny", install) {
        Ok(tool) => step(&tool),
        Err(reason) if install == Install::Forbidden => Ok(Outcome::Skipped(reason)),
        Err(reason) => Err(reason),
    }
}

fn advisories(tool: &Path) -> StepResult {
    match check(tool, &["advisories"]) {
        Ok(()) => Ok(Outcome::Passed),
        Err(reason) if reason.contains("failed to fetch advisory database") => Ok(
            Outcome::Skipped("the advisory database cannot be fetched".into()),
        ),
        Err(reason) => Err(reason),
    }
}

fn check(tool: &Path, what: &[&str]) -> Result<(), String> {
    let mut command = Command::new(tool);
    command.current_dir(root()).env_remove("CARGO");
    command.args(["--log-level", "error", "check", "--hide-inclusion-graph"]);
    output(command.args(what)).map(|_| ())
}
