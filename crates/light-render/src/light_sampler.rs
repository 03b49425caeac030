use core::fmt;
use core::str::FromStr;

use lights::bounds::{LightExtent, LightId, LightSampleContext, SampledLight};
use lights::samplers::{LightSampler, UniformLightSampler};
use lights::sources::{LightSet, Rgb};

/// A way to choose one light of many, by its name on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SamplerKind {
    /// Every light alike.
    Uniform,
}

/// A light sampler of any kind, chosen at run time without a virtual call.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum AnyLightSampler {
    /// Every light alike.
    Uniform(UniformLightSampler),
}

impl SamplerKind {
    /// The kind that a program uses unless told otherwise.
    pub const DEFAULT: Self = Self::Uniform;

    /// All kinds.
    pub const ALL: [Self; 1] = [Self::Uniform];

    /// The kind's name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
        }
    }
}

impl AnyLightSampler {
    /// The sampler of the given kind over `lights`.
    ///
    /// # Panics
    /// When there are 2^32 lights or more.
    #[must_use]
    pub fn new(kind: SamplerKind, lights: &LightSet<Rgb>) -> Self {
        Self::over(kind, &lights.extents())
    }

    /// The sampler of the given kind over lights of the given extents; the index is the id.
    ///
    /// # Panics
    /// When there are 2^32 lights or more.
    #[must_use]
    pub fn over(kind: SamplerKind, extents: &[LightExtent]) -> Self {
        let count = u32::try_from(extents.len()).expect("fewer than 2^32 lights");
        match kind {
            SamplerKind::Uniform => Self::Uniform(UniformLightSampler::new(count)),
        }
    }

    /// Bytes that queries may touch.
    #[must_use]
    pub fn bytes(&self) -> usize {
        match self {
            Self::Uniform(sampler) => size_of_val(sampler),
        }
    }

    /// Nodes on the longest way down a hierarchy; 0 without one.
    #[must_use]
    pub const fn depth(&self) -> usize {
        match self {
            Self::Uniform(_) => 0,
        }
    }
}

impl LightSampler for AnyLightSampler {
    #[inline]
    fn sample(&self, ctx: &LightSampleContext, u: f64) -> Option<SampledLight> {
        match self {
            Self::Uniform(sampler) => sampler.sample(ctx, u),
        }
    }

    #[inline]
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        match self {
            Self::Uniform(sampler) => sampler.pmf(ctx, light),
        }
    }

    #[inline]
    fn sample_emitter(&self, u: f64) -> Option<SampledLight> {
        match self {
            Self::Uniform(sampler) => sampler.sample_emitter(u),
        }
    }

    #[inline]
    fn pmf_emitter(&self, light: LightId) -> f32 {
        match self {
            Self::Uniform(sampler) => sampler.pmf_emitter(light),
        }
    }
}

impl fmt::Display for SamplerKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for SamplerKind {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|kind| kind.name() == name);
        found.ok_or_else(|| format!("expected one of {}", Self::ALL.map(Self::name).join(", ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_found_by_its_name() {
        for kind in SamplerKind::ALL {
            assert_eq!(kind.name().parse(), Ok(kind), "{kind}");
        }
        assert!("best".parse::<SamplerKind>().is_err(), "no such sampler");
    }
}
