use core::error::Error;
use core::fmt;

use crate::SceneLightsError;

/// Why a scene cannot be made ready for rays.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum WorldError {
    /// A light is invalid.
    Lights(SceneLightsError),
    /// A sphere has no radius, or its transform is not a similarity.
    Sphere {
        /// Its name.
        name: String,
    },
    /// The transform of an instance is singular or close to it.
    Instance {
        /// The object's name.
        name: String,
    },
    /// There are too many emissive primitives in all instances: each is a light of its own.
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
            Self::Sphere { name } => write!(
                f,
                "sphere {name}: expected a transform of rotation, translation and uniform scale"
            ),
            Self::Instance { name } => {
                write!(
                    f,
                    "object {name}: expected transforms that do not make it flat"
                )
            }
            Self::Copies { name, most } => write!(
                f,
                "object {name}: expected at most {most} emissive triangles and spheres in all \
                 instances"
            ),
        }
    }
}

impl Error for WorldError {}
