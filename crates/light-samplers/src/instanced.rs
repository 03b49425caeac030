use alloc::vec::Vec;
use core::fmt;

use light_bounds::{
    InfiniteBounds, InfiniteBoundsError, LightGroups, LightId, LightSampleContext, SampledLight,
};
use light_bvh::{InstancedLightBvh, InstancedLightBvhError, PlacedLight, Placement};

use crate::bvh_choices::BvhChoices;
use crate::id_count::MOST;
use crate::infinite_lights::{InfiniteLights, StoredInfiniteLight};
use crate::placed_lights_at::{PlacedLightsAt, numbered};
use crate::{LightChoices, LightSampler};

/// A tree of trees as a sampler: lights that are placed many times are stored once.
///
/// The ids are those of the placed lights, in the order of [`InstancedLightBvh::light_index`], then
/// those of the lights at infinity. An [`InstancedLightBvh`] alone has no limit of 2^32 lights.
#[derive(Clone, Debug)]
pub struct InstancedBvhLightSampler {
    tree: InstancedLightBvh,
    infinite: Vec<StoredInfiniteLight>,
}

impl InstancedBvhLightSampler {
    /// A sampler of the lights of `tree` and of lights at infinity.
    ///
    /// # Errors
    /// More than 2^32 - 1 lights, for which ids are too short; the first light at infinity with
    /// invalid bounds.
    pub fn new(
        tree: InstancedLightBvh,
        infinite: &[InfiniteBounds],
    ) -> Result<Self, InstancedBvhLightSamplerError> {
        let first = u32::try_from(tree.light_count()).map_err(|_| TOO_MANY)?;
        u32::try_from(infinite.len())
            .ok()
            .and_then(|count| first.checked_add(count))
            .ok_or(TOO_MANY)?;
        let ids = (first..).map(LightId);
        Self::with_ids(tree, ids.zip(infinite.iter().copied()))
    }

    /// A sampler of the lights of `tree`, and of lights at infinity whose ids are among those of
    /// the tree, in ascending order: a prototype that was made of all lights of a scene has places
    /// for them, where it is dark.
    ///
    /// # Errors
    /// More than 2^32 - 1 lights; ids that are not in order, or not among those of the tree; the
    /// first light at infinity with invalid bounds.
    pub fn with_infinite_among(
        tree: InstancedLightBvh,
        infinite: &[(LightId, InfiniteBounds)],
    ) -> Result<Self, InstancedBvhLightSamplerError> {
        let count = u32::try_from(tree.light_count());
        let count = count.map_err(|_| TOO_MANY)?;
        let is_sorted = infinite.is_sorted_by(|(a, _), (b, _)| a < b);
        if !is_sorted || infinite.last().is_some_and(|(last, _)| last.0 >= count) {
            return Err(InstancedBvhLightSamplerError::InfiniteIds);
        }
        Self::with_ids(tree, infinite.iter().copied())
    }

    /// A sampler of the lights of `tree` and of lights at infinity in ascending order of their ids.
    fn with_ids(
        tree: InstancedLightBvh,
        infinite: impl Iterator<Item = (LightId, InfiniteBounds)>,
    ) -> Result<Self, InstancedBvhLightSamplerError> {
        let mut lights = Vec::new();
        for (light, bounds) in infinite {
            let bad = |reason| InstancedBvhLightSamplerError::Infinite { light, reason };
            bounds.validate().map_err(bad)?;
            lights.extend(StoredInfiniteLight::emitting(
                light,
                bounds,
                LightGroups::default(),
            ));
        }
        Ok(Self {
            tree,
            infinite: lights,
        })
    }

    /// Refits the upper tree to placements that moved: see [`InstancedLightBvh::refit`].
    ///
    /// # Errors
    /// As for [`InstancedLightBvh::refit`]; the sampler is then as it was.
    pub fn refit(&mut self, placements: &[Placement]) -> Result<(), InstancedLightBvhError> {
        self.tree.refit(placements)
    }

    /// The tree of the lights with a position.
    #[must_use]
    pub const fn tree(&self) -> &InstancedLightBvh {
        &self.tree
    }

    #[inline]
    fn infinite(&self) -> InfiniteLights<'_> {
        InfiniteLights::of_valid(&self.infinite)
    }

    #[inline]
    fn choice_at(&self, ctx: &LightSampleContext) -> BvhChoices<'_, PlacedLightsAt<'_>> {
        let (tree, at) = (&self.tree, self.tree.at(ctx));
        let irradiance = at.irradiance();
        let tree = PlacedLightsAt { tree, at };
        BvhChoices::of(tree, irradiance, self.tree.power(), self.infinite(), ctx)
    }

    /// The placed light of an id, unless that is of a light at infinity.
    #[inline]
    #[must_use]
    pub fn placed_light(&self, light: LightId) -> Option<PlacedLight> {
        self.tree.light_of_index(u64::from(light.0))
    }
}

impl LightSampler for InstancedBvhLightSampler {
    fn sample(&self, ctx: &LightSampleContext, u: u64) -> Option<SampledLight> {
        if self.infinite.is_empty() {
            numbered(&self.tree, self.tree.sample(ctx, u)?)
        } else {
            self.choice_at(ctx).sample(u)
        }
    }

    fn pmf(&self, ctx: &LightSampleContext, light: LightId) -> f32 {
        if self.infinite.is_empty() {
            let placed = self.placed_light(light);
            placed.map_or(0.0, |light| self.tree.pmf(ctx, light))
        } else {
            self.choice_at(ctx).pmf(light)
        }
    }

    fn at<'a>(&'a self, ctx: &LightSampleContext, count: u32) -> LightChoices<'a> {
        LightChoices::in_placements(self.choice_at(ctx), count)
    }

    fn sample_emitter(&self, u: u64) -> Option<SampledLight> {
        let (infinite, power) = (self.infinite(), self.tree.power());
        let first = infinite.first(u, power, StoredInfiniteLight::fluence)?;
        first.then(|u| numbered(&self.tree, self.tree.sample_emitter(u)?))
    }

    fn pmf_emitter(&self, light: LightId) -> f32 {
        let (infinite, power) = (self.infinite(), self.tree.power());
        let first = infinite.first_pmf(light, power, StoredInfiniteLight::fluence);
        let pmf = |light| self.tree.pmf_emitter(light);
        first.then(|| self.placed_light(light).map_or(0.0, pmf))
    }
}

/// More lights than ids.
const TOO_MANY: InstancedBvhLightSamplerError =
    InstancedBvhLightSamplerError::TooManyLights { most: MOST };

/// Why there is no sampler of a tree of trees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InstancedBvhLightSamplerError {
    /// There are more lights than ids of 32 bits.
    TooManyLights {
        /// How many there may be.
        most: usize,
    },
    /// Lights at infinity are not in the order of their ids, or not among those of the tree.
    InfiniteIds,
    /// The bounds of a light at infinity are not valid.
    Infinite {
        /// Which light.
        light: LightId,
        /// Why.
        reason: InfiniteBoundsError,
    },
}

impl fmt::Display for InstancedBvhLightSamplerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyLights { most } => {
                write!(f, "expected at most {most} lights: ids have 32 bits")
            }
            Self::InfiniteIds => {
                f.write_str("lights at infinity: expected ids of the tree, in ascending order")
            }
            Self::Infinite { light, reason } => write!(f, "light {}: {reason}", light.0),
        }
    }
}

impl core::error::Error for InstancedBvhLightSamplerError {}
