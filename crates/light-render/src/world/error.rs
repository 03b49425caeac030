use core::error::Error;
use core::fmt;

use crate::SceneLightsError;

/// Why a scene cannot be made ready for rays.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum WorldError {
    /// A light is invalid.
    Lights(SceneLightsError),
    /// A quadric has no radius or length, or its transform is not a similarity.
    Quadric {
        /// Its name.
        name: String,
    },
    /// The transform of an instance is singular or close to it.
    Instance {
        /// The object's name.
        name: String,
    },
    /// There are too many emissive primitives that are copied for every instance: quadrics, and
    /// triangles of objects of one or two.
    Copies {
        /// The name of the object that exceeds the limit.
        name: String,
        /// The limit.
        most: usize,
    },
}

impl From<SceneLightsError> for WorldError {
    fn from(error: SceneLightsError) -> Self {
        Self::Lights(error)
    }
}

impl fmt::Display for WorldError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lights(error) => error.fmt(f),
            Self::Quadric { name } => write!(
                f,
                "{name}: expected a size above 0 and a transform of rotation, translation and uniform scale"
            ),
            Self::Instance { name } => {
                write!(
                    f,
                    "object {name}: expected transforms that do not make it flat"
                )
            }
            Self::Copies { name, most } => write!(
                f,
                "object {name}: expected at most {most} emissive quadrics, and triangles of objects \
                 of one or two, in all instances"
            ),
        }
    }
}

impl Error for WorldError {}
