//! `cargo xtask`: the checks that every change passes, with the stable toolchain alone.

use crate::arrows;
use crate::circles;
use crate::features::{
    FEATURE_SETS, SOFTWARE_FLOAT_TESTS, SOFTWARE_FLOATS, for_each_set, together,
};
use crate::references;
use crate::steps::{Outcome, StepResult, Steps, cargo, output, run};

/// Who runs `cargo test --workspace`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkspaceTests {
    /// A step.
    Here,
    /// The caller did, before these steps.
    Before,
}

/// Adds the steps: format, lints, tests, documentation, each over every feature set that can make a
/// difference.
pub fn add_steps(steps: &mut Steps, tests: WorkspaceTests) {
    steps.run("format", format);
    steps.run("references", references::check);
    steps.run("arrows between crates", || arrows::arrows(&[]));
    steps.run("circles of imports", circles::check);
    steps.run("lints of the workspace", || {
        lints(&["--workspace", "--all-targets"]).map(|()| Outcome::Passed)
    });
    steps.run("lints of each feature set", || {
        for_each_set(
            |_| true,
            |set| {
                let target = format!("target/lints/{}", set.needs.folder());
                lints(&[&set.arguments()[..], &["--target-dir", &target]].concat())
            },
        )
    });
    if tests == WorkspaceTests::Here {
        steps.run("tests of the workspace", || {
            passes(&["test", "--workspace", "--quiet"])
        });
    }
    steps.run("tests with software floats", software_floats);
    steps.run("documentation", || {
        documents(&["--workspace"])?;
        documents_libraries(&["--all-features"])?;
        documents_libraries(&["--no-default-features", "--features", "libm"])
    });
}

/// The workspaces of their own, which cargo does not know from the root.
const OTHER_WORKSPACES: [&str; 4] = ["embedded", "fuzz", "gpu/ptx", "gpu/wgsl"];

fn format() -> StepResult {
    passes(&["fmt", "--all", "--check"])?;
    let mut others = OTHER_WORKSPACES.iter();
    others.try_fold(Outcome::Passed, |_, folder| {
        let manifest = format!("{folder}/Cargo.toml");
        passes(&["fmt", "--all", "--check", "--manifest-path", &manifest])
    })
}

/// The unit tests of the crates that work without std, and the tests of what they compute by float
/// functions, without std.
fn software_floats() -> StepResult {
    let selection = together(SOFTWARE_FLOATS);
    let mut tree = cargo([
        "tree",
        "--edges",
        "features,normal,dev",
        "--invert",
        "light-math",
    ]);
    if output(tree.args(&selection))?.contains("light-math feature \"std\"") {
        return Err(
            "a test dependency turns on std of light-math: cargo tree --edges features".into(),
        );
    }
    let mut test = cargo(["test", "--quiet", "--lib"]);
    test.args(
        SOFTWARE_FLOAT_TESTS
            .iter()
            .flat_map(|name| ["--test", name]),
    );
    run(test.args(&selection)).map(|()| Outcome::Passed)
}

/// Documents the crates that have feature sets, with the same features each.
fn documents_libraries(features: &[&str]) -> StepResult {
    let packages = FEATURE_SETS
        .iter()
        .flat_map(|set| ["--package", set.package]);
    let selection: Vec<&str> = packages.chain(features.iter().copied()).collect();
    documents(&selection)
}

fn documents(selection: &[&str]) -> StepResult {
    let mut doc = cargo(["doc", "--no-deps", "--quiet"]);
    let doc = doc.args(selection).env("RUSTDOCFLAGS", "-D warnings");
    run(doc).map(|()| Outcome::Passed)
}

fn lints(selection: &[&str]) -> Result<(), String> {
    let mut arguments = [&["clippy", "--quiet"], selection].concat();
    arguments.extend(["--", "-D", "warnings"]);
    run(&mut cargo(arguments))
}

fn passes(arguments: &[&str]) -> StepResult {
    run(&mut cargo(arguments)).map(|()| Outcome::Passed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::steps::root;
    use std::fs::{self, read_to_string};
    use std::path::Path;

    /// The folders below one, itself among them, whose manifest begins a workspace.
    fn workspaces(folder: &Path, found: &mut Vec<String>) {
        let manifest = read_to_string(folder.join("Cargo.toml")).unwrap_or_default();
        if manifest.lines().any(|line| line == "[workspace]") {
            let path = folder.strip_prefix(root()).expect("below the root");
            found.push(path.display().to_string());
        }
        for entry in fs::read_dir(folder).expect("a folder") {
            let entry = entry.expect("an entry");
            let name = entry.file_name();
            let is_source = name != "target" && !name.to_string_lossy().starts_with('.');
            if is_source && entry.file_type().is_ok_and(|kind| kind.is_dir()) {
                workspaces(&entry.path(), found);
            }
        }
    }

    #[test]
    fn every_workspace_is_listed() {
        let mut found = Vec::new();
        workspaces(&root(), &mut found);
        found.retain(|path| !path.is_empty());
        found.sort();
        assert_eq!(found, OTHER_WORKSPACES, "folders with a workspace");
    }
}
