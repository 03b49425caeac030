use core::fmt;

use crate::LightBvhError;

/// Why placements cannot be those of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InstancedLightBvhError {
    /// There are more parts of placements than the tree can address: 2^28, counted as if all
    /// placements had the parts of the prototype of most, rounded up to a power of two.
    TooManyPlacements,
    /// A placement names a prototype that is not there, or not among the first 2^30, or in a refit
    /// another one than before.
    Prototype {
        /// Which placement.
        placement: u32,
    },
    /// A placed prototype reaches beyond ±1e36.
    TooFar {
        /// Which placement.
        placement: u32,
    },
    /// A refit was given another number of placements than the tree was built for.
    OtherPlacements {
        /// How many the tree was built for.
        expected: usize,
    },
    /// A refit lights a placement that was dark when the tree was built, and has no place.
    NoPlace {
        /// Which placement.
        placement: u32,
    },
    /// The lights of a prototype cannot be refitted.
    Lights(LightBvhError),
}

impl fmt::Display for InstancedLightBvhError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyPlacements => f.write_str("more than 2^28 parts of placements"),
            Self::Prototype { placement } => {
                write!(
                    f,
                    "placement {placement}: no such prototype, or in a refit another one"
                )
            }
            Self::TooFar { placement } => {
                write!(f, "placement {placement}: a coordinate is beyond 1e36")
            }
            Self::OtherPlacements { expected } => {
                write!(
                    f,
                    "expected {expected} placements, as when the tree was built"
                )
            }
            Self::NoPlace { placement } => write!(
                f,
                "placement {placement}: was dark when the tree was built; build a new tree"
            ),
            Self::Lights(error) => write!(f, "prototype: {error}"),
        }
    }
}

impl core::error::Error for InstancedLightBvhError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Lights(error) => Some(error),
            Self::TooManyPlacements
            | Self::Prototype { .. }
            | Self::TooFar { .. }
            | Self::OtherPlacements { .. }
            | Self::NoPlace { .. } => None,
        }
    }
}
