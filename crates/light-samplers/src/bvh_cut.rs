use light_bounds::{InfiniteBounds, LightId, LightSampleContext, SampledLight};
use light_bvh::{CutDetail, LightBvh, LightCut};

use crate::first_choice::{FirstChoice, FirstPmf};
use crate::infinite_lights::{InfiniteLights, irradiance};
use crate::light_sampler::stratum;

/// A cut through the tree for one context: it makes several choices for little more than the cost
/// of one.
///
/// Made by [`BvhLightSampler::cut`](crate::BvhLightSampler::cut). Its probabilities are its own:
/// they are closer to the lights' contributions than those of the sampler. The pmf of a choice is
/// that of the same cut, or of an equal one.
#[derive(Clone, Debug)]
pub struct BvhLightCut<'a> {
    tree: &'a LightBvh,
    infinite: &'a InfiniteLights,
    ctx: LightSampleContext,
    cut: LightCut,
}

/// The sampler of a borrowed cut.
#[derive(Clone, Copy)]
pub(crate) struct CutChoices<'a> {
    tree: &'a LightBvh,
    infinite: &'a InfiniteLights,
    ctx: &'a LightSampleContext,
    cut: &'a LightCut,
    /// Estimated irradiance from the lights of the tree.
    in_tree: f64,
}

impl<'a> BvhLightCut<'a> {
    pub(crate) fn new(
        tree: &'a LightBvh,
        infinite: &'a InfiniteLights,
        ctx: &LightSampleContext,
        detail: CutDetail,
    ) -> Self {
        Self {
            tree,
            infinite,
            ctx: *ctx,
            cut: LightCut::at(&tree.view(), ctx, detail),
        }
    }

    fn choices(&self) -> CutChoices<'_> {
        CutChoices::new(self.tree, self.infinite, &self.ctx, &self.cut)
    }

    /// One light that may light the point; `None` if none can.
    #[must_use]
    pub fn sample(&self, u: f64) -> Option<SampledLight> {
        self.choices().sample(u)
    }

    /// Probability that [`sample`](Self::sample) returns `light`, with the same bits.
    #[must_use]
    pub fn pmf(&self, light: LightId) -> f32 {
        self.choices().pmf(light)
    }

    /// `count` lights, one for each of the equal parts of `[0, 1)`, all at the place that `u` has
    /// within its part.
    pub fn sample_many(&self, u: f64, count: u32, each: &mut dyn FnMut(SampledLight)) {
        self.choices().sample_many(u, count, each);
    }
}

impl<'a> CutChoices<'a> {
    /// The sampler of `tree` and `sky` for the cut made at `ctx`.
    pub(crate) fn new(
        tree: &'a LightBvh,
        infinite: &'a InfiniteLights,
        ctx: &'a LightSampleContext,
        cut: &'a LightCut,
    ) -> Self {
        Self {
            tree,
            infinite,
            ctx,
            cut,
            in_tree: cut.irradiance() * tree.power(),
        }
    }

    fn sample(&self, u: f64) -> Option<SampledLight> {
        let weight = |bounds: &InfiniteBounds| irradiance(bounds, self.ctx);
        if self.infinite.is_empty() {
            return self.sample_tree(1.0, u);
        }
        match self.infinite.first(u, self.in_tree, weight) {
            FirstChoice::Others { pmf, u } => self.sample_tree(pmf, u),
            FirstChoice::Infinite(light) => light,
        }
    }

    /// The probability of `light` by [`BvhLightCut::sample`].
    pub(crate) fn pmf(&self, light: LightId) -> f32 {
        let weight = |bounds: &InfiniteBounds| irradiance(bounds, self.ctx);
        if self.infinite.is_empty() {
            return self.pmf_tree(1.0, light);
        }
        match self.infinite.first_pmf(light, self.in_tree, weight) {
            FirstPmf::Others(pmf) => self.pmf_tree(pmf, light),
            FirstPmf::Infinite(pmf) => pmf,
        }
    }

    /// [`BvhLightCut::sample_many`].
    pub(crate) fn sample_many(&self, u: f64, count: u32, mut each: impl FnMut(SampledLight)) {
        if self.infinite.is_empty() {
            let us = (0..count).map(|i| stratum(i, count, u));
            let tree = self.tree.view();
            return self.cut.sample_many_at(&tree, self.ctx, 1.0, us, each);
        }
        let choices = (0..count).filter_map(|i| self.sample(stratum(i, count, u)));
        choices.for_each(&mut each);
    }

    fn sample_tree(&self, pmf: f32, u: f64) -> Option<SampledLight> {
        self.cut.sample_at(&self.tree.view(), self.ctx, pmf, u)
    }

    fn pmf_tree(&self, pmf: f32, light: LightId) -> f32 {
        self.cut.pmf_at(&self.tree.view(), self.ctx, pmf, light)
    }
}
