use alloc::string::String;
use core::fmt::{self, Write};

/// An error or a warning about a photometric text, with its line.
///
/// Its display is one line: `line 7: expected ...`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file that `TILT=` names, if the message is about that file; otherwise it is about the
    /// text itself.
    pub tilt_file: Option<String>,
    /// The line, counted from 1; `None` for a message about the whole text.
    pub line: Option<usize>,
    /// What was expected, and what was found.
    pub message: String,
}

impl Diagnostic {
    /// A message about one line of the text.
    pub(crate) fn at(line: usize, message: impl Into<String>) -> Self {
        Self {
            tilt_file: None,
            line: Some(line),
            message: message.into(),
        }
    }

    /// A message about the whole text.
    pub(crate) fn whole(message: impl Into<String>) -> Self {
        Self {
            tilt_file: None,
            line: None,
            message: message.into(),
        }
    }

    /// The same message, about the file that `TILT=` names.
    pub(crate) fn in_tilt_file(self, name: &str) -> Self {
        Self {
            tilt_file: Some(name.into()),
            ..self
        }
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.tilt_file {
            print(f, file)?;
            f.write_str(": ")?;
        }
        if let Some(line) = self.line {
            write!(f, "line {line}: ")?;
        }
        print(f, &self.message)
    }
}

/// Names from files may contain control characters, which would break the line.
fn print(f: &mut fmt::Formatter<'_>, text: &str) -> fmt::Result {
    let printable = |c: char| if c.is_control() { '?' } else { c };
    text.chars()
        .map(printable)
        .try_for_each(|c| f.write_char(c))
}

impl core::error::Error for Diagnostic {}

/// A word for a message, shortened if it is long.
pub(crate) fn shown(word: &str) -> String {
    const LONGEST: usize = 40;
    let mut short: String = word.chars().take(LONGEST).collect();
    if word.chars().nth(LONGEST).is_some() {
        short.push_str("...");
    }
    short
}

#[cfg(test)]
mod tests {
    use alloc::string::ToString;

    use super::*;

    #[test]
    fn shows_one_line() {
        let message = Diagnostic::at(7, "expected `a\nb`");
        assert_eq!(message.to_string(), "line 7: expected `a?b`", "a line");
        let message = message.in_tilt_file("b.tlt");
        assert_eq!(
            message.to_string(),
            "b.tlt: line 7: expected `a?b`",
            "a file"
        );
        assert_eq!(Diagnostic::whole("odd").to_string(), "odd", "the text");
    }

    #[test]
    fn long_words_are_cut() {
        assert_eq!(shown(&"x".repeat(50)).len(), 43, "cut");
        assert_eq!(shown("x"), "x", "whole");
    }
}
