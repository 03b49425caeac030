use alloc::borrow::ToOwned;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use alloc::{format, vec};

use super::axis::full_turn;
use super::diagnostic::{Diagnostic, shown};
use super::{Luminaire, LuminaireFormat, PhotometricWeb, PhotometricWebError, WebType};

/// The luminaire in the text of a EULUMDAT file.
///
/// Its planes are of type [`WebType::C`]. Intensities are stated for 1000 lm of lamps and are
/// scaled by those of the first set of lamps; further sets are ignored with a warning.
///
/// # Errors
/// When the text is malformed: the line and what was expected there.
///
/// # Source
/// `[Eulumdat]`.
pub fn parse_eulumdat(text: &str) -> Result<Luminaire, Diagnostic> {
    let mut file = Lines {
        lines: text.lines(),
        number: 0,
    };
    let mut keywords = vec![("manufacturer".to_owned(), file.words("the manufacturer")?)];
    file.words("the type of luminaire")?;
    let symmetry = file.count("the symmetry, 0 to 4", 4)?;
    let planes = file.count("the number of C planes", 721)?;
    file.words("the distance between C planes")?;
    let rows = file.count("the number of intensities in a plane", 721)?;
    file.words("the distance between intensities")?;
    for name in ["report", "luminaire", "number", "file", "date"] {
        keywords.push((name.to_owned(), file.words(name)?));
    }
    for _ in 0..9 {
        file.words("a dimension")?;
    }
    file.words("the downward part of the light")?;
    let output_ratio = file.number("the light output ratio")?;
    let conversion = file.number("the conversion factor")?;
    file.words("the tilt")?;

    // Sets of lamps: number, type, lumens, colour, rendering index, watts.
    let sets = file.count("the number of sets of lamps", 100)?;
    if sets == 0 {
        return Err(file.wrong("expected at least one set of lamps"));
    }
    let (mut lumens, mut input_watts) = (0.0, 0.0);
    for set in 0..sets {
        file.words("the number of lamps")?;
        file.words("the type of lamps")?;
        let set_lumens = file.number("the lumens of the lamps")?;
        if !(set_lumens > 0.0) {
            return Err(file.wrong("expected lamps of more than 0 lm"));
        }
        file.words("the colour of the lamps")?;
        file.words("the colour rendering of the lamps")?;
        let set_watts = file.number("the watts of the lamps")?;
        if set == 0 {
            (lumens, input_watts) = (set_lumens, set_watts);
        }
    }
    for _ in 0..10 {
        file.words("a direct ratio")?;
    }

    let angles = file.list(planes, "a C angle")?;
    let used = used_planes(symmetry, planes).ok_or_else(|| {
        file.wrong(format!(
            "expected a number of C planes that suits the symmetry, found {planes}"
        ))
    })?;
    let after_horizontal = file.wrong(PhotometricWebError::Horizontal.to_string());
    let vertical = file.list(rows, "a gamma angle")?;
    let after_vertical = file.wrong(PhotometricWebError::Vertical.to_string());
    let factor = lumens / 1000.0 * if conversion > 0.0 { conversion } else { 1.0 };
    let mut by_plane = Vec::new();
    for &plane in &used {
        let mut values = Vec::new();
        for _ in 0..rows {
            let value = factor * file.number("an intensity in cd/klm")?;
            if !(value >= 0.0 && value.is_finite()) {
                return Err(file.wrong(PhotometricWebError::Candelas.to_string()));
            }
            values.push(value);
        }
        // Planes from C270 over C0 to C90 are those from 90 to 270, mirrored the other way
        // round.
        let angle = match symmetry {
            1 => 0.0,
            3 => full_turn(180.0 - angles[plane]),
            _ => angles[plane],
        };
        by_plane.push((angle, values));
    }
    if symmetry == 3 {
        by_plane.reverse();
    }
    let horizontal: Vec<f32> = by_plane.iter().map(|plane| plane.0).collect();
    let candelas: Vec<f32> = by_plane.into_iter().flat_map(|plane| plane.1).collect();
    let web = PhotometricWeb::new(WebType::C, &vertical, &horizontal, &candelas);
    let web = web.map_err(|error| match error {
        PhotometricWebError::Vertical => after_vertical,
        PhotometricWebError::Horizontal => after_horizontal,
        PhotometricWebError::Candelas => file.wrong(error.to_string()),
    })?;

    let mut luminaire = Luminaire {
        format: LuminaireFormat::Eulumdat,
        keywords,
        web,
        lamp_lumens: Some(lumens),
        input_watts,
        tilt: None,
        warnings: Vec::new(),
    };
    // As of a file with another number of planes than it has.
    if let Some(blank) = file.lines.clone().position(|line| !line.trim().is_empty()) {
        let message = "what follows the last intensity was ignored";
        let rest = Diagnostic::at(file.number + blank + 1, message);
        luminaire.warnings.push(rest);
    }
    if sets > 1 {
        let message = format!("the {} further sets of lamps were ignored", sets - 1);
        luminaire.warnings.push(Diagnostic::whole(message));
    }
    let stated = 0.01 * output_ratio * lumens;
    let measured = luminaire.web.total_lumens();
    if stated > 0.0 && !((measured / stated - 1.0).abs() <= 0.03) {
        let message =
            format!("gives off {measured:.0} lm, not the {stated:.0} lm of its light output ratio");
        luminaire.warnings.push(Diagnostic::whole(message));
    }
    Ok(luminaire)
}

