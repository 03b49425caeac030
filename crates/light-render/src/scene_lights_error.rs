use core::error::Error;
use core::fmt;

use lights::math::Aabb;
use lights::sources::{self, LightDescError, PlacedMeshError, SceneSphereError};

/// Why the lights of a scene cannot be built.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SceneLightsError {
    /// The scene's box is too large, too small or not finite.
    Bounds {
        /// What reaches farthest; empty where it has no name.
        name: String,
        /// The box.
        bounds: Aabb,
        /// What is wrong with it.
        error: SceneSphereError,
    },
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
            Self::Bounds { name, bounds, .. } => {
                let [min, max] = [bounds.min, bounds.max].map(|corner| corner.to_array());
                write!(
                    f,
                    "expected a scene of a size of about 1e-19 to 1e19, found one from {min:?} to \
                     {max:?}"
                )?;
                if name.is_empty() {
                    return Ok(());
                }
                write!(f, "; `{name}` reaches farthest")
            }
            Self::Light { name, error } => write!(f, "{name}: {error}"),
            Self::Placement { name, error } => write!(f, "{name}: {error}"),
            Self::Image { name, error } => write!(f, "{name}: {error}"),
        }
    }
}

impl Error for SceneLightsError {}
