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
    /// The patch is flat and two opposite sides cross, as of corners that are given one after the
    /// other around it.
    Crossed,
}

impl fmt::Display for BilinearPatchError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Corner => "corners: must be finite",
            Self::Area => "corners: must span an area above 0",
            Self::Crossed => {
                "corners: two sides cross; expected the order (u, v) = (0, 0), (1, 0), (0, 1), \
                 (1, 1), not around the quad"
            }
        })
    }
}

impl Error for BilinearPatchError {}
