//! `cargo xtask crates [--write [CRATE...]]`: what each library alone takes to build, written in
//! its README.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use crate::packages::libraries;
use crate::processor_time::children_seconds;
use crate::steps::{Outcome, StepResult, cargo, output, root, run};

/// What encloses the line in each README.
const BEGIN: &str = "<!-- cargo xtask crates -->\n";
const END: &str = "\n<!-- end of crates -->";

/// A set of features: how the README calls it, and the arguments of cargo.
type Features = (&'static str, &'static [&'static str]);

const DEFAULT: Features = ("default features", &[]);
const SOFTWARE_FLOATS: Features = (
    "`libm` alone",
    &["--no-default-features", "--features", "libm"],
);

/// Compares the written counts of dependencies with those of cargo, or measures and writes.
///
/// # Errors
/// A README without a line or with another count, or a crate that does not build.
pub fn crates(arguments: &[String]) -> StepResult {
    let libraries = libraries()?;
    match arguments {
        [] => libraries.iter().try_for_each(|name| compare(name))?,
        [flag, ..] if flag == "--write" && children_seconds().is_none() => {
            return Ok(Outcome::Skipped("build times are read from /proc".into()));
        }
        [flag, names @ ..] if flag == "--write" => libraries
            .iter()
            .filter(|name| names.is_empty() || names.contains(name))
            .try_for_each(|name| write(name))?,
        _ => return Err("usage: cargo xtask crates [--write [CRATE...]]".into()),
    }
    Ok(Outcome::Passed)
}

fn compare(name: &str) -> Result<(), String> {
    let (_, line, _) = parts(name)?;
    for features in sets(name)? {
        let count = dependencies(name, features)?;
        if !line.contains(&count) {
            return Err(format!(
                "{name}: its README does not say \"{count}\"; `cargo xtask crates --write {name}`"
            ));
        }
    }
    Ok(())
}

fn write(name: &str) -> Result<(), String> {
    let (before, _, after) = parts(name)?;
    let mut builds = Vec::new();
    for features in sets(name)? {
        let count = dependencies(name, features)?;
        builds.push(format!("{count}, {:.0} s", build_seconds(name, features)?));
    }
    let line = format!(
        "A clean release build of it alone: {} (processor time, {}).",
        builds.join("; "),
        machine()?
    );
    println!("    {name}: {line}");
    let text = [&before, BEGIN, &line, END, &after].concat();
    fs::write(readme(name), text).map_err(|e| format!("{name}: {e}"))
}

fn readme(name: &str) -> PathBuf {
    root().join("crates").join(name).join("README.md")
}

/// What is before, between and after the marks of a README.
fn parts(name: &str) -> Result<(String, String, String), String> {
    let text = fs::read_to_string(readme(name)).map_err(|e| format!("{name}: {e}"))?;
    let parts = text.split_once(BEGIN).and_then(|(before, rest)| {
        let (line, after) = rest.split_once(END)?;
        Some((before.to_owned(), line.to_owned(), after.to_owned()))
    });
    parts.ok_or_else(|| format!("{name}: no line `{}` in its README", BEGIN.trim_end()))
}

/// The sets of features to measure: software floats only where they are a feature.
fn sets(name: &str) -> Result<Vec<Features>, String> {
    let path = root().join("crates").join(name).join("Cargo.toml");
    let manifest = fs::read_to_string(path).map_err(|e| format!("{name}: {e}"))?;
    let has_libm = manifest.contains("\nlibm = [");
    Ok([DEFAULT, SOFTWARE_FLOATS][..1 + usize::from(has_libm)].to_vec())
}

/// How many crates are built before this one, as the README says it.
fn dependencies(name: &str, (said, arguments): Features) -> Result<String, String> {
    let tree = ["tree", "--quiet", "--edges", "normal", "--prefix", "none"];
    let mut command = cargo(tree);
    command.args(["--no-dedupe", "--package", name]);
    let text = output(command.args(arguments))?;
    let all: BTreeSet<&str> = text.lines().filter(|line| !line.is_empty()).collect();
    let count = all.len().saturating_sub(1);
    let noun = if count == 1 {
        "dependency"
    } else {
        "dependencies"
    };
    Ok(format!("with {said} {count} {noun}"))
}

/// The time that a build takes where nothing is built yet.
fn build_seconds(name: &str, (_, arguments): Features) -> Result<f64, String> {
    let target = root().join("target/alone");
    if target.exists() {
        fs::remove_dir_all(&target).map_err(|e| e.to_string())?;
    }
    let before = children_seconds().unwrap_or_default();
    let mut command = cargo(["build", "--quiet", "--release", "--lib", "--target-dir"]);
    command.arg(&target).args(["--package", name]);
    run(command.args(arguments))?;
    Ok(children_seconds().unwrap_or_default() - before)
}

/// The processor and the compiler.
fn machine() -> Result<String, String> {
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find(|line| line.starts_with("model name"));
    let model = model.and_then(|line| line.split_once(": "));
    let model = model.map_or("unknown processor", |(_, model)| model);
    let version = output(&mut cargo(["--version"]))?;
    let release = version.split(' ').nth(1).unwrap_or_default();
    Ok(format!("{model}, Rust {release}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_readme_has_a_place() {
        for name in libraries().expect("manifests") {
            assert!(parts(&name).is_ok(), "{name}");
        }
    }
}
