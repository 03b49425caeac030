use lights::bounds::{LightId, LightSampleContext, SampledLight};
use lights::bvh::visibility::CellTableError;
use lights::samplers::{BvhLightSampler, LightChoices, LightSampler, VisibilityLightSampler};

use super::{ChoiceEstimates, ChoicePlan, VisibilityCells};
use crate::{View, World};

/// The default light hierarchy with the cells of a picture.
///
/// In a cell with factors, [`at`](LightSampler::at) makes a single choice for any count: candidates
/// that share a shadow ray undo the gain of the cell. Elsewhere it follows a [`ChoicePlan`].
#[derive(Clone, Debug)]
pub struct CellLightSampler {
    lights: BvhLightSampler,
    cells: VisibilityCells,
    elsewhere: ChoicePlan,
}

impl CellLightSampler {
    /// The lights of `world`, and the cells of what `view` shows of it: see
    /// [`VisibilityCells::fill`]. Outside of cells they are chosen by the best plan of the
    /// [`ChoiceEstimates`] for paths of at most `max_depth` segments.
    ///
    /// # Errors
    /// When there are more cells than 32 bits count.
    pub fn new(
        lights: BvhLightSampler,
        world: &World,
        view: &View,
        max_depth: u32,
    ) -> Result<Self, CellTableError> {
        let cells = VisibilityCells::fill(world, view, &lights)?;
        let estimates = ChoiceEstimates::new(world, view, &lights, max_depth);
        let elsewhere = estimates.map_or(ChoicePlan::AsAsked, |estimates| estimates.best());
        Ok(Self {
            lights,
            cells,
            elsewhere,
        })
    }

    /// Choices in these `cells` of `lights`, and by the plan `elsewhere`.
    pub(crate) const fn with(
        lights: BvhLightSampler,
        cells: VisibilityCells,
        elsewhere: ChoicePlan,
    ) -> Self {
        Self {
            lights,
            cells,
            elsewhere,
        }
    }

    /// The hierarchy.
    #[must_use]
    pub const fn lights(&self) -> &BvhLightSampler {
        &self.lights
    }

    /// The cells.
    #[must_use]
    pub const fn cells(&self) -> &VisibilityCells {
        &self.cells
    }

    #[inline]
    fn guided(&self) -> VisibilityLightSampler<'_, VisibilityCells> {
        VisibilityLightSampler::new(self.lights.view(), &self.cells)
    }
}

impl LightSampler for CellLightSampler {
    #[inline]
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.guided().sample(ctx, u)
    }

    #[inline]
    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.guided().pmf(ctx, light)
    }

    #[inline]
    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        let [asked, made] = self.elsewhere.counts(count);
        let choices = self.guided().choices(ctx, count.min(1), asked);
        let count = choices.count().min(made);
        choices.with_count(count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.lights.sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.lights.pmf_emitter(light)
    }
}
