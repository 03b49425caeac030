use alloc::vec::Vec;

use light_bounds::{
    ImportanceQuery, LightBounds, LightExtent, LightId, LightSampleContext, SampledLight,
};
use light_bvh::LightBvhError;
use light_math::distribution::WeightedReservoir;

use crate::LightSampler;
use crate::first_choice::{FirstChoice, FirstPmf, share};
use crate::infinite_shares::{HasOthers, InfiniteShares};

/// Chooses each light in proportion to its importance, without a hierarchy, in time linear in the
/// number of lights.
///
/// A tree approximates its probabilities. For tests, comparisons and a handful of lights. Reads
/// `ctx.ns`. Without a context lights are chosen in proportion to power. Lights at infinity share
/// one uniform choice with all others.
///
/// # Source
/// `[PBRT4]`, section 12.6.2, as its exhaustive sampler.
#[derive(Clone, Debug)]
pub struct ExhaustiveLightSampler {
    /// One entry a light; those at infinity have empty bounds.
    bounds: Vec<LightBounds>,
    infinite: InfiniteShares,
}

impl ExhaustiveLightSampler {
    /// A sampler of `lights`; the index of a light is its id.
    ///
    /// # Errors
    /// [`LightBvhError`] names the first light whose bounds are not valid; or there are more than
    /// 2^32 - 1 lights.
    pub fn new(lights: &[LightExtent]) -> Result<Self, LightBvhError> {
        if u32::try_from(lights.len()).is_err() {
            return Err(LightBvhError::TooManyLights);
        }
        light_bvh::validate(lights)?;
        let bounds: Vec<_> = lights
            .iter()
            .map(|extent| extent.bounded().copied().unwrap_or(LightBounds::EMPTY))
            .collect();
        let has_others = if bounds.iter().any(|b| b.phi > 0.0) {
            HasOthers::Yes
        } else {
            HasOthers::No
        };
        Ok(Self {
            infinite: InfiniteShares::new(lights, has_others),
            bounds,
        })
    }

    fn choose(&self, u: f64, weight: impl Fn(&LightBounds) -> f32) -> Option<SampledLight> {
        match self.infinite.choose(u)? {
            FirstChoice::Infinite(sample) => sample,
            FirstChoice::Others { pmf, u } => {
                let mut reservoir = WeightedReservoir::new(u);
                for (id, bounds) in (0..).map(LightId).zip(&self.bounds) {
                    let weight = weight(bounds);
                    reservoir.add((id, weight), weight);
                }
                let total = reservoir.total();
                let sample = reservoir.sample()?;
                let (light, weight) = sample.value;
                Some(SampledLight {
                    light,
                    pmf: pmf * share(f64::from(weight), total),
                    u: sample.u,
                })
            }
        }
    }

    fn probability(&self, light: LightId, weight: impl Fn(&LightBounds) -> f32) -> f32 {
        let pmf = match self.infinite.first_pmf(light) {
            FirstPmf::Infinite(pmf) => return pmf,
            FirstPmf::Others(pmf) => pmf,
        };
        let Some(bounds) = self.bounds.get(light.index()) else {
            return 0.0;
        };
        let total = self.bounds.iter().map(|b| f64::from(weight(b))).sum();
        pmf * share(f64::from(weight(bounds)), total)
    }
}

impl LightSampler for ExhaustiveLightSampler {
    fn sample(&self, ctx: &LightSampleContext, u: f64) -> Option<SampledLight> {
        let query = ImportanceQuery::new(ctx);
        self.choose(u, |bounds| bounds.importance_for(&query))
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        let query = ImportanceQuery::new(ctx);
        self.probability(light, |bounds| bounds.importance_for(&query))
    }

    fn sample_emitter(&self, u: f64) -> Option<SampledLight> {
        self.choose(u, |bounds| bounds.phi)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.probability(light, |bounds| bounds.phi)
    }
}
