//! Measured luminaires: IESNA LM-63 (`.ies`) and EULUMDAT (`.ldt`).

mod axis;
mod eulumdat;
#[cfg(test)]
mod eulumdat_tests;
mod lm63;
mod luminaire;
mod numbers;
#[cfg(test)]
mod tests;
mod tilt;
mod unfolding;
mod web;

pub use eulumdat::parse_eulumdat;
#[cfg(test)]
pub(crate) use eulumdat_tests::good_eulumdat;
pub use lm63::parse_lm63;
pub use luminaire::{Luminaire, LuminaireFormat};
pub use tilt::LampTilt;
pub use web::{CandelaWeb, CandelaWebError, WebType};

use std::path::Path;

use crate::Diagnostic;
use crate::text::read_text;

/// The luminaire that a file describes: EULUMDAT if its name ends in `.ldt`, LM-63 otherwise.
///
/// # Errors
/// When the file cannot be read or is malformed: file, line and what was expected there.
pub fn read_luminaire(path: &Path) -> Result<Luminaire, Diagnostic> {
    parse_luminaire(path, &read_text(path)?)
}

/// As [`read_luminaire`], from the text of the file; `path` says by its ending which format it has, and names it in
/// messages.
///
/// # Errors
/// As [`read_luminaire`].
pub fn parse_luminaire(path: &Path, text: &str) -> Result<Luminaire, Diagnostic> {
    let extension = path.extension().unwrap_or_default();
    if extension.eq_ignore_ascii_case("ldt") {
        parse_eulumdat(path, text)
    } else {
        parse_lm63(path, text)
    }
}
