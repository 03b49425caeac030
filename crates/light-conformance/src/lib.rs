#![doc = include_str!("../README.md")]

use std::path::{Path, PathBuf};

mod case;
mod checker;
mod comparison;
mod fault_injection;
mod files;
mod findings;
mod kinds;
mod oracle;
mod report;
pub mod self_test;
mod tolerance;

pub use case::{Case, Malformed};
pub use checker::Checker;
use files::VectorFile;
pub use findings::{Findings, Rule};
pub use report::Report;
pub use tolerance::Tolerance;

/// The vectors that live in the project.
#[must_use]
pub fn default_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../testdata/pbrt")
}

/// Checks every vector file in `folder`, in alphabetical order.
///
/// # Errors
/// One line that says why the folder or a file cannot be read.
pub fn check_folder(folder: &Path) -> Result<Vec<Report>, String> {
    let files = files::read_folder(folder)?;
    Ok(files.iter().map(check_file).collect())
}

fn check_file(file: &VectorFile) -> Report {
    let mut report = Report::new(&file.kind);
    let Some(mut checker) = kinds::checker(&file.kind) else {
        report.unchecked = file.text.lines().count();
        return report;
    };
    for (number, line) in file.text.lines().enumerate() {
        let mut findings = Findings::default();
        let outcome = serde_json::from_str(line)
            .map_err(|e| Malformed(e.to_string()))
            .and_then(|value| checker.check(&Case::new(&value), &mut findings));
        if let Err(Malformed(message)) = outcome {
            findings.fail(format!("malformed: {message}"));
        }
        report.add(number + 1, findings);
    }
    report
}
