use light_bounds::SampledLight;

/// The result of the choice between lights at infinity and all others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FirstChoice {
    /// A light at infinity, or none.
    Infinite(Option<SampledLight>),
    /// One of the others: the probability of that, and the unused part of `u`.
    Others { pmf: f32, u: f64 },
}
