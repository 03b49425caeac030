use core::fmt::{self, Write};
use std::path::{Path, PathBuf};

/// An error or a warning of a reader, with its location in a file.
///
/// Its display is one line: `path:line: message` or `path: byte N: message`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file.
    pub path: PathBuf,
    /// Location in the file.
    pub location: Location,
    /// What was expected, and what was found.
    pub message: String,
}

/// A location in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Location {
    /// The file as a whole.
    File,
    /// A line of a text file; the first is 1.
    Line(usize),
    /// A byte of a binary file; the first is 0.
    Byte(usize),
}

impl Diagnostic {
    /// A message about the file as a whole.
    #[must_use]
    pub fn file(path: &Path, message: impl Into<String>) -> Self {
        Self::at(path, Location::File, message)
    }

    /// A message about one location in the file.
    #[must_use]
    pub fn at(path: &Path, location: Location, message: impl Into<String>) -> Self {
        Self {
            path: path.to_path_buf(),
            location,
            message: message.into(),
        }
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = self.path.display();
        match self.location {
            Location::File => write!(f, "{path}: ")?,
            Location::Line(line) => write!(f, "{path}:{line}: ")?,
            Location::Byte(byte) => write!(f, "{path}: byte {byte}: ")?,
        }
        // Names from files, and messages of decoders, may contain control characters.
        let printable = |c: char| if c.is_control() { '?' } else { c };
        self.message
            .chars()
            .map(printable)
            .try_for_each(|c| f.write_char(c))
    }
}

impl core::error::Error for Diagnostic {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shows_one_line() {
        let path = Path::new("a/b.obj");
        let shown = |location| Diagnostic::at(path, location, "expected a number").to_string();
        assert_eq!(shown(Location::File), "a/b.obj: expected a number", "file");
        assert_eq!(
            shown(Location::Line(7)),
            "a/b.obj:7: expected a number",
            "line"
        );
        assert_eq!(
            shown(Location::Byte(9)),
            "a/b.obj: byte 9: expected a number",
            "byte"
        );
        let odd = Diagnostic::file(path, "found channels B, \n, R").to_string();
        assert_eq!(
            odd, "a/b.obj: found channels B, ?, R",
            "one line whatever is named"
        );
    }
}
