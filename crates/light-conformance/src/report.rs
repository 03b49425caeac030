use super::{Findings, Rule};
use std::fmt;

/// How many failures of a kind are printed in full.
const SHOWN: usize = 8;

/// The result of one kind.
#[derive(Debug)]
pub struct Report {
    /// The kind: the file's name without its ending.
    pub kind: String,
    /// Lines on which every comparison that was made holds.
    pub passed: usize,
    /// Lines on which at least one does not.
    pub failed: usize,
    /// Lines that a rule exempts as a whole.
    pub exempt: usize,
    /// Lines of a kind that nobody checks yet.
    pub unchecked: usize,
    /// The rules that were used, each with the number of times.
    pub rules: Vec<(&'static Rule, usize)>,
    /// Line number and message of the first failures.
    pub failures: Vec<(usize, String)>,
}

impl Report {
    pub(super) fn new(kind: &str) -> Self {
        Self {
            kind: kind.to_owned(),
            passed: 0,
            failed: 0,
            exempt: 0,
            unchecked: 0,
            rules: Vec::new(),
            failures: Vec::new(),
        }
    }

    pub(super) fn add(&mut self, line: usize, findings: Findings) {
        for rule in findings.exemptions {
            match self.rules.iter_mut().find(|(known, _)| *known == rule) {
                Some((_, count)) => *count += 1,
                None => self.rules.push((rule, 1)),
            }
        }
        match (findings.failures.is_empty(), findings.holds) {
            (true, 0) => self.exempt += 1,
            (true, _) => self.passed += 1,
            (false, _) => self.failed += 1,
        }
        let room = SHOWN.saturating_sub(self.failures.len());
        let messages = findings.failures.into_iter().take(room);
        self.failures
            .extend(messages.map(|message| (line, message)));
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.unchecked > 0 {
            return writeln!(
                f,
                "{}: no checker yet for its {} lines",
                self.kind, self.unchecked
            );
        }
        write!(
            f,
            "{}: {} passed, {} failed",
            self.kind, self.passed, self.failed
        )?;
        if self.exempt > 0 {
            write!(f, ", {} exempt", self.exempt)?;
        }
        writeln!(f)?;
        for (rule, count) in &self.rules {
            writeln!(f, "  rule {} ({count} times): {}", rule.name, rule.reason)?;
        }
        for (line, message) in &self.failures {
            writeln!(f, "  line {line}: {message}")?;
        }
        Ok(())
    }
}
