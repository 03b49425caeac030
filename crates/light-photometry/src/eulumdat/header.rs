use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use super::lines::Lines;
use crate::diagnostic::Diagnostic;

/// The lines before the angles.
pub(super) struct Header {
    /// The words of some lines, by what they are about.
    pub(super) keywords: Vec<(String, String)>,
    /// From 0 for none to 4 for two planes.
    pub(super) symmetry: usize,
    /// The number of C planes.
    pub(super) planes: usize,
    /// The number of intensities in a plane.
    pub(super) rows: usize,
    /// In percent.
    pub(super) output_ratio: f32,
    /// A factor of all intensities, if it is above 0.
    conversion: f32,
    pub(super) lamps: Lamps,
}

/// The lamps of a luminaire.
pub(super) struct Lamps {
    /// The number of sets, at least 1.
    pub(super) sets: usize,
    /// Luminous flux of the first set, in lm, above 0.
    pub(super) lumens: f32,
    /// Electric power of the first set, in W.
    pub(super) watts: f32,
}

impl Header {
    pub(super) fn read(file: &mut Lines<'_>) -> Result<Self, Diagnostic> {
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
        let lamps = Lamps::read(file)?;
        for _ in 0..10 {
            file.words("a direct ratio")?;
        }
        Ok(Self {
            keywords,
            symmetry,
            planes,
            rows,
            output_ratio,
            conversion,
            lamps,
        })
    }

    /// Candelas of an intensity of 1 in the file, which is for 1000 lm of lamps.
    pub(super) fn candelas_per_unit(&self) -> f32 {
        let conversion = self.conversion;
        self.lamps.lumens / 1000.0 * if conversion > 0.0 { conversion } else { 1.0 }
    }
}

impl Lamps {
    /// Reads all sets of lamps: number, type, lumens, colour, rendering index, watts.
    fn read(file: &mut Lines<'_>) -> Result<Self, Diagnostic> {
        let sets = file.count("the number of sets of lamps", 100)?;
        if sets == 0 {
            return Err(file.wrong("expected at least one set of lamps"));
        }
        let (mut lumens, mut watts) = (0.0, 0.0);
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
                (lumens, watts) = (set_lumens, set_watts);
            }
        }
        Ok(Self {
            sets,
            lumens,
            watts,
        })
    }
}
