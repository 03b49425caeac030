use core::ops::ControlFlow;

use light_bounds::{InfiniteBounds, LightExtent, LightId, LightSampleContext, SampledLight};
use light_bvh::{CutDetail, LightBvh, LightBvhError, LightBvhOptions};

use crate::bvh_cut::{BvhLightCut, SeenLights};
use crate::light_look::Seen;
use crate::light_sampler::stratum;
use crate::sky::{FirstChoice, FirstPmf, Sky, irradiance};
use crate::{LightLook, LightSampler};

/// Choices of one call from which on it pays to look at all lights more closely first.
const FEWEST_OF_CUT: u32 = 2;

/// The default: chooses about in proportion to the irradiance that each light would give without occlusion.
///
/// Reads `ctx.ns`. Lights at infinity take part with their own estimated irradiance beside that of the tree, so that a strong sun and
/// ten thousand lamps share sensibly by day and by night. About 27 bytes a light; a query takes a node of sixteen children a level,
/// and looks at every light at infinity.
#[derive(Clone, Debug, Default)]
pub struct BvhLightSampler {
    tree: LightBvh,
    sky: Sky,
}

impl BvhLightSampler {
    /// A sampler of `lights`; the index of a light is its id.
    ///
    /// # Errors
    /// As for [`LightBvh::build`].
    pub fn new(lights: &[LightExtent]) -> Result<Self, LightBvhError> {
        Self::with(lights, &LightBvhOptions::default())
    }

    /// A sampler whose tree is built as `options` say.
    ///
    /// # Errors
    /// As for [`LightBvh::build`].
    pub fn with(lights: &[LightExtent], options: &LightBvhOptions) -> Result<Self, LightBvhError> {
        Ok(Self {
            tree: LightBvh::build_with(lights, options)?,
            sky: Sky::new(lights),
        })
    }

    /// Follows lights that moved, turned, or changed their power, in time linear in them; the lights at infinity are taken anew.
    ///
    /// # Errors
    /// As for [`LightBvh::refit`]; the sampler is then as it was.
    pub fn refit(&mut self, lights: &[LightExtent]) -> Result<(), LightBvhError> {
        self.tree.refit(lights)?;
        self.sky = Sky::new(lights);
        Ok(())
    }

    /// The tree of the lights that are somewhere.
    #[must_use]
    pub const fn tree(&self) -> &LightBvh {
        &self.tree
    }

    /// A closer look at the lights from `ctx`, which pays when several of them are chosen there.
    #[must_use]
    pub fn cut(&self, ctx: &LightSampleContext, detail: CutDetail) -> BvhLightCut<'_> {
        BvhLightCut::new(&self.tree, &self.sky, ctx, detail)
    }

    /// About the irradiance at `ctx` by the lights of the tree, if there are others to compare them with.
    #[inline]
    fn worth_beside_sky(&self, ctx: &LightSampleContext) -> f64 {
        if self.sky.is_empty() {
            1.0
        } else {
            self.tree.irradiance(ctx)
        }
    }

    /// One light, and in `look` what the tree is worth.
    #[inline]
    fn sample_looking(
        &self,
        ctx: &LightSampleContext,
        u: f64,
        look: &mut Seen,
    ) -> Option<SampledLight> {
        if self.sky.is_empty() {
            *look = Seen::FromAfar { in_tree: 1.0 };
            return self.tree.sample(ctx, u);
        }
        let worth = |bounds: &InfiniteBounds| irradiance(bounds, ctx);
        self.tree.view().sample_with_infinite(ctx, |irradiance| {
            let in_tree = irradiance * self.tree.power();
            *look = Seen::FromAfar { in_tree };
            match self.sky.first(u, in_tree, worth) {
                FirstChoice::Tree { pmf, u } => ControlFlow::Continue((pmf, u)),
                FirstChoice::Sky(light) => ControlFlow::Break(light),
            }
        })
    }

    /// The probability of `light`, where those of the tree are worth `in_tree` at `ctx`.
    #[inline]
    fn pmf_beside_sky(&self, ctx: &LightSampleContext, in_tree: f64, light: LightId) -> f32 {
        if self.sky.is_empty() {
            return self.tree.pmf(ctx, light);
        }
        let worth = |bounds: &InfiniteBounds| irradiance(bounds, ctx);
        match self.sky.first_pmf(light, in_tree, worth) {
            FirstPmf::Tree(pmf) => self.tree.view().pmf_after(ctx, pmf, light),
            FirstPmf::Sky(pmf) => pmf,
        }
    }
}

impl LightSampler for BvhLightSampler {
    #[inline]
    fn sample(&self, ctx: &LightSampleContext, u: f64) -> Option<SampledLight> {
        self.sample_looking(ctx, u, &mut Seen::default())
    }

    #[inline]
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.pmf_beside_sky(ctx, self.worth_beside_sky(ctx), light)
    }

    fn sample_emitter(&self, u: f64) -> Option<SampledLight> {
        match self.sky.first(u, self.tree.power(), fluence) {
            FirstChoice::Tree { pmf, u } => self.tree.view().sample_emitter_after(pmf, u),
            FirstChoice::Sky(light) => light,
        }
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        match self.sky.first_pmf(light, self.tree.power(), fluence) {
            FirstPmf::Tree(pmf) => self.tree.view().pmf_emitter_after(pmf, light),
            FirstPmf::Sky(pmf) => pmf,
        }
    }

    fn sample_many(
        &self,
        ctx: &LightSampleContext,
        u: f64,
        count: u32,
        each: &mut dyn FnMut(SampledLight),
    ) {
        self.sample_many_looking(ctx, u, count, &mut LightLook::default(), each);
    }

    fn pmf_many(&self, ctx: &LightSampleContext, light: LightId, count: u32) -> f32 {
        self.pmf_many_looking(ctx, light, count, &LightLook::default())
    }

    fn sample_many_looking(
        &self,
        ctx: &LightSampleContext,
        u: f64,
        count: u32,
        look: &mut LightLook,
        each: &mut dyn FnMut(SampledLight),
    ) {
        if count < FEWEST_OF_CUT {
            look.seen = Seen::Never;
            let seen = &mut look.seen;
            let choice = |i| self.sample_looking(ctx, stratum(i, count, u), seen);
            (0..count).filter_map(choice).for_each(each);
        } else {
            look.seen = Seen::Closely;
            let cut = &mut look.cut;
            cut.rebuild(&self.tree.view(), ctx, CutDetail::default());
            SeenLights::new(&self.tree, &self.sky, ctx, cut).sample_many(u, count, each);
        }
    }

    fn pmf_many_looking(
        &self,
        ctx: &LightSampleContext,
        light: LightId,
        count: u32,
        look: &LightLook,
    ) -> f32 {
        match look.seen {
            Seen::FromAfar { in_tree } => self.pmf_beside_sky(ctx, in_tree, light),
            Seen::Closely => SeenLights::new(&self.tree, &self.sky, ctx, &look.cut).pmf(light),
            Seen::Never if count < FEWEST_OF_CUT => self.pmf(ctx, light),
            Seen::Never => self.cut(ctx, CutDetail::default()).pmf(light),
        }
    }
}

fn fluence(bounds: &InfiniteBounds) -> f64 {
    f64::from(bounds.fluence)
}
