use alloc::vec::Vec;

use light_bounds::{LightBounds, LightExtent, LightId, LightSampleContext, SampledLight};
use light_bvh::LightBvhError;
use light_math::discrete;

use crate::id_count::{MOST, id_count};
use crate::infinite_shares::{HasOthers, InfiniteShares};
use crate::{LightChoices, LightSampler};

/// Chooses each light in proportion to its importance, without a hierarchy, in time linear in the
/// number of lights.
///
/// A tree approximates its probabilities. For tests, comparisons and a handful of lights. Reads
/// the normal of `ctx`, and all of a ray segment. Without a context lights are chosen in proportion to power.
/// Lights at infinity share one uniform choice with all others.
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
        id_count(lights.len()).ok_or(LightBvhError::TooManyLights { most: MOST })?;
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

    fn choose(&self, u: u64, weight: impl Fn(&LightBounds) -> f32) -> Option<SampledLight> {
        let weights = |index: usize| weight(&self.bounds[index]);
        self.infinite.choose(u)?.then(|u| {
            let chosen = discrete::sample_by(self.bounds.len(), weights, u)?;
            Some(SampledLight {
                light: id(chosen.index),
                pmf: chosen.pmf,
                u: chosen.u,
            })
        })
    }

    fn probability(&self, light: LightId, weight: impl Fn(&LightBounds) -> f32) -> f32 {
        let weights = |index: usize| weight(&self.bounds[index]);
        let first = self.infinite.first_pmf(light);
        first.then(|| discrete::pmf_by(self.bounds.len(), weights, light.index()))
    }
}

impl LightSampler for ExhaustiveLightSampler {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.choose(u, |bounds| bounds.importance(ctx))
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.probability(light, |bounds| bounds.importance(ctx))
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        LightChoices::one_by_one(self, ctx, count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.choose(u, |bounds| bounds.phi)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.probability(light, |bounds| bounds.phi)
    }
}

/// The id of the light at `index`.
#[expect(
    clippy::cast_possible_truncation,
    reason = "ids are 32 bits, so there are no more lights"
)]
const fn id(index: usize) -> LightId {
    LightId(index as u32)
}
