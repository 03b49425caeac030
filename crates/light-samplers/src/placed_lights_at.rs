use light_bounds::{LightId, SampledLight};
use light_bvh::{InstancedLightBvh, InstancedLightBvhAt, SampledPlacedLight};

use crate::bvh_choices::InTree;

/// A tree of trees at a context, with the ids of a sampler.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedLightsAt<'a> {
    pub(crate) tree: &'a InstancedLightBvh,
    pub(crate) at: InstancedLightBvhAt<'a>,
}

impl InTree for PlacedLightsAt<'_> {
    #[inline]
    fn sample(&self, u: u64) -> Option<SampledLight> {
        numbered(self.tree, self.at.sample(u)?)
    }

    #[inline]
    fn pmf(&self, light: LightId) -> f32 {
        let placed = self.tree.light_of_index(u64::from(light.0));
        placed.map_or(0.0, |light| self.at.pmf(light))
    }
}

/// The same choice with the id of a sampler.
#[inline]
pub(crate) fn numbered(
    tree: &InstancedLightBvh,
    chosen: SampledPlacedLight,
) -> Option<SampledLight> {
    let index = tree.light_index(chosen.light)?;
    Some(SampledLight {
        light: LightId(u32::try_from(index).ok()?),
        pmf: chosen.pmf,
        u: chosen.u,
    })
}
