use lights::bounds::{LightId, LightSampleContext, SampledLight};
use lights::samplers::{BvhLightSampler, LightChoices, LightSampler};

/// The default light hierarchy for scenes where much light is hidden: [`at`](LightSampler::at)
/// makes a single choice for any count, by the cut that several choices would be made by.
///
/// Several candidates that share a shadow ray remove the noise of the choice, but not that of
/// shadows, and the choice between them spoils the stratification of the sample numbers over the
/// lights.
#[derive(Clone, Debug)]
pub struct SingleChoiceLightSampler {
    lights: BvhLightSampler,
}

impl SingleChoiceLightSampler {
    /// Single choices of `lights`.
    #[must_use]
    pub const fn new(lights: BvhLightSampler) -> Self {
        Self { lights }
    }

    /// The hierarchy.
    #[must_use]
    pub const fn lights(&self) -> &BvhLightSampler {
        &self.lights
    }
}

impl LightSampler for SingleChoiceLightSampler {
    #[inline]
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.lights.sample(ctx, u)
    }

    #[inline]
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.lights.pmf(ctx, light)
    }

    #[inline]
    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        self.lights.at(ctx, count.max(2)).with_count(count.min(1))
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.lights.sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.lights.pmf_emitter(light)
    }
}
