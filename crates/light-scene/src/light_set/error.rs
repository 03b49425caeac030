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
    UnknownRecord {
        /// The first word of the line.
        found: String,
    },
    /// The line has too few or too many fields.
    FieldCount {
        /// How many numbers the record needs.
        expected: usize,
        /// How many fields there are.
        found: usize,
    },
    /// A field is not a finite number.
    BadNumber {
        /// The field.
        found: String,
    },
    /// The flag `twosided` is neither 0 nor 1.
    BadFlag {
        /// The number in its place.
        found: f32,
    },
    /// A radiance or intensity is negative.
    NegativeEmission {
        /// The radiance or intensity.
        found: f32,
    },
    /// The power is more than a single-precision number holds.
    Power {
        /// The power.
        found: f64,
    },
    /// The cone is not within 0 and 180 degrees, or its soft edge is wider than the cone.
    BadCone {
        /// Half angle of the cone, in degrees.
        cone_deg: f32,
        /// Width of the soft edge, in degrees.
        delta_deg: f32,
    },
    /// A spot is aimed at the point where it is.
    NoAxis,
    /// A normal is not of unit length.
    NotUnit {
        /// Its length.
        found: f32,
    },
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
            Self::UnknownRecord { found } => write!(
                f,
                "expected a record `tri`, `point` or `spot`, found `{found}`"
            ),
            Self::FieldCount { expected, found } => {
                write!(f, "expected {expected} numbers, found {found}")
            }
            Self::BadNumber { found } => write!(f, "expected a finite number, found `{found}`"),
            Self::BadFlag { found } => {
                write!(f, "expected `twosided` to be 0 or 1, found {found}")
            }
            Self::NegativeEmission { found } => write!(
                f,
                "expected a radiance or intensity that is not negative, found {found}"
            ),
            Self::Power { found } => {
                write!(f, "expected a light of finite power, found {found:.1e}")
            }
            Self::BadCone {
                cone_deg,
                delta_deg,
            } => write!(
                f,
                "expected 0 < cone_deg <= 180 and 0 <= delta_deg <= cone_deg, found {cone_deg} \
                 and {delta_deg}"
            ),
            Self::NoAxis => {
                f.write_str("expected a target apart from the spot, found its position")
            }
            Self::NotUnit { found } => {
                write!(f, "expected a normal of unit length, found {found}")
            }
            Self::Empty => f.write_str("expected at least one record"),
        }
    }
}

impl core::error::Error for LightSetError {}