/// The planes whose intensities a file holds, by index of their angles; `None` where their number
/// does not fit the symmetry. Symmetry 3, to the plane of C90 and C270, holds those from C270 over
/// C0 to C90.
fn used_planes(symmetry: usize, planes: usize) -> Option<Vec<usize>> {
    Some(match symmetry {
        _ if planes == 0 => return None,
        0 => (0..planes).collect(),
        1 => vec![0],
        2 if planes % 2 == 0 => (0..=planes / 2).collect(),
        3 if planes % 4 == 0 => {
            let first = 3 * planes / 4;
            (first..=first + planes / 2)
                .map(|plane| plane % planes)
                .collect()
        }
        4 if planes % 4 == 0 => (0..=planes / 4).collect(),
        _ => return None,
    })
}

/// Reads a file with one value per line.
struct Lines<'a> {
    lines: core::str::Lines<'a>,
    number: usize,
}

impl Lines<'_> {
    fn words(&mut self, what: &str) -> Result<String, Diagnostic> {
        let Some(line) = self.lines.next() else {
            return Err(self.wrong(format!("expected {what}, found the end of the file")));
        };
        self.number += 1;
        Ok(line.trim().to_owned())
    }

    /// A finite number, with a decimal point or a decimal comma.
    fn number(&mut self, what: &str) -> Result<f32, Diagnostic> {
        self.number_as_written(what).map(|(number, _)| number)
    }

    /// A finite number with its words, which may have more digits than an `f32`.
    fn number_as_written(&mut self, what: &str) -> Result<(f32, String), Diagnostic> {
        let words = self.words(what)?;
        let parsed = words.replace(',', ".").parse().ok();
        match parsed.filter(|number: &f32| number.is_finite()) {
            Some(number) => Ok((number, words)),
            None => Err(self.wrong(format!("expected {what}, found `{}`", shown(&words)))),
        }
    }

    /// A whole number from 0 to `most`.
    fn count(&mut self, what: &str, most: u16) -> Result<usize, Diagnostic> {
        let (number, words) = self.number_as_written(what)?;
        let found = (0..=most).find(|&n| f32::from(n) == number);
        found.map(usize::from).ok_or_else(|| {
            let words = shown(&words);
            self.wrong(format!("expected {what}, at most {most}, found `{words}`"))
        })
    }

    fn list(&mut self, n: usize, what: &str) -> Result<Vec<f32>, Diagnostic> {
        (0..n).map(|_| self.number(what)).collect()
    }

    /// A message about the line read last.
    fn wrong(&self, message: impl Into<String>) -> Diagnostic {
        Diagnostic::at(self.number.max(1), message)
    }
}
