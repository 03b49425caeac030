use crate::LightId;

/// A light chosen at random, the probability of that choice, and what is left of the random number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampledLight {
    /// The light.
    pub light: LightId,
    /// Probability of this light, above 0 and at most 1: the same bits that a query of the light's pmf returns.
    pub pmf: f32,
    /// Unused part of `u`: uniform in `[0, 1)` again, given the light, with as many random bits fewer as the choice
    /// took.
    pub u: f64,
}

impl SampledLight {
    /// The largest `f64` below one: the upper end of `u`, which lies in `[0, 1)`.
    pub const MAX_U: f64 = 1.0 - f64::EPSILON / 2.0;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn max_u_is_the_predecessor_of_one() {
        let next = f64::from_bits(SampledLight::MAX_U.to_bits() + 1);
        assert_eq!(next, 1.0, "neighbours");
    }
}
