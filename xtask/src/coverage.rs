//! `cargo xtask coverage [CRATE...]`: which lines and regions of the core crates their tests reach,
//! by `cargo-llvm-cov`.

use std::path::PathBuf;
use std::process::Command;

use crate::debian;
use crate::mutants::CRATES;
use crate::steps::{Outcome, StepResult, output, root, run};
use crate::tools::{Install, cargo_tool};
use report::Report;

mod explained;
mod report;

/// What the report leaves out: other crates, and files of tests. What a file holds below
/// `mod tests` is cut off later.
const OTHERS: &str =
    "light-testkit|light-scene|light-sets|light-render|crates/lights/|/tests?/|tests\\.rs";

/// Features that are not on by default and change what the tests run.
const FEATURES: [&str; 4] = [
    "light-bvh/rayon",
    "light-samplers/rayon",
    "light-sources/half",
    "light-sources/rayon",
];

/// Runs the tests of the core crates, or of those named; prints a table of the crates, and what is
/// not reached with the reasons.
///
/// The longer tests of the test kit, which reach more, are left out: what counts is that each
/// crate's own tests reach it.
///
/// # Errors
/// What could not run.
pub fn coverage(names: &[String]) -> StepResult {
    if let Some(name) = names.iter().find(|name| !CRATES.contains(&name.as_str())) {
        return Err(format!("{name} is none of {}", CRATES.join(", ")));
    }
    let is_chosen = |name: &str| names.is_empty() || names.iter().any(|chosen| chosen == name);
    let tool = cargo_tool("cargo-llvm-cov", Install::Allowed)?;
    let llvm = match llvm_tools() {
        Ok(llvm) => llvm,
        Err(reason) => return Ok(Outcome::Skipped(reason)),
    };
    let command = |arguments: &[&str]| {
        let mut command = Command::new(&tool);
        command
            .arg("llvm-cov")
            .args(arguments)
            .current_dir(root())
            .env_remove("CARGO");
        if let Some(folder) = &llvm {
            let programs = folder.join("usr/bin");
            command.env("LD_LIBRARY_PATH", debian::libraries(folder));
            for (variable, program) in
                [("LLVM_COV", "llvm-cov"), ("LLVM_PROFDATA", "llvm-profdata")]
            {
                command.env(variable, programs.join(format!("{program}-{}", major()?)));
            }
        }
        Ok::<_, String>(command)
    };
    // Objects and counts of an earlier run may be of other lines.
    run(&mut command(&["clean", "--workspace"])?)?;
    let mut tests = command(&["--no-report", "--quiet"])?;
    for name in CRATES.into_iter().filter(|name| is_chosen(name)) {
        tests.args(["--package", name]);
        let of_crate = |feature: &&str| feature.split('/').next() == Some(name);
        for feature in FEATURES.into_iter().filter(of_crate) {
            tests.args(["--features", feature]);
        }
    }
    run(&mut tests)?;
    let json = root().join("target/coverage.json");
    let mut export = command(&["report", "--json", "--skip-functions"])?;
    export.args(["--ignore-filename-regex", OTHERS, "--output-path"]);
    output(export.arg(&json))?;
    let text = std::fs::read_to_string(&json).map_err(|e| format!("{}: {e}", json.display()))?;
    let report = Report::from_json(&text, is_chosen)?;
    print!("{report}");
    Ok(Outcome::Passed)
}

/// Debian's LLVM of the compiler's version, where rustup's component `llvm-tools` is not installed.
fn llvm_tools() -> Result<Option<PathBuf>, String> {
    let sysroot = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    let libraries = PathBuf::from(sysroot.trim()).join("lib/rustlib");
    let hosts = std::fs::read_dir(&libraries).map_err(|e| e.to_string())?;
    let has_component = hosts
        .filter_map(Result::ok)
        .any(|host| host.path().join("bin/llvm-cov").is_file());
    if has_component {
        return Ok(None);
    }
    let package = format!("llvm-{}", major()?);
    let folder =
        debian::unpacked("debian-llvm", std::slice::from_ref(&package)).map_err(|reason| {
            format!(
                "no llvm-cov (rustup component add llvm-tools), no {package} from Debian ({reason})"
            )
        })?;
    Ok(Some(folder))
}

/// The major version of the compiler's LLVM.
fn major() -> Result<String, String> {
    let rustc = output(Command::new("rustc").arg("-vV"))?;
    let line = rustc.lines().find_map(|l| l.strip_prefix("LLVM version: "));
    let number = line.and_then(|l| l.split('.').next());
    number
        .map(str::to_owned)
        .ok_or_else(|| "rustc -vV names no LLVM version".to_owned())
}
