//! The digest of what the kernels are made from, in the first line of `kernels.ptx`: so that a text
//! that is behind its sources is seen without the tools that make it again.
//!
//! It is of the tokens that are compiled: another comment, test or item for a host alone asks for
//! no new text.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value;
use sha2::{Digest, Sha256};

use super::options::{WORKSPACE, rust_flags};
use super::tokens::Tokens;
use crate::steps::{cargo, output, root};

/// The package of the kernels.
const KERNELS: &str = "light-ptx-kernels";

/// What stands before the digest.
const MARK: &str = "// Sources: ";

/// The line of a text that is made from the sources as they are now.
///
/// # Errors
/// A manifest or a source that cannot be read.
pub(super) fn line() -> Result<String, String> {
    let digest = Sha256::digest(compiled()?);
    let digits: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    Ok(format!("{MARK}{digits}"))
}

/// That `text` begins with this `line`.
pub(super) fn is_made_of(text: &str, line: &str) -> Result<(), String> {
    if text.lines().next() == Some(line) {
        return Ok(());
    }
    Err(format!(
        "{WORKSPACE}/kernels.ptx is not made from these sources: run `cargo xtask ptx` (on Debian, \
         whose packages it fetches: `apt-get update` before; elsewhere in a container)"
    ))
}

/// The sources, and how they are compiled.
fn compiled() -> Result<String, String> {
    let packages = packages()?;
    let features = features(&packages);
    let read =
        |file: &Path| fs::read_to_string(file).map_err(|e| format!("{}: {e}", file.display()));
    let workspace = root().join(WORKSPACE);
    let profile = profile(&read(&workspace.join("Cargo.toml"))?);
    let lock = read(&workspace.join("Cargo.lock"))?;
    let mut text = format!("{}\n{profile}\n", rust_flags());
    for package in &packages {
        let targets = package["targets"].as_array().into_iter().flatten();
        let kinds = ["lib", "cdylib"];
        let mut libraries = targets.filter(|t| kinds.iter().any(|kind| t["kind"][0] == *kind));
        let library = libraries.next().and_then(|t| t["src_path"].as_str());
        let library = library.ok_or_else(|| format!("{}: no library", name(package)))?;
        let tokens = Tokens::of_crate(Path::new(library), &features)?;
        text += &format!("{}{}\n", name(package), tokens.text);
        let foreign = dependencies(package).filter(|d| d["path"].is_null());
        // An optional one is on by the feature of its name.
        for foreign in foreign.filter(|d| d["optional"] == false || features.contains(name(d))) {
            let name = name(foreign);
            let version = version(&lock, name);
            text += &format!("{name} {version} {}\n", foreign["features"]);
        }
    }
    Ok(text)
}

/// The packages of this project that the kernels are made from: theirs, and what these need.
fn packages() -> Result<Vec<Value>, String> {
    let manifests = [WORKSPACE, "."].map(|folder| root().join(folder).join("Cargo.toml"));
    let mut all = Vec::new();
    for manifest in &manifests {
        let mut metadata = cargo(["metadata", "--quiet", "--no-deps", "--format-version=1"]);
        let metadata = output(metadata.arg("--manifest-path").arg(manifest))?;
        let mut metadata: Value = serde_json::from_str(&metadata).map_err(|e| e.to_string())?;
        let packages = metadata["packages"].as_array_mut();
        all.append(packages.ok_or("cargo lists no packages")?);
    }
    let mut names = vec![KERNELS.to_owned()];
    let mut found = Vec::new();
    while let Some(next) = names.get(found.len()) {
        let package = all.iter().find(|package| name(package) == next);
        let package = package.ok_or_else(|| format!("no package {next}"))?;
        let always = dependencies(package).filter(|d| d["optional"] == false);
        for ours in always.filter(|d| !d["path"].is_null()) {
            let name = name(ours).to_owned();
            if !names.contains(&name) {
                names.push(name);
            }
        }
        found.push(package.clone());
    }
    Ok(found)
}

/// The features that are asked of the packages, and those that these ask for.
fn features(packages: &[Value]) -> BTreeSet<String> {
    let strings = |list: &Value| -> Vec<String> {
        let list = list.as_array().into_iter().flatten();
        list.filter_map(|item| item.as_str().map(str::to_owned))
            .collect()
    };
    let ours = packages.iter().flat_map(dependencies);
    let ours = ours.filter(|dependency| !dependency["path"].is_null());
    let mut waiting: Vec<String> = ours.flat_map(|d| strings(&d["features"])).collect();
    let mut features = BTreeSet::new();
    while let Some(feature) = waiting.pop() {
        let implied = packages.iter().map(|p| strings(&p["features"][&feature]));
        // As in `dep:name`, `name`, `package/name` and `package?/name`.
        let implied = implied.flatten().filter(|other| !other.starts_with("dep:"));
        let names = implied.filter_map(|other| other.split('/').next_back().map(str::to_owned));
        let names: Vec<String> = names.collect();
        if features.insert(feature) {
            waiting.extend(names);
        }
    }
    features
}

/// The dependencies of a package, without those of its tests and build scripts.
fn dependencies(package: &Value) -> impl Iterator<Item = &Value> {
    let all = package["dependencies"].as_array().into_iter().flatten();
    // The kind of a normal dependency is null.
    all.filter(|d| d["kind"].is_null())
}

fn name(package: &Value) -> &str {
    package["name"].as_str().unwrap_or_default()
}

/// The version of a package by the text of `Cargo.lock`.
fn version<'a>(lock: &'a str, name: &str) -> &'a str {
    let behind = lock.split_once(&format!("name = \"{name}\"\nversion = \""));
    behind.map_or("", |(_, rest)| rest.split('"').next().unwrap_or_default())
}

/// The lines of the release profile in a manifest.
fn profile(manifest: &str) -> String {
    let lines = manifest.lines().map(str::trim);
    let lines = lines
        .skip_while(|line| *line != "[profile.release]")
        .skip(1);
    let lines = lines.take_while(|line| !line.starts_with('['));
    let lines = lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
    lines.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_packages_of_the_kernels_are_found() {
        let packages = packages().expect("manifests");
        let mut names: Vec<&str> = packages.iter().map(name).collect();
        names.sort_unstable();
        let expected = [
            "light-bounds",
            "light-bvh",
            "light-math",
            KERNELS,
            "light-ptx-queries",
            "light-sources",
        ];
        assert_eq!(names, expected, "as `cargo tree` of the kernels lists them");
        let features = features(&packages);
        let features: Vec<&str> = features.iter().map(String::as_str).collect();
        assert_eq!(features, ["bytemuck", "libm"], "no std, no alloc");
    }

    #[test]
    fn options_and_versions_are_part_of_the_sources() {
        let text = compiled().expect("sources");
        for part in ["opt-level = 3", "-Ctarget-cpu=", "glam 0.", "libm 0."] {
            assert!(text.contains(part), "{part}");
        }
        for host in ["rayon", "serde", "proptest"] {
            assert!(!text.contains(&format!("\n{host} ")), "{host}");
        }
    }

    #[test]
    fn a_text_of_other_sources_is_refused() {
        let line = line().expect("sources");
        assert_eq!(
            is_made_of(&format!("{line}\n.version 6.3\n"), &line),
            Ok(())
        );
        for other in [".version 6.3\n", "", "// Sources: 00\n"] {
            let fault = is_made_of(other, &line).expect_err(other);
            assert!(fault.contains("cargo xtask ptx"), "{fault}");
        }
    }
}
