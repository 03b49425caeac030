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
    /// A coordinate is beyond ±1e36, where the default tree cannot take differences of positions any more.
    TooFar {
        /// Of which light.
        light: LightId,
    },
    /// There are more lights than the tree can address.
    TooManyLights,
}

impl fmt::Display for LightBvhError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BadBounds { light, reason } => write!(f, "light {}: {reason}", light.0),
            Self::BadInfiniteBounds { light, reason } => write!(f, "light {}: {reason}", light.0),
            Self::TooFar { light } => write!(f, "light {}: a coordinate is beyond 1e36", light.0),
            Self::TooManyLights => f.write_str("more lights than the tree can address"),
        }
    }
}

impl core::error::Error for LightBvhError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::BadBounds { reason, .. } => Some(reason),
            Self::BadInfiniteBounds { reason, .. } => Some(reason),
            Self::TooFar { .. } | Self::TooManyLights => None,
        }
    }
}
