use alloc::format;

use crate::WebType;
use crate::diagnostic::Diagnostic;
use crate::numbers::Numbers;

/// The largest accepted number of angles on an axis, and of pairs of a tilt.
pub(super) const MOST_ANGLES: u16 = 7_201;

/// The numbers between the tilt and the angles.
pub(super) struct Header {
    pub(super) web_type: WebType,
    /// The number of vertical angles.
    pub(super) vertical: usize,
    /// The number of horizontal angles.
    pub(super) horizontal: usize,
    /// What the intensities of the file are multiplied by, above 0.
    pub(super) factor: f32,
    pub(super) ballast: f32,
    /// Luminous flux of all lamps, in lm; `None` for absolute photometry.
    pub(super) lamp_lumens: Option<f32>,
    pub(super) input_watts: f32,
}

impl Header {
    /// Reads them in a file of the edition of `year`.
    pub(super) fn read(numbers: &mut Numbers<'_>, year: u16) -> Result<Self, Diagnostic> {
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
        let factor = factor(numbers, multiplier, ballasts)?;
        let input_watts = numbers.number("the input watts")?;
        Ok(Self {
            web_type,
            vertical,
            horizontal,
            factor,
            ballast,
            // A negative number means absolute photometry: the luminaire was measured as a whole.
            lamp_lumens: (lumens_per_lamp > 0.0).then_some(lamps * lumens_per_lamp),
            input_watts,
        })
    }
}

/// The product of the factors of a file, which must not be 0 or infinite.
fn factor(numbers: &Numbers<'_>, multiplier: f32, ballasts: f32) -> Result<f32, Diagnostic> {
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
    Ok(factor)
}
