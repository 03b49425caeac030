use light_bounds::SampledLight;

/// The result of the choice between lights at infinity and all others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FirstChoice {
    /// A light at infinity, or none.
    Infinite(Option<SampledLight>),
    /// One of the other lights: the probability of this branch, and the unused part of `u`.
    Others { pmf: f32, u: f64 },
}

/// The probability of the first choice that leads to a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FirstPmf {
    /// The light is at infinity, and this is its own probability.
    Infinite(f32),
    /// It is one of the others, if any; this is the probability of all of them.
    Others(f32),
}

/// `weight / total`: 0 only if the weight is.
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding is what is meant; the floor keeps it above 0"
)]
pub(crate) fn share(weight: f64, total: f64) -> f32 {
    if weight > 0.0 {
        ((weight / total) as f32).max(f32::MIN_POSITIVE)
    } else {
        0.0
    }
}
