use lights::bounds::{LightId, LightSampleContext, SampledLight};
use lights::bvh::visibility::CellTableError;
use lights::samplers::{BvhLightSampler, LightChoices, LightSampler, VisibilityLightSampler};

use super::VisibilityCells;
use crate::{View, World};

/// The default light hierarchy with the cells of a picture.
///
/// In a cell with factors, [`at`](LightSampler::at) makes a single choice for any count: candidates
/// that share a shadow ray undo the gain of the cell.
#[derive(Clone, Debug)]
pub struct CellLightSampler {
    lights: BvhLightSampler,
    cells: VisibilityCells,
}

impl CellLightSampler {
    /// The lights of `world`, and the cells of what `view` shows of it: see
    /// [`VisibilityCells::fill`].
    ///
    /// # Errors
    /// When there are more cells than 32 bits count.
    pub fn new(
        lights: BvhLightSampler,
        world: &World,
        view: &View,
    ) -> Result<Self, CellTableError> {
        let cells = VisibilityCells::fill(world, view, &lights)?;
        Ok(Self { lights, cells })
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
        self.guided().choices(ctx, count.min(1), count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.lights.sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.lights.pmf_emitter(light)
    }
}
