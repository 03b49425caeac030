//! EULUMDAT files.

mod header;
mod lines;
mod planes;

use alloc::format;

use self::header::Header;
use self::lines::Lines;
use self::planes::read_web;
use crate::diagnostic::Diagnostic;
use crate::{Luminaire, LuminaireFormat, PhotometricWeb};

/// The luminaire in the text of a EULUMDAT file.
///
/// Its planes are of type [`WebType::C`](crate::WebType::C). Intensities are stated for 1000 lm of
/// lamps and are scaled by those of the first set of lamps; further sets are ignored with a warning.
///
/// # Errors
/// When the text is malformed: the line and what was expected there.
///
/// # Source
/// `[Eulumdat]`.
pub fn parse_eulumdat(text: &str) -> Result<Luminaire, Diagnostic> {
    let mut file = Lines::new(text);
    let header = Header::read(&mut file)?;
    let web = read_web(&mut file, &header)?;
    let doubts = doubts(&file, &header, &web);
    Ok(Luminaire {
        format: LuminaireFormat::Eulumdat,
        keywords: header.keywords,
        web,
        lamp_lumens: Some(header.lamps.lumens),
        input_watts: header.lamps.watts,
        tilt: None,
        warnings: doubts.into_iter().flatten().collect(),
    })
}

/// What is said of a luminaire: of what follows its last intensity, of further sets of lamps, and
/// of light that is not what its output ratio makes of the lamps.
fn doubts(file: &Lines<'_>, header: &Header, web: &PhotometricWeb) -> [Option<Diagnostic>; 3] {
    // As of a file with another number of planes than it has.
    let rest = file.rest().map(|line| {
        let message = "what follows the last intensity was ignored";
        Diagnostic::at(line, message)
    });
    let further = header.lamps.sets - 1;
    let sets = (further > 0)
        .then(|| Diagnostic::whole(format!("the {further} further sets of lamps were ignored")));
    let stated = 0.01 * header.output_ratio * header.lamps.lumens;
    let measured = web.total_lumens();
    let is_off = stated > 0.0 && !((measured / stated - 1.0).abs() <= 0.03);
    let output = is_off.then(|| {
        Diagnostic::whole(format!(
            "gives off {measured:.0} lm, not the {stated:.0} lm of its light output ratio"
        ))
    });
    [rest, sets, output]
}
