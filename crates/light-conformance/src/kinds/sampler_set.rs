use lights::bounds::{InfiniteBounds, LightExtent, LightId};
use lights::samplers::{
    ExhaustiveLightSampler, PowerLightSampler, ReferenceBvhLightSampler, UniformLightSampler,
};

use super::bounds::read_light_bounds;
use crate::{Case, Malformed};

/// The samplers of a set of lights.
pub(super) struct Set {
    pub(super) extents: Vec<LightExtent>,
    pub(super) powers: Vec<f32>,
    pub(super) uniform: UniformLightSampler,
    pub(super) power: PowerLightSampler,
    pub(super) bvh: ReferenceBvhLightSampler,
    pub(super) exhaustive: ExhaustiveLightSampler,
}

impl Set {
    pub(super) fn read(case: &Case<'_>) -> Result<Self, Malformed> {
        let mut extents = Vec::new();
        let mut powers = Vec::new();
        for light in case.get("lights")?.items()? {
            powers.push(light.get("power_weight")?.float()?);
            extents.push(match light.find("bounds") {
                Some(bounds) => LightExtent::Bounded(read_light_bounds(&bounds)?),
                None => LightExtent::Infinite(InfiniteBounds::uniform(1.0)),
            });
        }
        Ok(Self {
            uniform: UniformLightSampler::new(extents.len() as u32),
            power: PowerLightSampler::new(&powers).map_err(|e| Malformed(e.to_string()))?,
            bvh: ReferenceBvhLightSampler::new(&extents).map_err(|e| Malformed(e.to_string()))?,
            exhaustive: ExhaustiveLightSampler::new(&extents)
                .map_err(|e| Malformed(e.to_string()))?,
            extents,
            powers,
        })
    }
}

/// The light that an answer names.
pub(super) fn light_id(case: &Case<'_>) -> Result<LightId, Malformed> {
    let index = u32::try_from(case.index()?).map_err(|e| Malformed(e.to_string()))?;
    Ok(LightId(index))
}
