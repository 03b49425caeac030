use core::ops::ControlFlow;

use light_bounds::{InfiniteBounds, LightExtent, LightId, LightSampleContext, SampledLight};
use light_bvh::{CutDetail, LightBvh, LightBvhError, LightBvhOptions};

use crate::bvh_cut::{BvhLightCut, CutChoices};
use crate::first_choice::{FirstChoice, FirstPmf};
use crate::infinite_lights::{InfiniteLights, irradiance};
use crate::light_sampler::stratum;
use crate::prepared_choices::Preparation;
use crate::{LightSampler, PreparedChoices};

/// The least number of choices per call for which a cut is faster than single choices.
const FEWEST_OF_CUT: u32 = 2;

/// The default: chooses about in proportion to the irradiance that each light would give without
/// occlusion.
///
/// Reads `ctx.ns`. Lights at infinity are weighed by their own estimated irradiance against that of
/// the tree. 26 to 28 bytes a light; a query evaluates a node of sixteen
/// children a level, and every light at infinity.
#[derive(Clone, Debug, Default)]
pub struct BvhLightSampler {
    tree: LightBvh,
    infinite: InfiniteLights,
}

impl BvhLightSampler {
    /// A sampler of `lights`; the index of a light is its id.
    ///
    /// # Errors
    /// As for [`LightBvh::build`].
    pub fn new(lights: &[LightExtent]) -> Result<Self, LightBvhError> {
        Self::with(lights, &LightBvhOptions::default())
    }

    /// A sampler whose tree is built with `options`.
    ///
    /// # Errors
    /// As for [`LightBvh::build`].
    pub fn with(lights: &[LightExtent], options: &LightBvhOptions) -> Result<Self, LightBvhError> {
        Ok(Self {
            tree: LightBvh::build_with(lights, options)?,
            infinite: InfiniteLights::new(lights),
        })
    }

    /// Refits the tree to lights that moved, turned, or changed their power, in linear time; the
    /// lights at infinity are replaced. Allocates nothing unless more of these emit than before.
    ///
    /// # Errors
    /// As for [`LightBvh::refit`]; the sampler is then as it was.
    pub fn refit(&mut self, lights: &[LightExtent]) -> Result<(), LightBvhError> {
        self.tree.refit(lights)?;
        self.infinite.replace(lights);
        Ok(())
    }

    /// The tree of the lights with a position.
    #[must_use]
    pub const fn tree(&self) -> &LightBvh {
        &self.tree
    }

    /// A cut through the tree for `ctx`, for several choices there.
    #[must_use]
    pub fn cut(&self, ctx: &LightSampleContext, detail: CutDetail) -> BvhLightCut<'_> {
        BvhLightCut::new(&self.tree, &self.infinite, ctx, detail)
    }

    /// Estimated irradiance at `ctx` from the lights of the tree; only needed if there are lights
    /// at infinity.
    #[inline]
    fn tree_irradiance(&self, ctx: &LightSampleContext) -> f64 {
        if self.infinite.is_empty() {
            1.0
        } else {
            self.tree.irradiance(ctx)
        }
    }

    /// Chooses one light, and stores in `prepared` the irradiance from the tree.
    #[inline]
    fn sample_prepared(
        &self,
        ctx: &LightSampleContext,
        u: f64,
        prepared: &mut Preparation,
    ) -> Option<SampledLight> {
        if self.infinite.is_empty() {
            *prepared = Preparation::Tree { in_tree: 1.0 };
            return self.tree.sample(ctx, u);
        }
        let weight = |bounds: &InfiniteBounds| irradiance(bounds, ctx);
        self.tree.view().sample_with_infinite(ctx, |irradiance| {
            let in_tree = irradiance * self.tree.power();
            *prepared = Preparation::Tree { in_tree };
            match self.infinite.first(u, in_tree, weight) {
                FirstChoice::Others { pmf, u } => ControlFlow::Continue((pmf, u)),
                FirstChoice::Infinite(light) => ControlFlow::Break(light),
            }
        })
    }

    /// The probability of `light`, where `in_tree` is the irradiance from the tree at `ctx`.
    #[inline]
    fn pmf_with_infinite(&self, ctx: &LightSampleContext, in_tree: f64, light: LightId) -> f32 {
        if self.infinite.is_empty() {
            return self.tree.pmf(ctx, light);
        }
        let weight = |bounds: &InfiniteBounds| irradiance(bounds, ctx);
        match self.infinite.first_pmf(light, in_tree, weight) {
            FirstPmf::Others(pmf) => self.tree.view().pmf_after(ctx, pmf, light),
            FirstPmf::Infinite(pmf) => pmf,
        }
    }
}

impl LightSampler for BvhLightSampler {
    #[inline]
    fn sample(&self, ctx: &LightSampleContext, u: f64) -> Option<SampledLight> {
        self.sample_prepared(ctx, u, &mut Preparation::default())
    }

    #[inline]
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.pmf_with_infinite(ctx, self.tree_irradiance(ctx), light)
    }

    fn sample_emitter(&self, u: f64) -> Option<SampledLight> {
        match self.infinite.first(u, self.tree.power(), fluence) {
            FirstChoice::Others { pmf, u } => self.tree.view().sample_emitter_after(pmf, u),
            FirstChoice::Infinite(light) => light,
        }
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        match self.infinite.first_pmf(light, self.tree.power(), fluence) {
            FirstPmf::Others(pmf) => self.tree.view().pmf_emitter_after(pmf, light),
            FirstPmf::Infinite(pmf) => pmf,
        }
    }

    fn sample_many(
        &self,
        ctx: &LightSampleContext,
        u: f64,
        count: u32,
        each: &mut dyn FnMut(SampledLight),
    ) {
        self.sample_many_prepared(ctx, u, count, &mut PreparedChoices::default(), each);
    }

    fn pmf_many(&self, ctx: &LightSampleContext, light: LightId, count: u32) -> f32 {
        self.pmf_many_prepared(ctx, light, count, &PreparedChoices::default())
    }

    fn sample_many_prepared(
        &self,
        ctx: &LightSampleContext,
        u: f64,
        count: u32,
        prepared: &mut PreparedChoices,
        each: &mut dyn FnMut(SampledLight),
    ) {
        if count < FEWEST_OF_CUT {
            prepared.preparation = Preparation::Nothing;
            let preparation = &mut prepared.preparation;
            let choice = |i| self.sample_prepared(ctx, stratum(i, count, u), preparation);
            (0..count).filter_map(choice).for_each(each);
        } else {
            prepared.preparation = Preparation::Cut;
            let cut = &mut prepared.cut;
            cut.rebuild(&self.tree.view(), ctx, CutDetail::default());
            CutChoices::new(&self.tree, &self.infinite, ctx, cut).sample_many(u, count, each);
        }
    }

    fn pmf_many_prepared(
        &self,
        ctx: &LightSampleContext,
        light: LightId,
        count: u32,
        prepared: &PreparedChoices,
    ) -> f32 {
        match prepared.preparation {
            Preparation::Tree { in_tree } => self.pmf_with_infinite(ctx, in_tree, light),
            Preparation::Cut => {
                CutChoices::new(&self.tree, &self.infinite, ctx, &prepared.cut).pmf(light)
            }
            Preparation::Nothing if count < FEWEST_OF_CUT => self.pmf(ctx, light),
            Preparation::Nothing => self.cut(ctx, CutDetail::default()).pmf(light),
        }
    }
}

fn fluence(bounds: &InfiniteBounds) -> f64 {
    f64::from(bounds.fluence)
}
