use crate::PreparedChoices;
use crate::prepared_choices::Preparation;
use light_bounds::{LightId, LightSampleContext, SampledLight};

/// Chooses lights of a set at random, with probabilities that can be queried.
///
/// Every `u` is in `[0, 1)`: an `f64`, because the 24 bits of an `f32` cannot address a million
/// lights. Samplers are immutable and deterministic in their arguments. For any input, and in every
/// implementation:
///
/// - the pmf of a sample has the same bits as the queried pmf of its light;
/// - the pmfs of all lights and the probability of `None` add up to 1;
/// - a light that contributes at the context has a pmf above 0;
/// - a light that the sampler does not know has pmf 0.
pub trait LightSampler {
    /// One light that may light `ctx`; `None` means that this choice contributes nothing.
    fn sample(&self, ctx: &LightSampleContext, u: f64) -> Option<SampledLight>;

    /// Probability that [`sample`](Self::sample) at `ctx` returns `light`.
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32;

    /// One light to emit from, without a receiver, as in light tracing; `None` if nothing emits.
    fn sample_emitter(&self, u: f64) -> Option<SampledLight>;

    /// Probability that [`sample_emitter`](Self::sample_emitter) returns `light`.
    fn pmf_emitter(&self, light: LightId) -> f32;

    /// Calls `each` with `count` lights that may light `ctx`, or fewer: one for each of the equal
    /// parts of `[0, 1)`, at the relative position `u` in each part.
    ///
    /// An estimate is the sum over the choices of what each gives over its pmf, divided by `count`:
    /// also where fewer came back, since a choice that is left out contributes nothing.
    ///
    /// A sampler may refine its estimates for several choices; their probabilities are then those
    /// of [`pmf_many`](Self::pmf_many) for the same `count`.
    fn sample_many(
        &self,
        ctx: &LightSampleContext,
        u: f64,
        count: u32,
        each: &mut dyn FnMut(SampledLight),
    ) {
        for i in 0..count {
            if let Some(sample) = self.sample(ctx, stratum(i, count, u)) {
                each(sample);
            }
        }
    }

    /// Probability that one of the `count` choices of [`sample_many`](Self::sample_many) at `ctx`
    /// is `light`, on average over them. Multiple importance sampling sets `count` times this, times
    /// the density of the light, against the density of one sample of another strategy.
    fn pmf_many(&self, ctx: &LightSampleContext, light: LightId, count: u32) -> f32 {
        let _ = count;
        self.pmf(ctx, light)
    }

    /// [`sample_many`](Self::sample_many), which also fills `prepared` for
    /// [`pmf_many_prepared`](Self::pmf_many_prepared).
    fn sample_many_prepared(
        &self,
        ctx: &LightSampleContext,
        u: f64,
        count: u32,
        prepared: &mut PreparedChoices,
        each: &mut dyn FnMut(SampledLight),
    ) {
        prepared.preparation = Preparation::Nothing;
        self.sample_many(ctx, u, count, each);
    }

    /// [`pmf_many`](Self::pmf_many), with the same bits, where `prepared` is that of
    /// [`sample_many_prepared`](Self::sample_many_prepared) by the same sampler at the same `ctx`
    /// with the same `count`, or an empty one.
    fn pmf_many_prepared(
        &self,
        ctx: &LightSampleContext,
        light: LightId,
        count: u32,
        prepared: &PreparedChoices,
    ) -> f32 {
        let _ = prepared;
        self.pmf_many(ctx, light, count)
    }
}

/// The number at the relative position `u` in the `i`th of `count` equal parts of `[0, 1)`.
pub(crate) fn stratum(i: u32, count: u32, u: f64) -> f64 {
    ((f64::from(i) + u) / f64::from(count)).min(SampledLight::MAX_U)
}

impl<S: LightSampler + ?Sized> LightSampler for &S {
    #[inline]
    fn sample(&self, ctx: &LightSampleContext, u: f64) -> Option<SampledLight> {
        (**self).sample(ctx, u)
    }

    #[inline]
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        (**self).pmf(ctx, light)
    }

    #[inline]
    fn sample_emitter(&self, u: f64) -> Option<SampledLight> {
        (**self).sample_emitter(u)
    }

    #[inline]
    fn pmf_emitter(&self, light: LightId) -> f32 {
        (**self).pmf_emitter(light)
    }

    #[inline]
    fn sample_many(
        &self,
        ctx: &LightSampleContext,
        u: f64,
        count: u32,
        each: &mut dyn FnMut(SampledLight),
    ) {
        (**self).sample_many(ctx, u, count, each);
    }

    #[inline]
    fn pmf_many(&self, ctx: &LightSampleContext, light: LightId, count: u32) -> f32 {
        (**self).pmf_many(ctx, light, count)
    }

    #[inline]
    fn sample_many_prepared(
        &self,
        ctx: &LightSampleContext,
        u: f64,
        count: u32,
        prepared: &mut PreparedChoices,
        each: &mut dyn FnMut(SampledLight),
    ) {
        (**self).sample_many_prepared(ctx, u, count, prepared, each);
    }

    #[inline]
    fn pmf_many_prepared(
        &self,
        ctx: &LightSampleContext,
        light: LightId,
        count: u32,
        prepared: &PreparedChoices,
    ) -> f32 {
        (**self).pmf_many_prepared(ctx, light, count, prepared)
    }
}
