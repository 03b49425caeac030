use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use super::{Diagnostic, LampTilt, PhotometricWeb};

/// A measured luminaire.
#[derive(Clone, Debug, PartialEq)]
pub struct Luminaire {
    /// The format of its file.
    pub format: LuminaireFormat,
    /// The texts of the file in their order, by LM-63 keyword or by name of the EULUMDAT line.
    pub keywords: Vec<(String, String)>,
    /// The intensity by direction, in candela, with all factors of the file.
    pub web: PhotometricWeb,
    /// Luminous flux of its bare lamps, in lm; `None` for absolute photometry.
    pub lamp_lumens: Option<f32>,
    /// Electric power, in W.
    pub input_watts: f32,
    /// The change of output with tilt; `None` if there is none.
    pub tilt: Option<LampTilt>,
    /// Warnings about the file.
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
    /// Luminous flux of the luminaire over that of its bare lamps; `None` if the latter is unknown.
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
