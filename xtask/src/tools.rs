//! Cargo's extensions that some steps need: found, or installed into the target folder.

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::steps::{output, root, run};

/// Whether a missing tool is built from the registry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Install {
    /// It is installed into `target/tools`: a few minutes, once.
    Allowed,
    /// It counts as missing.
    Forbidden,
}

/// The program `name`: on the path, or in `target/tools`, or installed there.
///
/// # Errors
/// A line that names the tool and the command that installs it.
pub fn cargo_tool(name: &str, install: Install) -> Result<PathBuf, String> {
    let ours = root().join("target/tools/bin").join(name);
    for tool in [PathBuf::from(name), ours.clone()] {
        if answers(&tool, name) {
            return Ok(tool);
        }
    }
    if install == Install::Forbidden {
        return Err(format!(
            "no {name} (cargo install {name} --locked --root target/tools)"
        ));
    }
    println!("    installing {name} into target/tools");
    let mut build = Command::new("cargo");
    build.args(["install", name, "--locked", "--quiet", "--root"]);
    run(build.arg(root().join("target/tools")))?;
    Ok(ours)
}

/// Whether the program runs. Some of cargo's extensions want their own name first, as cargo passes
/// it.
fn answers(tool: &Path, name: &str) -> bool {
    let subcommand = name.trim_start_matches("cargo-");
    let asks: [&[&str]; 2] = [&["--version"], &[subcommand, "--version"]];
    asks.iter()
        .any(|ask| output(Command::new(tool).args(*ask)).is_ok())
}
