use alloc::format;
use alloc::string::String;

use super::header::MOST_ANGLES;
use crate::LampTilt;
use crate::diagnostic::{Diagnostic, shown};
use crate::numbers::Numbers;

/// The line `TILT=`, which ends the keywords.
pub(super) struct TiltLine<'a> {
    /// Its number, counted from 1.
    pub(super) number: usize,
    /// What follows the sign of equality.
    pub(super) tilt: &'a str,
}

impl TiltLine<'_> {
    /// The factors of a tilted lamp: those of the `numbers` that follow, or of the file that the
    /// line names, which `tilt_file` reads.
    pub(super) fn read(
        &self,
        numbers: &mut Numbers<'_>,
        tilt_file: impl FnOnce(&str) -> Result<String, String>,
    ) -> Result<Option<LampTilt>, Diagnostic> {
        match self.tilt {
            "NONE" => Ok(None),
            "INCLUDE" => read_tilt(numbers).map(Some),
            "" => {
                let message = "expected `TILT=NONE`, `TILT=INCLUDE` or the name of a file";
                Err(Diagnostic::at(self.number, message))
            }
            name => {
                let text = tilt_file(name).map_err(|reason| {
                    let message = format!("TILT names `{}`: {reason}", shown(name));
                    Diagnostic::at(self.number, message)
                })?;
                let tilt = read_tilt(&mut Numbers::new((1..).zip(text.lines())));
                tilt.map(Some).map_err(|error| error.in_tilt_file(name))
            }
        }
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
