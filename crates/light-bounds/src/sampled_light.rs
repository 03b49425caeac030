use crate::LightId;

/// A light chosen at random, the probability of that choice, and the unused part of the random
/// number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledLight {
    /// The light.
    pub light: LightId,
    /// Probability of this light, above 0 and at most 1: the same bits that a query of the light's
    /// pmf returns.
    pub pmf: f32,
    /// Unused part of `u`: given the light, a uniform [fraction](light_math::fraction) of 2^64
    /// again, with as many random bits fewer as the choice took.
    pub u: u64,
}
