use std::path::Path;

use super::Image;
use crate::Diagnostic;

/// An image as it came from a file.
#[derive(Clone, Debug, PartialEq)]
pub struct ImageFile {
    /// The image; every channel is finite and at least 0.
    pub image: Image,
    /// What was repaired, if anything: how many texels were negative.
    pub warning: Option<Diagnostic>,
}

/// The ending of a file's name in lower case; empty without one.
pub(super) fn ending(path: &Path) -> String {
    let ending = path.extension().unwrap_or_default();
    ending.to_string_lossy().to_ascii_lowercase()
}
