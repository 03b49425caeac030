use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_bvh::visibility::{CellFactors, LightBvhInCellAt};

use crate::bvh_choices::BvhChoices;
use crate::{BvhLightSamplerRef, LightChoices, LightSampler};

/// The known visibility of lights, by place.
pub trait VisibilityCache {
    /// The factors at `ctx`; `None` where the tree chooses without factors. A pure function of
    /// `ctx`: a sample and a later pmf must get the same factors.
    fn factors<'a>(&'a self, ctx: &LightSampleContext) -> Option<CellFactors<'a>>;
}

/// The default light hierarchy, with the importance of lights multiplied by the factors of a
/// [`VisibilityCache`].
///
/// It obeys the laws of all samplers whatever the cache returns: factors change probabilities, but
/// a light that contributes keeps one above 0. Lights at infinity have no factors.
#[derive(Debug)]
pub struct VisibilityLightSampler<'a, V: ?Sized> {
    lights: BvhLightSamplerRef<'a>,
    cache: &'a V,
}

impl<'a, V: VisibilityCache + ?Sized> VisibilityLightSampler<'a, V> {
    /// The sampler of `lights` with the factors of `cache`, which was made for their tree.
    #[must_use]
    pub const fn new(lights: BvhLightSamplerRef<'a>, cache: &'a V) -> Self {
        Self { lights, cache }
    }

    /// [`LightSampler::at`] with other counts: `known` choices, each from the root, where the cache
    /// has factors; elsewhere `unknown` choices, by a cut if there are several. The result lives as
    /// long as the borrowed memory.
    ///
    /// Several candidates for one shadow ray undo the gain of the factors, because the brightest is
    /// the likeliest to be tested, visible or not: make one choice where visibility is known, or
    /// trace a ray to each.
    #[must_use]
    pub fn choices(&self, ctx: &LightSampleContext, known: u32, unknown: u32) -> LightChoices<'a> {
        match self.cache.factors(ctx) {
            Some(cell) => self.lights.choices_in(cell, ctx, known),
            None => self.lights.choices_at(ctx, unknown),
        }
    }

    /// The choice of one light at `ctx`; `None` where the cache knows no factors.
    #[inline]
    fn choice_at(&self, ctx: &LightSampleContext) -> Option<BvhChoices<'a, LightBvhInCellAt<'a>>> {
        let cell = self.cache.factors(ctx)?;
        Some(self.lights.choice_in(cell, ctx))
    }
}

impl<V: VisibilityCache + ?Sized> LightSampler for VisibilityLightSampler<'_, V> {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        match self.choice_at(ctx) {
            Some(choice) => choice.sample(u),
            None => self.lights.sample(ctx, u),
        }
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        match self.choice_at(ctx) {
            Some(choice) => choice.pmf(light),
            None => self.lights.pmf(ctx, light),
        }
    }

    fn at<'b>(&'b self, ctx: &LightSampleContext, count: u32) -> LightChoices<'b> {
        self.choices(ctx, count, count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.lights.sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.lights.pmf_emitter(light)
    }
}

impl<V: ?Sized> Clone for VisibilityLightSampler<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V: ?Sized> Copy for VisibilityLightSampler<'_, V> {}
