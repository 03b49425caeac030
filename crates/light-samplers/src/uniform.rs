use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_math::fraction;

use crate::{LightChoices, LightSampler};

/// Chooses all lights with equal probability.
///
/// Needs no memory; a query takes constant time. The baseline: noise grows with the number of
/// lights that do not contribute.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UniformLightSampler {
    count: u32,
}

impl UniformLightSampler {
    /// A sampler of the lights `0..count`; always returns `None` if `count` is 0.
    #[must_use]
    pub const fn new(count: u32) -> Self {
        Self { count }
    }
}

impl LightSampler for UniformLightSampler {
    #[inline]
    fn sample(&self, _: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.sample_emitter(u)
    }

    #[inline]
    fn pmf(&self, _: &LightSampleContext, light: LightId) -> f32 {
        self.pmf_emitter(light)
    }

    #[inline]
    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        LightChoices::one_by_one(self, ctx, count)
    }

    #[inline]
    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        if self.count == 0 {
            return None;
        }
        let (index, u) = fraction::choose(self.count, u);
        let light = LightId(index);
        Some(SampledLight {
            light,
            pmf: self.pmf_emitter(light),
            u,
        })
    }

    #[inline]
    fn pmf_emitter(&self, light: LightId) -> f32 {
        if light.0 < self.count {
            1.0 / self.count as f32
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_lights_no_choice() {
        let sampler = UniformLightSampler::new(0);
        assert_eq!(sampler.sample_emitter(1 << 63), None, "nothing to choose");
        assert_eq!(sampler.pmf_emitter(LightId(0)), 0.0, "unknown light");
    }

    #[test]
    fn shares_are_equal_and_u_is_stretched() {
        let sampler = UniformLightSampler::new(4);
        let sample = sampler.sample_emitter(5 << 61).expect("four lights");
        assert_eq!(
            sample,
            SampledLight {
                light: LightId(2),
                pmf: 0.25,
                u: 1 << 63
            },
            "the middle of the third quarter"
        );
        assert_eq!(sampler.pmf_emitter(LightId(4)), 0.0, "unknown light");
    }

    #[test]
    fn both_ends_of_u_are_lights() {
        let sampler = UniformLightSampler::new(u32::MAX);
        let light = |u| sampler.sample_emitter(u).map(|sample| sample.light.0);
        assert_eq!(light(0), Some(0), "the first");
        assert_eq!(light(u64::MAX), Some(u32::MAX - 1), "the last");
    }
}
