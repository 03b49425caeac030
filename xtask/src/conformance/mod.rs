//! Replays numbers that a reference renderer returned and compares them with ours.
//!
//! A folder of vectors holds one `KIND.jsonl` per kind, one JSON object a line. Each kind has a module here with one
//! [`Checker`]; what a checker sees on a line goes into [`Findings`]. Where we differ from the reference on purpose,
//! or where the answer is not determined, the checker names a [`Rule`]: there is no number of allowed failures.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

mod case;
mod exact;
mod findings;
mod kinds;
mod report;
pub mod thin;

pub use case::{Case, Malformed};
pub use findings::{Findings, Rule, Tolerance};
pub use report::Report;

/// Compares the lines of one kind, from the first to the last; later lines may refer to earlier ones.
pub trait Checker {
    /// Looks at one line and notes in `findings` what holds and what does not.
    ///
    /// # Errors
    /// [`Malformed`] if the line lacks a field or holds something unexpected.
    fn check(&mut self, case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed>;
}

/// Checkers without memory are plain functions.
impl<F: FnMut(&Case<'_>, &mut Findings) -> Result<(), Malformed>> Checker for F {
    fn check(&mut self, case: &Case<'_>, findings: &mut Findings) -> Result<(), Malformed> {
        self(case, findings)
    }
}

/// The vectors that live in the project.
#[must_use]
pub fn default_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../testdata/pbrt")
}

/// `cargo xtask conformance [DIR]`.
#[must_use]
pub fn run(arguments: &[String]) -> ExitCode {
    let folder = match arguments {
        [] => default_folder(),
        [folder] => PathBuf::from(folder),
        _ => {
            eprintln!("usage: cargo xtask conformance [DIR]");
            return ExitCode::from(2);
        }
    };
    match check_folder(&folder) {
        Ok(reports) => {
            reports.iter().for_each(|report| print!("{report}"));
            ExitCode::from(u8::from(reports.iter().any(|r| r.failed > 0)))
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::from(2)
        }
    }
}

/// Checks every `KIND.jsonl` in `folder`, in alphabetical order.
///
/// # Errors
/// One line that says why the folder or a file cannot be read.
pub fn check_folder(folder: &Path) -> Result<Vec<Report>, String> {
    let files = vector_files(folder)?;
    files.iter().map(|file| check_file(file)).collect()
}

/// The vector files of `folder`, in alphabetical order, at least one.
fn vector_files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut files: Vec<PathBuf> = entries
        .filter_map(|entry| entry.ok().map(|e| e.path()))
        .filter(|path| path.extension().is_some_and(|e| e == "jsonl"))
        .collect();
    files.sort();
    if files.is_empty() {
        return Err(format!("{}: no .jsonl file in it", folder.display()));
    }
    Ok(files)
}

fn check_file(file: &Path) -> Result<Report, String> {
    let text = fs::read_to_string(file).map_err(|e| format!("{}: {e}", file.display()))?;
    let kind = kind_of(file);
    let mut report = Report::new(&kind);
    let Some(mut checker) = kinds::checker(&kind) else {
        report.unchecked = text.lines().count();
        return Ok(report);
    };
    for (number, line) in text.lines().enumerate() {
        let mut findings = Findings::default();
        let outcome = serde_json::from_str(line)
            .map_err(|e| Malformed(e.to_string()))
            .and_then(|value| checker.check(&Case::new(&value), &mut findings));
        if let Err(Malformed(message)) = outcome {
            findings.fail(format!("malformed: {message}"));
        }
        report.add(number + 1, findings);
    }
    Ok(report)
}

/// The kind of vectors that `file` holds: its name without the ending.
fn kind_of(file: &Path) -> String {
    file.file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}
