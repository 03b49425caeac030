use light_bounds::{LightId, LightSampleContext, SampledLight};

use crate::LightSampler;

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
    fn sample(&self, _: &LightSampleContext, u: f64) -> Option<SampledLight> {
        self.sample_emitter(u)
    }

    #[inline]
    fn pmf(&self, _: &LightSampleContext, light: LightId) -> f32 {
        self.pmf_emitter(light)
    }

    #[inline]
    fn sample_emitter(&self, u: f64) -> Option<SampledLight> {
        let (index, u) = choose_uniformly(self.count, u)?;
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

/// One of the numbers `0..count`, with equal probability, and the unused part of `u`; `None` if
/// `count` is 0.
#[inline]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the cast truncates on purpose and saturates; min keeps the index below the count"
)]
pub(crate) fn choose_uniformly(count: u32, u: f64) -> Option<(u32, f64)> {
    let last = count.checked_sub(1)?;
    let scaled = u * f64::from(count);
    let index = (scaled as u32).min(last);
    let rest = SampledLight::clamp_u(scaled - f64::from(index));
    Some((index, rest))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_lights_no_choice() {
        let sampler = UniformLightSampler::new(0);
        assert_eq!(sampler.sample_emitter(0.5), None, "nothing to choose");
        assert_eq!(sampler.pmf_emitter(LightId(0)), 0.0, "unknown light");
    }

    #[test]
    fn shares_are_equal_and_u_is_stretched() {
        let sampler = UniformLightSampler::new(4);
        let sample = sampler.sample_emitter(0.625).expect("four lights");
        assert_eq!(
            sample,
            SampledLight {
                light: LightId(2),
                pmf: 0.25,
                u: 0.5
            },
            "the middle of the third quarter"
        );
        assert_eq!(sampler.pmf_emitter(LightId(4)), 0.0, "unknown light");
    }

    #[test]
    fn both_ends_of_u_and_nonsense_stay_in_range() {
        let sampler = UniformLightSampler::new(u32::MAX);
        for u in [0.0, SampledLight::MAX_U, 2.0, f64::NAN] {
            let sample = sampler.sample_emitter(u).expect("there are lights");
            assert!(sample.light.0 < u32::MAX, "known light for {u}");
            assert!((0.0..1.0).contains(&sample.u), "rest in range for {u}");
        }
    }
}
