use core::fmt;
use std::io;
use std::path::PathBuf;

/// Why a light-set file was refused: which file, which line, and what was expected there.
#[derive(Debug)]
pub struct LightSetError {
    /// The file.
    pub path: PathBuf,
    /// Line number, from 1; 0 when the file as a whole is meant.
    pub line: usize,
    /// What is wrong.
    pub problem: LightSetProblem,
}

/// What is wrong with a line of a light-set file.
#[derive(Debug)]
#[non_exhaustive]
pub enum LightSetProblem {
    /// The file cannot be read or written.
    Io(io::Error),
    /// The record is neither `tri`, `point` nor `spot`.
    UnknownRecord,
    /// The line has too few or too many fields.
    FieldCount {
        /// How many numbers the record needs.
        expected: usize,
    },
    /// A field is not a finite number.
    BadNumber,
    /// The flag `twosided` is neither 0 nor 1.
    BadFlag,
    /// A radiance or intensity is negative.
    NegativeEmission,
    /// The power is more than a single-precision number holds.
    Power,
    /// The cone is not within 0 and 180 degrees, or its soft edge is wider than the cone.
    BadCone,
    /// A normal is not of unit length.
    NotUnit,
    /// The file has no records.
    Empty,
}

impl fmt::Display for LightSetError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path.display())?;
        if self.line > 0 {
            write!(f, ":{}", self.line)?;
        }
        write!(f, ": {}", self.problem)
    }
}

impl fmt::Display for LightSetProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => write!(f, "{error}"),
            Self::UnknownRecord => f.write_str("expected a record `tri`, `point` or `spot`"),
            Self::FieldCount { expected } => write!(f, "expected {expected} numbers"),
            Self::BadNumber => f.write_str("expected a finite number"),
            Self::BadFlag => f.write_str("expected `twosided` to be 0 or 1"),
            Self::NegativeEmission => {
                f.write_str("expected a radiance or intensity that is not negative")
            }
            Self::Power => f.write_str("expected a light of finite power"),
            Self::BadCone => {
                f.write_str("expected 0 < cone_deg <= 180 and 0 <= delta_deg <= cone_deg")
            }
            Self::NotUnit => f.write_str("expected a normal of unit length"),
            Self::Empty => f.write_str("expected at least one record"),
        }
    }
}

impl core::error::Error for LightSetError {}
