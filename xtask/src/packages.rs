//! The libraries as packages: each holds its licences and compiles from what it holds, against the
//! packages of the others.

use std::fs;
use std::io;
use std::process::Command;

use serde_json::Value;

use crate::steps::{Outcome, StepResult, Steps, cargo, is_there, output, root};

/// What each package holds beside its code.
const LICENCES: [&str; 2] = ["LICENSE-APACHE", "LICENSE-MIT"];

/// Those that take long to compile: their packages are made, and the tests build their code.
const SLOW: [&str; 2] = ["light-render", "light-scene"];

/// The first release of cargo that checks packages of a workspace against each other.
const CARGO_MINOR: u32 = 90;

/// Adds the one step.
pub fn add_steps(steps: &mut Steps) {
    steps.run("packages of the libraries", packages);
}

/// The libraries, in alphabetical order: what the manifests let be published.
///
/// # Errors
/// When cargo cannot read the manifests.
pub fn libraries() -> Result<Vec<String>, String> {
    let metadata = ["metadata", "--quiet", "--no-deps", "--format-version=1"];
    let metadata: Value =
        serde_json::from_str(&output(&mut cargo(metadata))?).map_err(|e| e.to_string())?;
    let packages = metadata["packages"].as_array().into_iter().flatten();
    let public = packages.filter(|package| package["publish"].is_null());
    let names = public.filter_map(|package| package["name"].as_str());
    let mut names: Vec<String> = names.map(str::to_owned).collect();
    names.sort();
    Ok(names)
}

fn packages() -> StepResult {
    let libraries = libraries()?;
    for name in &libraries {
        holds_its_licences(name)?;
    }
    if cargo_minor()? < CARGO_MINOR {
        return Ok(Outcome::Skipped(format!(
            "packages are checked against each other by cargo 1.{CARGO_MINOR} and later"
        )));
    }
    let (slow, quick): (Vec<_>, Vec<_>) = libraries
        .iter()
        .map(String::as_str)
        .partition(|name| SLOW.contains(name));
    if !is_there("tar") {
        return Ok(Outcome::Skipped("no tar to unpack them".into()));
    }
    match package(&[&quick[..], &slow[..]].concat()).and_then(|()| check_packages(&quick)) {
        Ok(()) => Ok(Outcome::Passed),
        Err(error) if is_without_registry(&error) => Ok(Outcome::Skipped(
            "the packages of others are not on this machine: cargo fetch".into(),
        )),
        Err(error) => Err(error),
    }
}

/// Makes packages; cargo resolves the dependencies of each among the others.
fn package(names: &[&str]) -> Result<(), String> {
    let mut command = cargo(["package", "--offline", "--allow-dirty", "--quiet"]);
    command.arg("--no-verify");
    output(command.args(names.iter().flat_map(|&name| ["--package", name]))).map(|_| ())
}

/// Compiles packages from what is in them, as far as errors show. Not by cargo's own check, which a
/// second time takes what it unpacked the first time.
fn check_packages(names: &[&str]) -> Result<(), String> {
    let folder = root().join("target/packages");
    let failed = |e: io::Error| format!("{}: {e}", folder.display());
    if folder.exists() {
        fs::remove_dir_all(&folder).map_err(failed)?;
    }
    fs::create_dir_all(&folder).map_err(failed)?;
    let mut manifest = String::from(
        "[workspace]\nresolver = \"3\"\nmembers = [\"light*\"]\n\n[patch.crates-io]\n",
    );
    for name in names {
        let unpacked = format!("{name}-{}", env!("CARGO_PKG_VERSION"));
        let archive = root().join(format!("target/package/{unpacked}.crate"));
        // Times of now: those in a package are all the same, and cargo would take the last build.
        let mut tar = Command::new("tar");
        output(tar.arg("-xzmf").arg(archive).arg("-C").arg(&folder))?;
        manifest += &format!("{name} = {{ path = \"{unpacked}\" }}\n");
    }
    fs::write(folder.join("Cargo.toml"), manifest).map_err(failed)?;
    fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).map_err(failed)?;
    let mut check = cargo(["check", "--offline", "--quiet", "--workspace"]);
    check
        .arg("--target-dir")
        .arg(root().join("target/packages-build"));
    output(check.current_dir(&folder)).map(|_| ())
}

/// Whether cargo lacks the package of somebody else; our own are never fetched.
fn is_without_registry(error: &str) -> bool {
    error.contains("offline mode") && !error.contains("named `light")
}

/// Links do not survive a checkout on every platform: the licences are copies, the same everywhere.
fn holds_its_licences(name: &str) -> Result<(), String> {
    let list = ["package", "--list", "--allow-dirty", "--offline", "--quiet"];
    let listed = output(cargo(list).args(["--package", name]))?;
    for file in LICENCES {
        if !listed.lines().any(|line| line == file) {
            return Err(format!("{name}: its package holds no {file}"));
        }
        let read = |path: String| fs::read(root().join(&path)).map_err(|e| format!("{path}: {e}"));
        if read(format!("crates/{name}/{file}"))? != read(file.to_owned())? {
            return Err(format!("crates/{name}/{file} is not the project's {file}"));
        }
    }
    Ok(())
}

/// The `y` of `cargo 1.y.z`.
fn cargo_minor() -> Result<u32, String> {
    let version = output(&mut cargo(["--version"]))?;
    let minor = version.split('.').nth(1).and_then(|y| y.parse().ok());
    minor.ok_or_else(|| format!("not understood: {version}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_tools_are_no_libraries() {
        let libraries = libraries().expect("manifests");
        for name in ["light-math", "lights", "light-render"] {
            assert!(libraries.iter().any(|l| l == name), "{name} is one");
        }
        for name in ["light-testkit", "xtask", "benches", "light-conformance"] {
            assert!(libraries.iter().all(|l| l != name), "{name} is none");
        }
    }

    #[test]
    fn only_packages_of_others_can_be_missing() {
        let error = |name| format!("no matching package named `{name}` found; in offline mode");
        assert!(is_without_registry(&error("glam")), "of others");
        assert!(!is_without_registry(&error("light-math")), "our own");
        let fails = "cargo package --offline: could not compile";
        assert!(!is_without_registry(fails), "another fault");
    }
}
