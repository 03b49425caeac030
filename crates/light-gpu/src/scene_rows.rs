use alloc::vec::Vec;
use core::fmt;

use light_samplers::BvhLightSampler;
use light_samplers::light_bvh::LightBvhError;
use light_sources::{LightSet, Rgb};

use crate::light_rows::{UnsupportedLight, light_set_rows};
use crate::rows::{TooManyInfiniteLights, light_sampler_rows};

/// Rows of all that a shader needs to sample the lights of a set: a head, those of the default
/// sampler of these lights, and those of the lights.
///
/// In a buffer from row `first` on they are what `light_scene(first)` reads. The head holds how many
/// rows after it the lights begin. Who keeps the sampler, to refit it, or has built it otherwise,
/// writes [`light_sampler_rows`] and [`light_set_rows`].
///
/// # Errors
/// When no tree can be built of the lights, or shaders do not sample one of them.
///
/// # Panics
/// As [`light_set_rows`].
pub fn light_scene_rows(lights: &LightSet<Rgb>) -> Result<Vec<[u32; 4]>, LightSceneRowsError> {
    let sampler = BvhLightSampler::new(&lights.extents())?;
    let sampler = light_sampler_rows(&sampler.view())?;
    let lights = light_set_rows(lights)?;
    let first_light = u32::try_from(1 + sampler.len()).expect("fewer than 2^32 rows");
    Ok([&[[first_light, 0, 0, 0]][..], &sampler, &lights].concat())
}

/// Why the lights of a set have no rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightSceneRowsError {
    /// No tree can be built of them.
    Tree(LightBvhError),
    /// There are more lights at infinity than a shader chooses from.
    TooManyInfinite(TooManyInfiniteLights),
    /// Shaders do not sample one of them.
    Unsupported(UnsupportedLight),
}

impl fmt::Display for LightSceneRowsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Tree(error) => error.fmt(f),
            Self::TooManyInfinite(error) => error.fmt(f),
            Self::Unsupported(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for LightSceneRowsError {}

impl From<LightBvhError> for LightSceneRowsError {
    fn from(error: LightBvhError) -> Self {
        Self::Tree(error)
    }
}

impl From<TooManyInfiniteLights> for LightSceneRowsError {
    fn from(error: TooManyInfiniteLights) -> Self {
        Self::TooManyInfinite(error)
    }
}

impl From<UnsupportedLight> for LightSceneRowsError {
    fn from(error: UnsupportedLight) -> Self {
        Self::Unsupported(error)
    }
}
