use core::str::FromStr;

use lights::bounds::{LightExtent, LightSampleContext, SampledLight};
use lights::samplers::{LightSampler, UniformLightSampler};

/// A sampler that can be measured, by its name on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SamplerKind {
    /// Every light alike.
    Uniform,
}

impl SamplerKind {
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

impl FromStr for SamplerKind {
    type Err = &'static str;

    fn from_str(s: &str) -> Result<Self, Self::Err> {
        Self::ALL
            .into_iter()
            .find(|kind| kind.name() == s)
            .ok_or("expected uniform")
    }
}

/// A sampler under measurement.
pub(super) struct Subject {
    kind: SamplerKind,
    n_lights: usize,
    sampler: AnySampler,
}

enum AnySampler {
    Uniform(UniformLightSampler),
}

impl Subject {
    /// Builds the sampler of the given kind.
    pub(super) fn new(kind: SamplerKind, extents: &[LightExtent]) -> Self {
        let n_lights = extents.len();
        let sampler = match kind {
            SamplerKind::Uniform => AnySampler::Uniform(UniformLightSampler::new(
                u32::try_from(n_lights).expect("fewer than 2^32 lights"),
            )),
        };
        Self {
            kind,
            n_lights,
            sampler,
        }
    }

    pub(super) const fn kind(&self) -> SamplerKind {
        self.kind
    }

    pub(super) const fn n_lights(&self) -> usize {
        self.n_lights
    }

    pub(super) fn sampler(&self) -> &(dyn LightSampler + Sync) {
        match &self.sampler {
            AnySampler::Uniform(sampler) => sampler,
        }
    }

    /// Bytes that queries may touch.
    pub(super) fn bytes(&self) -> usize {
        match &self.sampler {
            AnySampler::Uniform(sampler) => size_of_val(sampler),
        }
    }

    /// Nodes on the longest way down.
    pub(super) fn depth(&self) -> usize {
        match &self.sampler {
            AnySampler::Uniform(_) => 0,
        }
    }

    /// `k` samples of one call, stratified over `u`.
    pub(super) fn sample_many(
        &self,
        ctx: &LightSampleContext,
        u: f64,
        k: usize,
        each: &mut dyn FnMut(SampledLight),
    ) {
        for i in 0..k {
            let u = (i as f64 + u) / k as f64;
            if let Some(sample) = self.sampler().sample(ctx, u.min(SampledLight::MAX_U)) {
                each(sample);
            }
        }
    }
}
