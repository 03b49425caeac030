use light_bounds::{LightId, LightSampleContext, SampledLight};

use crate::LightChoices;

/// Chooses lights of a set at random, with probabilities that can be queried.
///
/// Every `u` is a [fraction](light_bounds::light_math::fraction) of 2^64. Samplers are immutable and
/// deterministic in their arguments. For any input, and in every implementation:
///
/// - the pmf of a sample has the same bits as the queried pmf of its light;
/// - the pmfs of all lights and the probability of `None` add up to 1;
/// - a light that contributes at the context has a pmf above 0;
/// - a light that the sampler does not know has pmf 0.
pub trait LightSampler {
    /// One light that may light `ctx`; `None` means that this choice contributes nothing.
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight>;

    /// Probability that [`sample`](Self::sample) at `ctx` returns `light`.
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32;

    /// The choice of `count` lights at `ctx`, one by one from equal parts of `[0, 1)`.
    ///
    /// A sampler may keep what it has computed for `ctx`, and refine its estimates for several
    /// choices: the probabilities are then those of [`LightChoices::pmf`]. One without such work
    /// returns [`LightChoices::one_by_one`].
    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a>;

    /// One light to emit from, without a receiver, as in light tracing; `None` if nothing emits.
    fn sample_emitter(&self, u: u64) -> Option<SampledLight>;

    /// Probability that [`sample_emitter`](Self::sample_emitter) returns `light`.
    fn pmf_emitter(&self, light: LightId) -> f32;
}

impl<S: LightSampler + ?Sized> LightSampler for &S {
    #[inline]
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        (**self).sample(ctx, u)
    }

    #[inline]
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        (**self).pmf(ctx, light)
    }

    #[inline]
    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        (**self).at(ctx, count)
    }

    #[inline]
    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        (**self).sample_emitter(u)
    }

    #[inline]
    fn pmf_emitter(&self, light: LightId) -> f32 {
        (**self).pmf_emitter(light)
    }
}
