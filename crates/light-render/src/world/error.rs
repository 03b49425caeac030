use core::error::Error;
use core::fmt;

use crate::SceneLightsError;

/// Why a scene cannot be made ready for rays.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum WorldError {
    /// A light makes no sense.
    Lights(SceneLightsError),
    /// A sphere has no radius, or its place does not keep angles.
    Sphere {
        /// Its name.
        name: String,
    },
    /// A placement makes an object flat, or as good as.
    Place {
        /// The object's name.
        name: String,
    },
    /// Objects that shine stand in too many places: each triangle that shines is a light of its
    /// own.
    Copies {
        /// The name of the object that is too much.
        name: String,
        /// How many triangles that shine may be placed.
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
                "sphere {name}: expected a place that turns, moves, and scales all axes alike"
            ),
            Self::Place { name } => {
                write!(f, "object {name}: expected places that do not make it flat")
            }
            Self::Copies { name, most } => write!(
                f,
                "object {name}: expected at most {most} triangles that shine in all places of objects"
            ),
        }
    }
}

impl Error for WorldError {}
