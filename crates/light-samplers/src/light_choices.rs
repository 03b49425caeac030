use light_bounds::light_math::fraction::stratum;
use light_bounds::{LightId, LightSampleContext, SampledLight};

use crate::LightSampler;
use crate::bvh_choices::BvhChoices;

/// What a sampler knows at one context, for a number of choices there:
/// [`at`](LightSampler::at) makes it.
///
/// ```
/// # use light_samplers::{LightSampler, UniformLightSampler, light_bounds};
/// # use light_bounds::{LightSampleContext, glam::Vec3};
/// let sampler = UniformLightSampler::new(100);
/// let here = sampler.at(&LightSampleContext::medium(Vec3::ZERO), 4);
/// let mut estimate = 0.0;
/// for choice in here.samples(0x1234_5678_9abc_def0) {
///     let irradiance = 1.0; // of `choice.light`
///     estimate += irradiance / choice.pmf / here.count() as f32;
/// }
/// assert_eq!(estimate, 100.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct LightChoices<'a> {
    count: u32,
    kind: Kind<'a>,
}

#[derive(Clone, Copy)]
#[expect(
    clippy::large_enum_variant,
    reason = "boxes need an allocator, and a cut is never moved"
)]
enum Kind<'a> {
    OneByOne {
        sampler: &'a dyn LightSampler,
        ctx: LightSampleContext,
    },
    Bvh(BvhChoices<'a>),
}

impl core::fmt::Debug for Kind<'_> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::OneByOne { ctx, .. } => f.debug_tuple("OneByOne").field(ctx).finish(),
            Self::Bvh(choices) => choices.fmt(f),
        }
    }
}

impl<'a> LightChoices<'a> {
    /// `count` choices at `ctx`, each as [`LightSampler::sample`] makes it.
    #[inline]
    #[must_use]
    pub const fn one_by_one(
        sampler: &'a dyn LightSampler,
        ctx: &LightSampleContext,
        count: u32,
    ) -> Self {
        let ctx = *ctx;
        let kind = Kind::OneByOne { sampler, ctx };
        Self { count, kind }
    }

    #[inline]
    pub(crate) const fn bvh(choices: BvhChoices<'a>, count: u32) -> Self {
        let kind = Kind::Bvh(choices);
        Self { count, kind }
    }

    /// How many choices there are. An estimate is the sum over the choices of what each gives over
    /// its pmf, divided by this number: also where fewer come back, since a choice that is left out
    /// contributes nothing.
    #[inline]
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }

    /// A light for each of the equal parts of `[0, 1)`, at the relative position `u` in each part;
    /// none where a choice contributes nothing.
    #[inline]
    pub fn samples(&self, u: u64) -> impl Iterator<Item = SampledLight> + use<'_, 'a> {
        (0..self.count).filter_map(move |i| self.sample(stratum(i, self.count, u)))
    }

    /// One light that may light the context; `None` means that this choice contributes nothing.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: u64) -> Option<SampledLight> {
        match &self.kind {
            Kind::OneByOne { sampler, ctx } => sampler.sample(ctx, u),
            Kind::Bvh(choices) => choices.sample(u),
        }
    }

    /// Probability that one of the choices is `light`, on average over them, with the same bits as
    /// that of a sample. Multiple importance sampling sets [`count`](Self::count) times this, times
    /// the density of the light, against the density of one sample of another strategy.
    #[inline]
    #[must_use]
    pub fn pmf(&self, light: LightId) -> f32 {
        match &self.kind {
            Kind::OneByOne { sampler, ctx } => sampler.pmf(ctx, light),
            Kind::Bvh(choices) => choices.pmf(light),
        }
    }
}
