use core::error::Error;
use core::fmt;

use lights::sources::{self, LightDescError, PlacedMeshError, SceneSphereError};

/// Why the lights of a scene cannot be built.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SceneLightsError {
    /// The scene's box is not finite.
    Bounds(SceneSphereError),
    /// A light is invalid; the name is that of its material, or its number.
    Light {
        /// Which light.
        name: String,
        /// What is wrong with it.
        error: LightDescError,
    },
    /// The lights of an instance cannot be placed; the name is that of their material.
    Placement {
        /// Which lights.
        name: String,
        /// Why.
        error: PlacedMeshError,
    },
    /// An image has texels that are negative or not finite.
    Image {
        /// Which image.
        name: String,
        /// What is wrong with it.
        error: sources::ImageError,
    },
}

impl SceneLightsError {
    /// That of a light of this name.
    pub(crate) fn light(name: &str, error: LightDescError) -> Self {
        let name = name.into();
        Self::Light { name, error }
    }
}

impl fmt::Display for SceneLightsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bounds(error) => error.fmt(f),
            Self::Light { name, error } => write!(f, "{name}: {error}"),
            Self::Placement { name, error } => write!(f, "{name}: {error}"),
            Self::Image { name, error } => write!(f, "{name}: {error}"),
        }
    }
}

impl Error for SceneLightsError {}
