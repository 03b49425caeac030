//! A sampler of contexts that are not those it is asked about.

use light_samplers::light_bounds::{LightId, LightSampleContext, SampledLight};
use light_samplers::{LightChoices, LightSampler};

/// A sampler that changes every context before it uses it.
pub(crate) struct Asked<S>(
    pub(crate) S,
    pub(crate) fn(&LightSampleContext) -> LightSampleContext,
);

impl<S: LightSampler> LightSampler for Asked<S> {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.0.sample(&self.1(ctx), u)
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.0.pmf(&self.1(ctx), light)
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        self.0.at(&self.1(ctx), count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.0.sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.0.pmf_emitter(light)
    }
}
