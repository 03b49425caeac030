use core::fmt;
use std::io;

use crate::LightBvhError;

/// Why no tree was written.
#[derive(Debug)]
#[non_exhaustive]
pub enum OutOfCoreError {
    /// The lights cannot be those of a tree.
    Lights(LightBvhError),
    /// The lights, the scratch files or the tree could not be read or written.
    Io(io::Error),
    /// The lights of the second reading are not those of the first.
    Changed,
}

impl fmt::Display for OutOfCoreError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lights(error) => write!(f, "{error}"),
            Self::Io(error) => write!(f, "{error}"),
            Self::Changed => f.write_str("the lights changed between the two readings"),
        }
    }
}

impl core::error::Error for OutOfCoreError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Lights(error) => Some(error),
            Self::Io(error) => Some(error),
            Self::Changed => None,
        }
    }
}

impl From<LightBvhError> for OutOfCoreError {
    fn from(error: LightBvhError) -> Self {
        Self::Lights(error)
    }
}

impl From<io::Error> for OutOfCoreError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}
