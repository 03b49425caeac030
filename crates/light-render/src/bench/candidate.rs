use lights::bounds::{LightExtent, LightId, LightSampleContext};
use lights::samplers::LightSampler;
use lights::sources::{LightSet, Rgb};

use super::build_time::build_time;
use crate::{AnyLightSampler, AnyLightSamplerError, SamplerKind};

/// A sampler under measurement.
pub(super) struct Candidate {
    kind: SamplerKind,
    n_lights: usize,
    /// Whether any light is at infinity.
    has_infinite: bool,
    sampler: AnyLightSampler,
}

fn has_infinite(lights: &[LightExtent]) -> bool {
    lights.iter().any(|light| light.infinite().is_some())
}

impl Candidate {
    /// Builds the sampler of the given kind; that by power goes by `powers`.
    ///
    /// # Errors
    /// The first light that the sampler refuses.
    pub(super) fn new(
        kind: SamplerKind,
        extents: &[LightExtent],
        powers: &[f32],
    ) -> Result<Self, AnyLightSamplerError> {
        Ok(Self {
            kind,
            n_lights: extents.len(),
            has_infinite: has_infinite(extents),
            sampler: match kind {
                SamplerKind::Power => AnyLightSampler::by_power(powers)?,
                _ => AnyLightSampler::over(kind, extents)?,
            },
        })
    }

    /// Builds the sampler of the given kind for the lights of a scene.
    ///
    /// # Errors
    /// The first light that the sampler refuses.
    pub(super) fn for_lights(
        kind: SamplerKind,
        lights: &LightSet<Rgb>,
    ) -> Result<Self, AnyLightSamplerError> {
        Ok(Self {
            kind,
            n_lights: lights.len(),
            has_infinite: has_infinite(&lights.extents()),
            sampler: AnyLightSampler::new(kind, lights)?,
        })
    }

    /// Milliseconds of the fastest of several refits to the same lights; `None` if the sampler
    /// knows none.
    pub(super) fn refit_ms(&self, extents: &[LightExtent]) -> Option<f64> {
        let mut sampler = self.sampler.hierarchy()?.clone();
        let (milliseconds, refitted) = build_time(|| sampler.refit(extents));
        refitted.ok().map(|()| milliseconds)
    }

    /// Refits to lights that moved, if the sampler can.
    ///
    /// # Errors
    /// The first light that has moved too far.
    pub(super) fn refit(&mut self, extents: &[LightExtent]) -> Result<(), AnyLightSamplerError> {
        if let AnyLightSampler::Bvh(sampler) = &mut self.sampler {
            sampler.refit(extents)?;
        }
        Ok(())
    }

    /// Degradation by refits, as `BvhLightSampler` defines it; `None` for samplers without refits.
    pub(super) fn degradation(&self) -> Option<f64> {
        self.sampler.degradation()
    }

    pub(super) const fn kind(&self) -> SamplerKind {
        self.kind
    }

    pub(super) const fn n_lights(&self) -> usize {
        self.n_lights
    }

    pub(super) fn sampler(&self) -> &(dyn LightSampler + Sync) {
        match &self.sampler {
            AnyLightSampler::Uniform(sampler) => sampler,
            AnyLightSampler::Power(sampler) => sampler,
            AnyLightSampler::Exhaustive(sampler) => sampler,
            AnyLightSampler::BvhReference(sampler) => sampler,
            AnyLightSampler::Bvh(sampler) => sampler,
            AnyLightSampler::BvhPlanned(sampler) => sampler,
            AnyLightSampler::BvhInCells(sampler) => sampler,
            AnyLightSampler::BvhPlaced(sampler) => sampler,
        }
    }

    /// The probabilities of all lights, in the order of ids: of a tree alone in one pass over its
    /// nodes, otherwise by a query of each light that `is_asked`; 0 for the others.
    pub(super) fn pmfs(
        &self,
        ctx: &LightSampleContext,
        is_asked: impl Fn(LightId) -> bool,
    ) -> Vec<f32> {
        let mut pmfs = vec![0.0; self.n_lights];
        let mut set = |id: LightId, pmf| pmfs[id.index()] = pmf;
        match &self.sampler {
            AnyLightSampler::Bvh(sampler) if !self.has_infinite => {
                sampler.tree().view().for_each_pmf(ctx, set);
            }
            AnyLightSampler::BvhReference(sampler) if !self.has_infinite => {
                sampler.tree().view().for_each_pmf(ctx, set);
            }
            _ => {
                let ids = (0..).map(LightId).take(self.n_lights);
                ids.filter(|&id| is_asked(id))
                    .for_each(|id| set(id, self.sampler().pmf(ctx, id)));
            }
        }
        pmfs
    }

    /// Bytes that queries may touch.
    pub(super) fn bytes(&self) -> usize {
        self.sampler.bytes(self.n_lights)
    }

    /// Nodes on the longest path from the root.
    pub(super) fn depth(&self) -> usize {
        self.sampler.depth()
    }
}
