//! `cargo xtask`: the checks that every change passes, with the stable toolchain alone.

use crate::api;
use crate::arrows;
use crate::circles;
use crate::features::{FEATURE_SETS, for_each_set};
use crate::references;
use crate::software_floats::software_floats;
use crate::steps::{Outcome, StepResult, Steps, cargo, run};

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
        documents_without_std()?;
        // The step of public items makes these pages again, and compiles nothing for them.
        documents(&api::selection())
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

/// Documents the crates that have feature sets, each without std.
fn documents_without_std() -> StepResult {
    let packages = FEATURE_SETS
        .iter()
        .flat_map(|set| ["--package", set.package]);
    let features = ["--no-default-features", "--features", "libm"];
    let selection: Vec<&str> = packages.chain(features).collect();
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

    /// Demands that the `parent` of each file below a folder names it: else nobody compiles it.
    fn assert_each_file_is_a_module(folder: &Path, parent: &str) {
        let text = read_to_string(folder.join(parent)).expect("the file of a module");
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let stem = path.file_stem().expect("a name").to_string_lossy();
            let is_here = path.file_name().is_some_and(|name| name == parent);
            let declares =
                |line: &str| line.trim_end_matches(';').ends_with(&format!("mod {stem}"));
            assert!(
                is_here || text.lines().any(declares),
                "no module is {}",
                path.display()
            );
            if path.is_dir() {
                assert_each_file_is_a_module(&path, "mod.rs");
            }
        }
    }

    #[test]
    fn every_file_of_integration_tests_is_compiled_in_one_program() {
        for entry in fs::read_dir(root().join("crates")).expect("a folder of crates") {
            let tests = entry.expect("an entry").path().join("tests");
            let Ok(targets) = fs::read_dir(&tests) else {
                continue;
            };
            let targets: Vec<_> = targets
                .map(|target| target.expect("an entry").path())
                .collect();
            for target in &targets {
                if target.is_dir() {
                    assert_each_file_is_a_module(target, "main.rs");
                } else if targets.len() > 1 {
                    let says_why = read_to_string(target)
                        .is_ok_and(|text| text.contains("A program of its own"));
                    assert!(says_why, "a module of {}?", target.display());
                }
            }
        }
    }
}
