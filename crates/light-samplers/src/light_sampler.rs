use light_bounds::{LightId, LightSampleContext, SampledLight};

/// A way to choose one light of a set at random, with a probability that can be asked for.
///
/// Every `u` is in `[0, 1)`: an `f64`, because the 24 bits of an `f32` cannot address a million lights. Samplers are
/// immutable and deterministic in their arguments. For any input, and in every implementation:
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

    /// One light to emit from when nobody asks, as in light tracing; `None` if nothing emits.
    fn sample_emitter(&self, u: f64) -> Option<SampledLight>;

    /// Probability that [`sample_emitter`](Self::sample_emitter) returns `light`.
    fn pmf_emitter(&self, light: LightId) -> f32;
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
}
