use lights::bounds::{LightId, LightSampleContext, SampledLight};
use lights::samplers::{BvhLightSampler, LightChoices, LightSampler};

/// How many lights of the default hierarchy are chosen at the vertices of a path, and how.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChoicePlan {
    /// One from the root at every vertex: the fastest.
    OneFromRoot,
    /// One at every vertex, by the cut that several choices would be made by.
    OneByCut,
    /// As many as are asked for, several of them by a cut: two at the first vertex by default, one
    /// from the root at later ones.
    AsAsked,
}

/// The default light hierarchy with the choices of a [`ChoicePlan`].
///
/// Several candidates that share a shadow ray remove the noise of the choice, but not that of
/// shadows, and the choice between them spoils the stratification of the sample numbers over the
/// lights. So where much light is hidden, [`at`](LightSampler::at) makes a single choice for any
/// count.
#[derive(Clone, Debug)]
pub struct PlannedLightSampler {
    lights: BvhLightSampler,
    plan: ChoicePlan,
}

impl ChoicePlan {
    /// All plans.
    pub const ALL: [Self; 3] = [Self::OneFromRoot, Self::OneByCut, Self::AsAsked];

    /// What is chosen, in words.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::OneFromRoot => "one light from the root",
            Self::OneByCut => "one light by a cut",
            Self::AsAsked => "two lights by a cut that share a shadow ray",
        }
    }

    /// For how many choices the hierarchy is asked where `count` are wanted, and how many of them
    /// are made.
    #[inline]
    pub(super) fn counts(self, count: u32) -> [u32; 2] {
        match self {
            Self::OneFromRoot => [count.min(1); 2],
            Self::OneByCut => [count.max(2), count.min(1)],
            Self::AsAsked => [count; 2],
        }
    }
}

impl PlannedLightSampler {
    /// Choices of `lights` by `plan`.
    #[must_use]
    pub const fn new(lights: BvhLightSampler, plan: ChoicePlan) -> Self {
        Self { lights, plan }
    }

    /// The hierarchy.
    #[must_use]
    pub const fn lights(&self) -> &BvhLightSampler {
        &self.lights
    }

    /// The plan.
    #[must_use]
    pub const fn plan(&self) -> ChoicePlan {
        self.plan
    }
}

impl LightSampler for PlannedLightSampler {
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
        let [asked, made] = self.plan.counts(count);
        self.lights.at(ctx, asked).with_count(made)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.lights.sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.lights.pmf_emitter(light)
    }
}
