use light_bounds::{LightId, SampledLight};
use light_math::float::positive_product;

/// Identifies a light of an [`InstancedLightBvh`](crate::InstancedLightBvh): the position of its
/// placement, and its own position in the prototype.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PlacedLight {
    /// The position of the placement.
    pub placement: u32,
    /// The light of the prototype.
    pub light: LightId,
}

/// A light chosen at random, the probability of that choice, and the unused part of the random
/// number: a [`SampledLight`](light_bounds::SampledLight) of a tree of trees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledPlacedLight {
    /// The light.
    pub light: PlacedLight,
    /// Probability of this light, above 0 and at most 1: the bits that a query of its pmf returns.
    pub pmf: f32,
    /// Unused part of `u`: given the light, a uniform [fraction](light_math::fraction) of 2^64.
    pub u: u64,
}

impl SampledPlacedLight {
    /// The choice of a light of a prototype after that of a placement, which had probability
    /// `pmf`.
    #[inline]
    pub(crate) fn of(placement: u32, pmf: f32, chosen: &SampledLight) -> Self {
        Self {
            light: PlacedLight {
                placement,
                light: chosen.light,
            },
            pmf: positive_product(pmf, chosen.pmf),
            u: chosen.u,
        }
    }
}
