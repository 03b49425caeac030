use core::error::Error;
use core::fmt;

/// Why a patch is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BilinearPatchError {
    /// A corner is not finite.
    Corner,
    /// The patch has no area, or one so small that one over it is no finite number.
    Area,
}

impl fmt::Display for BilinearPatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Corner => "corners: must be finite",
            Self::Area => "corners: must span an area above 0",
        })
    }
}

impl Error for BilinearPatchError {}
