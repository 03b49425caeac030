use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use crate::diagnostic::{Diagnostic, shown};

/// Reads a file with one value per line.
pub(super) struct Lines<'a> {
    lines: core::str::Lines<'a>,
    number: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self {
            lines: text.lines(),
            number: 0,
        }
    }

    pub(super) fn words(&mut self, what: &str) -> Result<String, Diagnostic> {
        let Some(line) = self.lines.next() else {
            return Err(self.wrong(format!("expected {what}, found the end of the file")));
        };
        self.number += 1;
        Ok(line.trim().to_owned())
    }

    /// A finite number, with a decimal point or a decimal comma.
    pub(super) fn number(&mut self, what: &str) -> Result<f32, Diagnostic> {
        self.number_as_written(what).map(|(number, _)| number)
    }

    /// A finite number with its words, which may have more digits than an `f32`.
    fn number_as_written(&mut self, what: &str) -> Result<(f32, String), Diagnostic> {
        let words = self.words(what)?;
        let parsed = words.replace(',', ".").parse().ok();
        match parsed.filter(|number: &f32| number.is_finite()) {
            Some(number) => Ok((number, words)),
            None => Err(self.wrong(format!("expected {what}, found `{}`", shown(&words)))),
        }
    }

    /// A whole number from 0 to `most`.
    pub(super) fn count(&mut self, what: &str, most: u16) -> Result<usize, Diagnostic> {
        let (number, words) = self.number_as_written(what)?;
        let found = (0..=most).find(|&n| f32::from(n) == number);
        found.map(usize::from).ok_or_else(|| {
            let words = shown(&words);
            self.wrong(format!("expected {what}, at most {most}, found `{words}`"))
        })
    }

    pub(super) fn list(&mut self, n: usize, what: &str) -> Result<Vec<f32>, Diagnostic> {
        (0..n).map(|_| self.number(what)).collect()
    }

    /// The first of the lines that are left that is not blank.
    pub(super) fn rest(&self) -> Option<usize> {
        let blank = self
            .lines
            .clone()
            .position(|line| !line.trim().is_empty())?;
        Some(self.number + blank + 1)
    }

    /// A message about the line read last.
    pub(super) fn wrong(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic::at(self.number.max(1), message)
    }
}
