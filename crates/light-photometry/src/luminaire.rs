use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use super::{Diagnostic, LampTilt, PhotometricWeb};

/// A measured luminaire.
#[derive(Clone, Debug, PartialEq)]
pub struct Luminaire {
    /// The format of its file.
    pub format: LuminaireFormat,
    /// What the file says in words, in its order: names of LM-63's keywords, or of EULUMDAT's
    /// lines, and the words.
    pub keywords: Vec<(String, String)>,
    /// The intensity by direction, in candela, with all factors of the file.
    pub web: PhotometricWeb,
    /// What its bare lamps give off, in lm; none where the file was measured without asking for
    /// them.
    pub lamp_lumens: Option<f32>,
    /// What it draws, in W.
    pub input_watts: f32,
    /// How its lamps mind being tilted; none if they do not.
    pub tilt: Option<LampTilt>,
    /// What is odd in the file.
    pub warnings: Vec<Diagnostic>,
}

/// A format of photometric files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LuminaireFormat {
    /// IESNA LM-63, of the edition of the given year.
    Lm63(u16),
    /// EULUMDAT.
    Eulumdat,
}

impl Luminaire {
    /// What the luminaire gives off, in lm, of what its bare lamps do; none where the file does not
    /// say.
    #[must_use]
    pub fn efficiency(&self) -> Option<f32> {
        let lamps = self.lamp_lumens.filter(|&lumens| lumens > 0.0)?;
        Some(self.web.total_lumens() / lamps)
    }
}

impl fmt::Display for LuminaireFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lm63(year) => write!(f, "IESNA LM-63-{year}"),
            Self::Eulumdat => f.write_str("EULUMDAT"),
        }
    }
}
