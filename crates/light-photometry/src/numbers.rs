use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::diagnostic::{Diagnostic, shown};

/// Reads the numbers of a text across line breaks; each error names the line.
#[derive(Debug)]
pub(super) struct Numbers<'a> {
    words: Vec<(usize, &'a str)>,
    next: usize,
    last_line: usize,
}

impl<'a> Numbers<'a> {
    /// The words of numbered lines, separated by blanks or commas.
    pub(super) fn new(lines: impl Iterator<Item = (usize, &'a str)>) -> Self {
        let mut words = Vec::new();
        let mut last_line = 1;
        for (number, line) in lines {
            last_line = number;
            let is_between = |c: char| c.is_whitespace() || c == ',' || c == '\u{1a}';
            let found = line.split(is_between).filter(|word| !word.is_empty());
            words.extend(found.map(|word| (number, word)));
        }
        Self {
            words,
            next: 0,
            last_line,
        }
    }

    /// The next finite number.
    pub(super) fn number(&mut self, what: &str) -> Result<f32, Diagnostic> {
        let Some(&(line, word)) = self.words.get(self.next) else {
            let message = format!("expected {what}, found the end of the file");
            return Err(Diagnostic::at(self.last_line, message));
        };
        self.next += 1;
        let parsed = word.parse().ok().filter(|number: &f32| number.is_finite());
        parsed.ok_or_else(|| {
            let message = format!("expected {what}, found `{}`", shown(word));
            Diagnostic::at(line, message)
        })
    }

    /// The next number, which must be whole and lie in `[1, most]`.
    pub(super) fn count(&mut self, what: &str, most: u16) -> Result<usize, Diagnostic> {
        let number = self.number(what)?;
        let found = (1..=most).find(|&n| f32::from(n) == number);
        found.map(usize::from).ok_or_else(|| {
            let word = shown(self.last_word());
            self.wrong(format!("expected {what} from 1 to {most}, found `{word}`"))
        })
    }

    /// The next `n` numbers.
    pub(super) fn list(&mut self, n: usize, what: &str) -> Result<Vec<f32>, Diagnostic> {
        (0..n).map(|_| self.number(what)).collect()
    }

    /// Whether the text has ended.
    pub(super) fn is_at_end(&self) -> bool {
        self.next >= self.words.len()
    }

    /// The number read last as the text has it, which may have more digits than an `f32`.
    fn last_word(&self) -> &'a str {
        self.last().map_or("", |&(_, word)| word)
    }

    fn last(&self) -> Option<&(usize, &'a str)> {
        self.words.get(self.next.saturating_sub(1))
    }

    /// A message about the line of the number read last.
    pub(super) fn wrong(&self, message: impl Into<String>) -> Diagnostic {
        let line = self.last().map_or(self.last_line, |&(line, _)| line);
        Diagnostic::at(line, message)
    }
}
