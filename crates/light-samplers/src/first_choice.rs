use light_bounds::SampledLight;
use light_math::float::positive_product;

/// The result of the choice between lights at infinity and all others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FirstChoice {
    /// A light at infinity.
    Infinite(SampledLight),
    /// One of the other lights: the probability of this branch, and the unused part of `u`.
    Others { pmf: f32, u: u64 },
}

/// The probability of the first choice that leads to a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FirstPmf {
    /// The light is at infinity, and this is its own probability.
    Infinite(f32),
    /// It is one of the others, if any; this is the probability of all of them.
    Others(f32),
}

impl FirstChoice {
    /// The light: that at infinity, or the one of the others that `sample` returns for the unused part
    /// of `u`.
    #[inline(always)]
    pub(crate) fn then(
        self,
        sample: impl FnOnce(u64) -> Option<SampledLight>,
    ) -> Option<SampledLight> {
        match self {
            Self::Infinite(light) => Some(light),
            Self::Others { pmf, u } => sample(u).map(|light| SampledLight {
                pmf: positive_product(pmf, light.pmf),
                ..light
            }),
        }
    }
}

impl FirstPmf {
    /// The probability of the light: its own, or that of all others times its `pmf` among them.
    #[inline(always)]
    pub(crate) fn then(self, pmf: impl FnOnce() -> f32) -> f32 {
        match self {
            Self::Infinite(pmf) => pmf,
            Self::Others(others) => positive_product(others, pmf()),
        }
    }
}
