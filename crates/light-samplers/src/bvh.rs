use alloc::vec::Vec;

use light_bounds::{LightExtent, LightGroups, LightId, LightSampleContext, SampledLight};
use light_bvh::{LightBvh, LightBvhError, LightBvhOptions};

use crate::infinite_lights::{InfiniteLights, StoredInfiniteLight, emitting};
use crate::{BvhLightSamplerRef, LightChoices, LightSampler};

/// The default: chooses about in proportion to the irradiance that each light would give without
/// occlusion.
///
/// Lights at infinity are weighed by their own estimated irradiance against that of the tree. 24 to
/// 29 bytes a light; a query evaluates a node of sixteen children a level, and every light at
/// infinity.
#[derive(Clone, Debug, Default)]
pub struct BvhLightSampler {
    tree: LightBvh,
    infinite: Vec<StoredInfiniteLight>,
    /// Of all lights by id; empty if all are in all groups.
    groups: Vec<LightGroups>,
}

impl BvhLightSampler {
    /// A sampler of `lights`; the index of a light is its id.
    ///
    /// # Errors
    /// As for [`LightBvh::build`].
    pub fn new(lights: &[LightExtent]) -> Result<Self, LightBvhError> {
        Self::with_options(lights, &LightBvhOptions::default())
    }

    /// A sampler whose tree is built with `options`.
    ///
    /// # Errors
    /// As for [`LightBvh::build`].
    pub fn with_options(
        lights: &[LightExtent],
        options: &LightBvhOptions,
    ) -> Result<Self, LightBvhError> {
        Ok(Self {
            tree: LightBvh::build_with(lights, options)?,
            infinite: emitting(lights, &[]).collect(),
            groups: Vec::new(),
        })
    }

    /// Refits the tree to lights that moved, turned, or changed their power, in linear time; the
    /// lights at infinity are replaced. Allocates nothing unless more of these emit than before.
    ///
    /// # Errors
    /// As for [`LightBvh::refit`]; the sampler is then as it was.
    pub fn refit(&mut self, lights: &[LightExtent]) -> Result<(), LightBvhError> {
        self.tree.refit(lights)?;
        self.infinite.clear();
        self.infinite.extend(emitting(lights, &self.groups));
        Ok(())
    }

    /// Sets the groups of all lights, one entry for each in the order of ids: contexts then choose
    /// among the lights of their [groups](LightSampleContext::with_groups). Refits keep them.
    ///
    /// # Errors
    /// As for [`LightBvh::set_groups`]; the sampler is then as it was.
    pub fn set_groups(&mut self, groups: Vec<LightGroups>) -> Result<(), LightBvhError> {
        self.tree.set_groups(&groups)?;
        for light in &mut self.infinite {
            light.groups = groups[light.light.index()];
        }
        self.groups = groups;
        Ok(())
    }

    /// The tree of the lights with a position.
    #[must_use]
    pub const fn tree(&self) -> &LightBvh {
        &self.tree
    }

    /// What queries need, borrowed.
    #[inline]
    #[must_use]
    pub fn view(&self) -> BvhLightSamplerRef<'_> {
        BvhLightSamplerRef {
            tree: self.tree.view(),
            power: self.tree.power(),
            infinite: InfiniteLights::of_valid(&self.infinite),
        }
    }
}

impl LightSampler for BvhLightSampler {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        self.view().sample(ctx, u)
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        self.view().pmf(ctx, light)
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        self.view().choices_at(ctx, count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        self.view().sample_emitter(u)
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        self.view().pmf_emitter(light)
    }
}
