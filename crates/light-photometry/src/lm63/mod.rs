use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::diagnostic::{Diagnostic, shown};
use super::numbers::Numbers;
use super::{LampTilt, Luminaire, LuminaireFormat, PhotometricWeb, PhotometricWebError, WebType};

/// The largest accepted number of angles on an axis, and of pairs of a tilt.
const MOST_ANGLES: u16 = 7_201;

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

    // Words, up to the line TILT=.
    let mut words = Words {
        keywords: Vec::new(),
    };
    let mut last_line = 1;
    let tilt = loop {
        let Some((number, line)) = lines.next() else {
            let message = "expected a line `TILT=...`, found the end of the file";
            return Err(Diagnostic::at(last_line, message));
        };
        last_line = number;
        match line.trim().strip_prefix("TILT=") {
            Some(tilt) => break tilt.trim(),
            None => words.add(line.trim()),
        }
    };
    let tilt_line = last_line;
    let mut numbers = Numbers::new(lines);
    let tilt = match tilt {
        "NONE" => None,
        "INCLUDE" => Some(read_tilt(&mut numbers)?),
        "" => {
            let message = "expected `TILT=NONE`, `TILT=INCLUDE` or the name of a file";
            return Err(Diagnostic::at(tilt_line, message));
        }
        name => {
            let text = tilt_file(name).map_err(|reason| {
                let message = format!("TILT names `{}`: {reason}", shown(name));
                Diagnostic::at(tilt_line, message)
            })?;
            let tilt = read_tilt(&mut Numbers::new((1..).zip(text.lines())));
            Some(tilt.map_err(|error| error.in_tilt_file(name))?)
        }
    };

    let lamps = numbers.number("the number of lamps")?;
    let lumens_per_lamp = numbers.number("the lumens per lamp")?;
    let multiplier = numbers.number("the candela multiplier")?;
    if !(multiplier > 0.0) {
        return Err(numbers.wrong(format!(
            "expected a multiplier above 0, found `{multiplier}`"
        )));
    }
    let vertical = numbers.count("the number of vertical angles", MOST_ANGLES)?;
    let horizontal = numbers.count("the number of horizontal angles", MOST_ANGLES)?;
    let web_type = match numbers.count("the photometric type", 3)? {
        1 => WebType::C,
        2 => WebType::B,
        _ => WebType::A,
    };
    numbers.count("the units, 1 for feet or 2 for metres,", 2)?;
    numbers.list(3, "a dimension of the luminous opening")?;
    let ballast = numbers.number("the ballast factor")?;
    let ballast_lamp = numbers.number("the ballast-lamp factor or a number for future use")?;
    let ballasts = ballast * if year < 1995 { ballast_lamp } else { 1.0 };
    if !(ballasts > 0.0) {
        return Err(numbers.wrong(format!(
            "expected a ballast factor above 0, found `{ballasts}`"
        )));
    }
    let factor = multiplier * ballasts;
    if !(factor > 0.0 && factor.is_finite()) {
        return Err(numbers.wrong(format!(
            "expected multiplier and ballast factors of a product that is finite and above 0, \
             found {multiplier:e} and {ballasts:e}"
        )));
    }
    let input_watts = numbers.number("the input watts")?;

    let vertical = numbers.list(vertical, "a vertical angle")?;
    let after_vertical = numbers.wrong(PhotometricWebError::Vertical.to_string());
    let horizontal = numbers.list(horizontal, "a horizontal angle")?;
    let after_horizontal = numbers.wrong(PhotometricWebError::Horizontal.to_string());
    let mut candelas = Vec::new();
    for _ in 0..vertical.len() * horizontal.len() {
        let value = factor * numbers.number("an intensity in candela")?;
        if !(value >= 0.0 && value.is_finite()) {
            return Err(numbers.wrong(PhotometricWebError::Candelas.to_string()));
        }
        candelas.push(value);
    }
    let web = PhotometricWeb::new(web_type, &vertical, &horizontal, &candelas);
    let web = web.map_err(|error| match error {
        PhotometricWebError::Vertical => after_vertical,
        PhotometricWebError::Horizontal => after_horizontal,
        PhotometricWebError::Candelas => numbers.wrong(error.to_string()),
    })?;

    let mut luminaire = Luminaire {
        format: LuminaireFormat::Lm63(year),
        keywords: words.keywords,
        // A negative number means absolute photometry: the luminaire was measured as a whole.
        lamp_lumens: (lumens_per_lamp > 0.0).then_some(lamps * lumens_per_lamp),
        web,
        input_watts,
        tilt,
        warnings: Vec::new(),
    };
    if !numbers.is_at_end() {
        let message = "what follows the last intensity was ignored";
        luminaire.warnings.push(numbers.wrong(message));
    }
    if let (Some(lamps), Some(part)) = (luminaire.lamp_lumens, luminaire.efficiency()) {
        if part > 1.03 * ballast.max(1.0) {
            let lumens = luminaire.web.total_lumens();
            let message =
                format!("gives off {lumens:.0} lm, more than the {lamps:.0} lm of its lamps");
            luminaire.warnings.push(Diagnostic::whole(message));
        }
    }
    Ok(luminaire)
}

/// The year of the edition that a first line names; `None` if the line is something else, as in
/// files of 1986.
fn edition(line: &str) -> Option<u16> {
    if line == "IESNA91" {
        return Some(1991);
    }
    let (_, year) = line
        .split_once("LM-63-")
        .filter(|_| line.starts_with("IES"))?;
    match year.trim() {
        "86" | "1986" => Some(1986),
        "91" | "1991" => Some(1991),
        "95" | "1995" => Some(1995),
        "02" | "2002" => Some(2002),
        "19" | "2019" => Some(2019),
        // A later edition is read as the last known one.
        _ => Some(2019),
    }
}

/// The factors of a tilted lamp, after `TILT=INCLUDE` or in a separate file.
fn read_tilt(numbers: &mut Numbers<'_>) -> Result<LampTilt, Diagnostic> {
    numbers.count("the lamp-to-luminaire geometry", 3)?;
    let n = numbers.count("the number of tilt angles", MOST_ANGLES)?;
    let angles = numbers.list(n, "a tilt angle")?;
    let factors = numbers.list(n, "a tilt factor")?;
    LampTilt::new(angles, factors).ok_or_else(|| numbers.wrong("expected ascending tilt angles"))
}

struct Words {
    keywords: Vec<(String, String)>,
}

impl Words {
    /// Adds a line: `[KEYWORD] words`, the same with `MORE` for what continues the line before, or
    /// words alone.
    fn add(&mut self, line: &str) {
        let bracketed = line.strip_prefix('[').and_then(|rest| rest.split_once(']'));
        let (keyword, words) = bracketed.unwrap_or(("", line));
        let words = words.trim();
        match (keyword, self.keywords.last_mut()) {
            ("MORE", Some((_, before))) => {
                before.push(' ');
                before.push_str(words);
            }
            ("", _) if words.is_empty() => {}
            _ => self.keywords.push((keyword.to_owned(), words.to_owned())),
        }
    }
}
