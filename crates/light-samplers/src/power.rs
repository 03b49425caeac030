use alloc::vec::Vec;
use core::fmt;

use light_bounds::{LightId, LightSampleContext, SampledLight};
use light_math::distribution::{AliasBin, AliasTable, TableError};

use crate::id_count::{MOST, id_count};
use crate::{LightChoices, LightSampler, UniformLightSampler};

/// Chooses each light in proportion to its power.
///
/// 12 bytes a light; a query takes constant time. Of `n` lights each one with power has at least a
/// probability of `2^-16 / n`. The baseline for scenes in which every light
/// reaches every point. Lights without power are never chosen, unless no light has power.
#[derive(Clone, Debug)]
pub struct PowerLightSampler {
    choice: Choice,
}

#[derive(Clone, Debug)]
enum Choice {
    ByPower(AliasTable<Vec<AliasBin>>),
    /// No light has power.
    Uniform(UniformLightSampler),
}

/// More lights than ids.
const TOO_MANY: PowerLightSamplerError = PowerLightSamplerError::TooManyLights { most: MOST };

impl PowerLightSampler {
    /// A sampler in proportion to `powers`: one for each light in the order of ids, all in W or in
    /// another common unit; for a spectrum the mean over wavelengths.
    ///
    /// # Errors
    /// A power is negative or not finite, or there are more than 2^32 - 1 lights.
    pub fn new(powers: &[f32]) -> Result<Self, PowerLightSamplerError> {
        let count = id_count(powers.len()).ok_or(TOO_MANY)?;
        for (light, &power) in (0..).map(LightId).zip(powers) {
            if !(power >= 0.0 && power.is_finite()) {
                return Err(PowerLightSamplerError::BadPower { light });
            }
        }
        let choice = match AliasTable::new(powers) {
            Ok(table) => Choice::ByPower(table),
            Err(TableError::Empty | TableError::AllZero) => {
                Choice::Uniform(UniformLightSampler::new(count))
            }
            Err(_) => return Err(TOO_MANY),
        };
        Ok(Self { choice })
    }
}

impl LightSampler for PowerLightSampler {
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
    #[expect(
        clippy::cast_possible_truncation,
        reason = "the table is no longer than ids are numerous"
    )]
    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        match &self.choice {
            Choice::ByPower(table) => {
                let sample = table.sample(u);
                Some(SampledLight {
                    light: LightId(sample.index as u32),
                    pmf: sample.pmf,
                    u: sample.u,
                })
            }
            Choice::Uniform(sampler) => sampler.sample_emitter(u),
        }
    }

    #[inline]
    fn pmf_emitter(&self, light: LightId) -> f32 {
        match &self.choice {
            Choice::ByPower(table) => table.pmf(light.index()),
            Choice::Uniform(sampler) => sampler.pmf_emitter(light),
        }
    }
}

/// Why powers cannot be sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PowerLightSamplerError {
    /// A power is negative, infinite or not a number.
    BadPower {
        /// Which light.
        light: LightId,
    },
    /// There are more lights than ids.
    TooManyLights {
        /// How many there may be.
        most: usize,
    },
}

impl fmt::Display for PowerLightSamplerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::BadPower { light } => {
                write!(f, "light {}: the power is negative or not finite", light.0)
            }
            Self::TooManyLights { most } => {
                write!(f, "expected at most {most} lights: ids have 32 bits")
            }
        }
    }
}

impl core::error::Error for PowerLightSamplerError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_proportion_to_power() {
        let sampler = PowerLightSampler::new(&[1.0, 0.0, 3.0]).expect("powers");
        let pmfs = [0, 1, 2, 3].map(|i| sampler.pmf_emitter(LightId(i)));
        assert_eq!((pmfs[1], pmfs[3]), (0.0, 0.0), "dark, and unknown");
        // Probabilities are multiples of this, and each light that is on gets one first.
        let part = 1.0 / (3.0 * 65536.0);
        assert!((pmfs[0] - 0.25).abs() <= 2.0 * part, "{pmfs:?}");
        assert!((pmfs[2] - 0.75).abs() <= 2.0 * part, "{pmfs:?}");
    }

    #[test]
    fn uniform_when_no_light_has_power() {
        let sampler = PowerLightSampler::new(&[0.0; 4]).expect("powers");
        assert_eq!(sampler.pmf_emitter(LightId(3)), 0.25, "each alike");
        let empty = PowerLightSampler::new(&[]).expect("no power is wrong");
        assert_eq!(empty.sample_emitter(1 << 63), None, "no light");
    }

    #[test]
    fn weak_lights_do_not_vanish() {
        let sampler = PowerLightSampler::new(&[f32::MAX, 1e-45, 0.0]).expect("powers");
        assert!(sampler.pmf_emitter(LightId(1)) > 0.0, "weak");
        assert_eq!(sampler.pmf_emitter(LightId(2)), 0.0, "dark");
    }

    #[test]
    fn powers_that_are_none_are_refused() {
        for bad in [-1.0, f32::NAN, f32::INFINITY] {
            let light = LightId(1);
            assert_eq!(
                PowerLightSampler::new(&[1.0, bad]).map(|_| ()),
                Err(PowerLightSamplerError::BadPower { light }),
                "{bad}"
            );
        }
    }
}
