use light_bounds::SampledLight;

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
