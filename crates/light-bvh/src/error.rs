use core::fmt;

use light_bounds::{InfiniteBoundsError, LightBoundsError, LightId};

/// Why no tree could be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightBvhError {
    /// The bounds of a light that is somewhere are not valid.
    BadBounds {
        /// Which light.
        light: LightId,
        /// What is wrong with it.
        reason: LightBoundsError,
    },
    /// The bounds of a light at infinity are not valid.
    BadInfiniteBounds {
        /// Which light.
        light: LightId,
        /// What is wrong with it.
        reason: InfiniteBoundsError,
    },
    /// A coordinate is beyond ±1e36, where the default tree cannot take differences of positions
    /// any more.
    TooFar {
        /// Of which light.
        light: LightId,
    },
    /// There are more lights than the tree can address.
    TooManyLights {
        /// How many it can.
        most: usize,
    },
    /// A refit was given another number of lights than the tree was built for.
    OtherLights {
        /// How many the tree was built for.
        expected: usize,
    },
    /// A refit cannot place a light: it had no power, or was at infinity, when the tree was built;
    /// or it is at infinity now and was not.
    NoPlace {
        /// Which light.
        light: LightId,
    },
}

impl fmt::Display for LightBvhError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BadBounds { light, reason } => write!(f, "light {}: {reason}", light.0),
            Self::BadInfiniteBounds { light, reason } => write!(f, "light {}: {reason}", light.0),
            Self::TooFar { light } => write!(f, "light {}: a coordinate is beyond 1e36", light.0),
            Self::TooManyLights { most } => {
                write!(
                    f,
                    "expected at most {most} lights, which the tree can address"
                )
            }
            Self::OtherLights { expected } => {
                write!(f, "expected {expected} lights, as when the tree was built")
            }
            Self::NoPlace { light } => write!(
                f,
                "light {}: no place in the tree that fits; build a new tree",
                light.0
            ),
        }
    }
}

impl core::error::Error for LightBvhError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::BadBounds { reason, .. } => Some(reason),
            Self::BadInfiniteBounds { reason, .. } => Some(reason),
            Self::TooFar { .. }
            | Self::TooManyLights { .. }
            | Self::OtherLights { .. }
            | Self::NoPlace { .. } => None,
        }
    }
}
