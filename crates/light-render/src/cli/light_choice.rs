use std::time::Instant;

use crate::AnyLightSampler;

use super::failure::Failure;
use super::prepared_picture::PreparedPicture;
use super::scene_input::SceneInput;
use super::visibility::{VisibilityCosts, with_visibility};

/// What chooses the lights of a picture, and what it took to build.
#[derive(Debug)]
pub(super) struct LightChoice {
    pub(super) sampler: AnyLightSampler,
    /// Milliseconds, without what visibility takes.
    pub(super) build_ms: f64,
    pub(super) visibility: VisibilityCosts,
}

impl LightChoice {
    /// Builds the sampler, in the current `rayon` pool.
    ///
    /// # Errors
    /// A light that the sampler refuses, or more cells than 32 bits count.
    pub(super) fn new(input: &SceneInput, picture: &PreparedPicture) -> Result<Self, Failure> {
        let PreparedPicture { world, view, .. } = picture;
        let start = Instant::now();
        let sampler = AnyLightSampler::new(picture.sampler, world.lights());
        let sampler = sampler.map_err(|error| input.refuse_choice(&error))?;
        let build_ms = start.elapsed().as_secs_f64() * 1e3;
        let max_depth = picture.settings.path.max_depth;
        let (sampler, visibility) =
            with_visibility(sampler, picture.visibility, world, view, max_depth)?;
        Ok(Self {
            sampler,
            build_ms,
            visibility,
        })
    }
}
