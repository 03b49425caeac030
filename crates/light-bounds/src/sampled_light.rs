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
    /// Unused part of `u`: uniform in `[0, 1)` again, given the light, with as many random bits
    /// fewer as the choice took.
    pub u: f64,
}

impl SampledLight {
    /// The largest `f64` below one: the upper end of `u`, which lies in `[0, 1)`.
    pub const MAX_U: f64 = 1.0 - f64::EPSILON / 2.0;

    /// `u` clamped to `[0, 1)`; 0 for NaN.
    #[inline]
    #[must_use]
    pub const fn clamp_u(u: f64) -> f64 {
        match u {
            _ if u >= Self::MAX_U => Self::MAX_U,
            _ if u > 0.0 => u,
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn max_u_is_the_predecessor_of_one() {
        let next = f64::from_bits(SampledLight::MAX_U.to_bits() + 1);
        assert_eq!(next, 1.0, "neighbours");
    }

    #[test]
    fn any_number_is_moved_into_range() {
        for u in [0.0, f64::MIN_POSITIVE, 0.25, SampledLight::MAX_U] {
            assert_eq!(SampledLight::clamp_u(u), u, "as it is");
        }
        for (u, moved) in [
            (-1.0, 0.0),
            (f64::NAN, 0.0),
            (1.0, SampledLight::MAX_U),
            (f64::INFINITY, SampledLight::MAX_U),
        ] {
            assert_eq!(SampledLight::clamp_u(u), moved, "{u}");
        }
    }
}
