use light_bounds::{LightExtent, LightId, LightSampleContext, SampledLight};
use light_bvh::LightBvhError;
use light_bvh::reference::ReferenceLightBvh;

use crate::infinite_shares::{HasOthers, InfiniteShares};
use crate::{LightChoices, LightSampler};

/// The light hierarchy as published: lights at infinity and the reference tree share one uniform
/// choice.
///
/// Reads the normal of `ctx`, and all of a ray segment. Without a context, lights of the tree are
/// chosen in proportion to power. 68 bytes a light; a query takes two importances a level.
///
/// # Source
/// `[PBRT4]`, section 12.6.3, which has no segments.
#[derive(Clone, Debug)]
pub struct ReferenceBvhLightSampler {
    tree: ReferenceLightBvh,
    infinite: InfiniteShares,
}

impl ReferenceBvhLightSampler {
    /// A sampler of `lights`; the index of a light is its id.
    ///
    /// # Errors
    /// As for [`ReferenceLightBvh::build`].
    pub fn new(lights: &[LightExtent]) -> Result<Self, LightBvhError> {
        let tree = ReferenceLightBvh::build(lights)?;
        let has_others = if tree.is_empty() {
            HasOthers::No
        } else {
            HasOthers::Yes
        };
        Ok(Self {
            infinite: InfiniteShares::new(lights, has_others),
            tree,
        })
    }

    /// The tree of the lights with a position.
    #[must_use]
    pub const fn tree(&self) -> &ReferenceLightBvh {
        &self.tree
    }

    #[inline]
    fn choose(
        &self,
        u: u64,
        in_tree: impl FnOnce(&ReferenceLightBvh, u64) -> Option<SampledLight>,
    ) -> Option<SampledLight> {
        self.infinite.choose(u)?.then(|u| in_tree(&self.tree, u))
    }

    #[inline]
    fn probability(&self, light: LightId, in_tree: impl FnOnce(&ReferenceLightBvh) -> f32) -> f32 {
        self.infinite.first_pmf(light).then(|| in_tree(&self.tree))
    }
}

impl LightSampler for ReferenceBvhLightSampler {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.choose(u, |tree, u| tree.sample(ctx, u))
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.probability(light, |tree| tree.pmf(ctx, light))
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        LightChoices::one_by_one(self, ctx, count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.choose(u, ReferenceLightBvh::sample_emitter)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.probability(light, |tree| tree.pmf_emitter(light))
    }
}
