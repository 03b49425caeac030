use std::path::Path;

use super::parameters::Parameters;
use crate::{Diagnostic, Location};

/// The location of a directive: file and line.
#[derive(Clone, Copy, Debug)]
pub(super) struct FileLoc<'a> {
    pub(super) path: &'a Path,
    pub(super) line: usize,
}

impl FileLoc<'_> {
    pub(super) fn diagnostic(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic::at(self.path, Location::Line(self.line), message)
    }

    /// The error of a directive whose opening counterpart is missing.
    pub(super) fn unmatched(&self, before: &str) -> Diagnostic {
        self.diagnostic(format!("expected `{before}` before"))
    }
}

/// The directive that a parameter list belongs to, its type in quotes read already.
#[derive(Debug)]
pub(super) struct Typed<'a> {
    pub(super) at: FileLoc<'a>,
    pub(super) kind: String,
    pub(super) parameters: Parameters,
}
