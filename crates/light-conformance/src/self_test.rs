//! Checks the checks: changes one answer of ours at a time and demands that the comparison fails.

use super::fault_injection::Change;
use super::files::{VectorFile, read_folder};
use super::{Case, Checker, Findings, kinds};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use std::thread;

/// How many lines and answers are tried.
#[derive(Clone, Copy, Debug)]
pub struct Selection {
    /// Every how many lines.
    pub line_stride: usize,
    /// At most so many answers a line, evenly spread.
    pub answers: usize,
}

impl Selection {
    /// All answers of all lines.
    pub const ALL: Self = Self {
        line_stride: 1,
        answers: usize::MAX,
    };

    /// A part that takes seconds.
    pub const THIN: Self = Self {
        line_stride: 7,
        answers: 40,
    };
}

/// How many changed answers were found out.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    changed: [usize; 4],
    detected: [usize; 4],
    /// Of which the truth is within a wide range, or none as well as some, as rounding falls.
    undetermined: usize,
    /// The changed answers that passed: the line, and what was changed.
    missed: Vec<(usize, String)>,
}

impl Tally {
    /// Every change was found out, and there was one.
    fn is_complete(&self) -> bool {
        self.missed.is_empty() && self.changed.iter().any(|&changed| changed > 0)
    }

    fn add(&mut self, change: Change, line: usize, findings: &Findings) {
        let i = change as usize;
        let is_detected = !findings.failures.is_empty();
        if !is_detected && findings.faults.is_undetermined {
            self.undetermined += 1;
            return;
        }
        self.changed[i] += 1;
        self.detected[i] += usize::from(is_detected);
        if !is_detected {
            self.missed.push((line, findings.faults.change.clone()));
        }
    }
}

/// One row for each kind, what its line is about, and each of its answers.
#[derive(Clone, Debug, Default)]
pub struct Table {
    rows: BTreeMap<[String; 3], Tally>,
}

impl Table {
    /// Whether every change of every answer was detected.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        !self.rows.is_empty() && self.rows.values().all(Tally::is_complete)
    }
}

/// Runs the self-test on the vectors of `folder`.
///
/// # Errors
/// One line that says why the folder or a file cannot be read, or that a line fails before anything
/// is changed.
pub fn run_folder(folder: &Path, selection: &Selection) -> Result<Table, String> {
    let files = read_folder(folder)?;
    let mut table = Table::default();
    thread::scope(|scope| {
        let tests: Vec<_> = files
            .iter()
            .map(|file| scope.spawn(move || run_file(file, selection)))
            .collect();
        for test in tests {
            let rows = test.join().map_err(|_| "a checker panics".to_owned())??;
            table.rows.extend(rows.rows);
        }
        Ok(table)
    })
}

fn run_file(file: &VectorFile, selection: &Selection) -> Result<Table, String> {
    let mut table = Table::default();
    let Some(mut checker) = kinds::checker(&file.kind) else {
        return Ok(table);
    };
    for (index, line) in file.text.lines().enumerate() {
        let number = index + 1;
        let value: Value = serde_json::from_str(line).map_err(|e| e.to_string())?;
        let names = run_line(&mut *checker, &value, None);
        if !names.failures.is_empty() {
            return Err(format!(
                "{} line {number} fails as it is: {}",
                file.kind, names.failures[0]
            ));
        }
        // Lines that others refer to are seen once.
        if index % selection.line_stride != 0 || value["kind"] == "set" || value["kind"] == "header"
        {
            continue;
        }
        let names = names.faults.names;
        let about = about(&value);
        let stride = names.len().div_ceil(selection.answers).max(1);
        for target in (index % stride..names.len()).step_by(stride) {
            for change in Change::ALL {
                let findings = run_line(&mut *checker, &value, Some((target, change)));
                if findings.faults.is_done {
                    let key = [file.kind.clone(), about.clone(), names[target].to_owned()];
                    table
                        .rows
                        .entry(key)
                        .or_default()
                        .add(change, number, &findings);
                }
            }
        }
    }
    Ok(table)
}

fn run_line(checker: &mut dyn Checker, value: &Value, target: Option<(usize, Change)>) -> Findings {
    let mut findings = Findings::default();
    findings.faults.target = target;
    if let Err(malformed) = checker.check(&Case::new(value), &mut findings) {
        findings.fail(malformed.0);
    }
    findings
}

/// What a line is about: the type of light, the operation, or the sampler.
fn about(value: &Value) -> String {
    let field = |name: &str| value.get(name).and_then(Value::as_str);
    let about = ["type", "op", "sampler", "kind"]
        .into_iter()
        .find_map(field);
    about.unwrap_or_default().to_owned()
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "detected of changed answers, by change\n{:<64}{}",
            "kind, about, answer",
            Change::ALL.map(|c| format!("{c:>16?}")).concat()
        )?;
        for (key, tally) in &self.rows {
            write!(f, "{:<64}", key.join(" "))?;
            for i in 0..tally.changed.len() {
                let share = match tally.changed[i] {
                    0 => "-".to_owned(),
                    changed => format!("{}/{changed}", tally.detected[i]),
                };
                write!(f, "{share:>16}")?;
            }
            if tally.undetermined > 0 {
                write!(f, "  {} undetermined", tally.undetermined)?;
            }
            writeln!(f)?;
            for (line, change) in &tally.missed {
                writeln!(f, "  MISSED on line {line}: {change}")?;
            }
        }
        let total = |of: fn(&Tally) -> [usize; 4]| -> usize {
            self.rows
                .values()
                .map(|t| of(t).iter().sum::<usize>())
                .sum()
        };
        writeln!(
            f,
            "{} answers of {} kinds: {} of {} changes detected",
            self.rows.len(),
            kinds_of(self),
            total(|t| t.detected),
            total(|t| t.changed)
        )
    }
}

fn kinds_of(table: &Table) -> usize {
    let mut kinds: Vec<_> = table.rows.keys().map(|key| &key[0]).collect();
    kinds.dedup();
    kinds.len()
}
