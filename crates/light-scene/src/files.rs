use core::fmt;
use std::path::Path;

use crate::Diagnostic;
use crate::text::read_bytes;

/// The source of files that a scene refers to.
#[derive(Clone, Copy)]
pub struct Files<'a>(&'a dyn Fn(&Path) -> Result<Vec<u8>, Diagnostic>);

impl Files<'static> {
    /// The files of the machine.
    pub const DISK: Self = Self(&read_bytes);

    /// No files: for scenes that must not access the file system.
    pub const NONE: Self = Self(&|path| Err(Diagnostic::file(path, "cannot be read: not allowed")));
}

impl<'a> Files<'a> {
    /// The bytes that a function returns for a path.
    #[must_use]
    pub const fn new(read: &'a dyn Fn(&Path) -> Result<Vec<u8>, Diagnostic>) -> Self {
        Self(read)
    }

    /// The bytes of a file.
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn read(&self, path: &Path) -> Result<Vec<u8>, Diagnostic> {
        (self.0)(path)
    }
}

impl Default for Files<'static> {
    fn default() -> Self {
        Self::DISK
    }
}

impl fmt::Debug for Files<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Files")
    }
}
