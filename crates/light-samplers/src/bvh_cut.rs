use light_bounds::{InfiniteBounds, LightId, LightSampleContext, SampledLight};
use light_bvh::{CutDetail, LightBvh, LightCut};

use crate::light_sampler::stratum;
use crate::sky::{FirstChoice, FirstPmf, Sky, irradiance};

/// The lights as one point sees them, looked at closely where that pays: several lights are chosen for little more than one.
///
/// Made by [`BvhLightSampler::cut`](crate::BvhLightSampler::cut). Its probabilities are its own: they are closer to the lights' contributions
/// than those of the sampler, so a light's pmf has to be asked of the cut that chose it, or of an equal one.
#[derive(Clone, Debug)]
pub struct BvhLightCut<'a> {
    tree: &'a LightBvh,
    sky: &'a Sky,
    ctx: LightSampleContext,
    cut: LightCut,
    /// About the irradiance by the tree's lights.
    in_tree: f64,
}

impl<'a> BvhLightCut<'a> {
    pub(crate) fn new(
        tree: &'a LightBvh,
        sky: &'a Sky,
        ctx: &LightSampleContext,
        detail: CutDetail,
    ) -> Self {
        let cut = LightCut::at(&tree.view(), ctx, detail);
        Self {
            tree,
            sky,
            ctx: *ctx,
            in_tree: cut.irradiance() * tree.power(),
            cut,
        }
    }

    /// One light that may light the point; `None` if none can.
    #[must_use]
    pub fn sample(&self, u: f64) -> Option<SampledLight> {
        let worth = |bounds: &InfiniteBounds| irradiance(bounds, &self.ctx);
        if self.sky.is_empty() {
            return self.sample_tree(1.0, u);
        }
        match self.sky.first(u, self.in_tree, worth) {
            FirstChoice::Tree { pmf, u } => self.sample_tree(pmf, u),
            FirstChoice::Sky(light) => light,
        }
    }

    /// Probability that [`sample`](Self::sample) returns `light`, to the bit.
    #[must_use]
    pub fn pmf(&self, light: LightId) -> f32 {
        let worth = |bounds: &InfiniteBounds| irradiance(bounds, &self.ctx);
        if self.sky.is_empty() {
            return self.pmf_tree(1.0, light);
        }
        match self.sky.first_pmf(light, self.in_tree, worth) {
            FirstPmf::Tree(pmf) => self.pmf_tree(pmf, light),
            FirstPmf::Sky(pmf) => pmf,
        }
    }

    /// `count` lights, one for each of the equal parts of `[0, 1)`, all at the place that `u` has within its part.
    pub fn sample_many(&self, u: f64, count: u32, each: &mut dyn FnMut(SampledLight)) {
        for i in 0..count {
            if let Some(sample) = self.sample(stratum(i, count, u)) {
                each(sample);
            }
        }
    }

    fn sample_tree(&self, pmf: f32, u: f64) -> Option<SampledLight> {
        self.cut.sample_at(&self.tree.view(), &self.ctx, pmf, u)
    }

    fn pmf_tree(&self, pmf: f32, light: LightId) -> f32 {
        self.cut.pmf_at(&self.tree.view(), &self.ctx, pmf, light)
    }
}
