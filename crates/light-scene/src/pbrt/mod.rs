//! pbrt-v4 scene files.

mod directives;
mod lights;
mod materials;
mod parameters;
mod ply;
mod shapes;
mod spectrum;
mod state;
mod textures;
mod tokens;

use std::path::Path;

use crate::text::read_text;
use crate::{Diagnostic, Scene};

use state::Reader;

/// Reads a pbrt-v4 file and what it includes.
///
/// What is understood stands in the crate's documentation; everything else is named once in a warning. Coordinates stay
/// as written; the camera keeps pbrt's left-handed view.
///
/// # Errors
/// When a file cannot be read, is no pbrt file, or a directive lacks what it needs: with file, line and what was
/// expected.
pub fn read_pbrt(path: &Path) -> Result<Scene, Diagnostic> {
    let text = read_text(path)?;
    let mut reader = Reader::default();
    reader.file(path, &text, 0)?;
    reader.finish(path)
}

#[cfg(test)]
mod tests;
