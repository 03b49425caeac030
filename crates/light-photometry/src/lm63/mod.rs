//! LM-63 files.

mod edition;
mod header;
mod intensities;
mod keywords;
mod tilt_line;

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use self::edition::edition;
use self::header::Header;
use self::intensities::read_web;
use self::keywords::read_keywords;
use crate::diagnostic::Diagnostic;
use crate::numbers::Numbers;
use crate::{Luminaire, LuminaireFormat};

/// The luminaire in the text of an LM-63 file, of any edition from 1986 to 2019.
///
/// Where `TILT=` names a file, `tilt_file` gets that name and returns the text of the file, or why
/// there is none, as in `cannot be read`: this crate reads no files.
///
/// # Errors
/// When the text is malformed, or `tilt_file` fails: the line and what was expected there.
///
/// # Source
/// `[LM63]`. The ballast-lamp photometric factor exists in the editions of 1986 and 1991; later
/// editions use the field otherwise.
pub fn parse_lm63(
    text: &str,
    tilt_file: impl FnOnce(&str) -> Result<String, String>,
) -> Result<Luminaire, Diagnostic> {
    let mut lines = (1..).zip(text.lines()).peekable();
    let first = lines.peek().map_or("", |&(_, line)| line.trim());
    let year = edition(first);
    if year.is_some() {
        lines.next();
    }
    let year = year.unwrap_or(1986);
    let (keywords, tilt_line) = read_keywords(&mut lines)?;
    let mut numbers = Numbers::new(lines);
    let tilt = tilt_line.read(&mut numbers, tilt_file)?;
    let header = Header::read(&mut numbers, year)?;
    let web = read_web(&mut numbers, &header)?;

    let mut luminaire = Luminaire {
        format: LuminaireFormat::Lm63(year),
        keywords,
        lamp_lumens: header.lamp_lumens,
        web,
        input_watts: header.input_watts,
        tilt,
        warnings: Vec::new(),
    };
    if !numbers.is_at_end() {
        let message = "what follows the last intensity was ignored";
        luminaire.warnings.push(numbers.wrong(message));
    }
    let doubt = doubt_of_lumens(&luminaire, header.ballast);
    luminaire.warnings.extend(doubt);
    Ok(luminaire)
}

/// What is said of a luminaire that gives off more light than its lamps have.
fn doubt_of_lumens(luminaire: &Luminaire, ballast: f32) -> Option<Diagnostic> {
    let (lamps, part) = luminaire.lamp_lumens.zip(luminaire.efficiency())?;
    if !(part > 1.03 * ballast.max(1.0)) {
        return None;
    }
    let lumens = luminaire.web.total_lumens();
    let message = format!("gives off {lumens:.0} lm, more than the {lamps:.0} lm of its lamps");
    Some(Diagnostic::whole(message))
}
