use light_bounds::{LightGroups, LightId, LightSampleContext, SampledLight};

use crate::{LightChoices, LightSampler};

/// A sampler without groups, restricted to the groups of a context: the choice of any other light
/// becomes `None`.
///
/// `G` gives the groups of all lights by id, for example a `Vec<LightGroups>`; lights beyond its
/// end are in all groups. A choice that contributes nothing costs as much as any other:
/// [`BvhLightSampler`](crate::BvhLightSampler) chooses among the lights of the groups only.
#[derive(Clone, Copy, Debug)]
pub struct GroupedLightSampler<S, G> {
    sampler: S,
    groups: G,
}

impl<S: LightSampler, G: AsRef<[LightGroups]>> GroupedLightSampler<S, G> {
    /// `sampler`, with the groups of its lights.
    #[must_use]
    pub const fn new(sampler: S, groups: G) -> Self {
        Self { sampler, groups }
    }

    fn is_wanted(&self, light: LightId, ctx: &LightSampleContext) -> bool {
        let groups = self.groups.as_ref().get(light.index());
        groups.is_none_or(|groups| groups.is_wanted(ctx.groups))
    }
}

impl<S: LightSampler, G: AsRef<[LightGroups]>> LightSampler for GroupedLightSampler<S, G> {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        let chosen = self.sampler.sample(ctx, u)?;
        self.is_wanted(chosen.light, ctx).then_some(chosen)
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        if self.is_wanted(light, ctx) {
            self.sampler.pmf(ctx, light)
        } else {
            0.0
        }
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        LightChoices::one_by_one(self, ctx, count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.sampler.sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.sampler.pmf_emitter(light)
    }
}
