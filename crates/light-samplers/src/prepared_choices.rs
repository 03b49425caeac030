use light_bvh::LightCut;

/// What a sampler prepared for its choices at one context, kept for the probabilities that are
/// asked there later.
///
/// Filled by [`sample_many_prepared`](crate::LightSampler::sample_many_prepared), whatever it held
/// before. About 2 KB.
#[derive(Clone, Debug, Default)]
#[cfg_attr(
    not(feature = "alloc"),
    expect(
        dead_code,
        reason = "only hierarchies, which own memory, keep anything"
    )
)]
pub struct PreparedChoices {
    pub(crate) preparation: Preparation,
    /// The cut, if the preparation is one.
    pub(crate) cut: LightCut,
}

/// What is prepared.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(
    not(feature = "alloc"),
    expect(
        dead_code,
        reason = "only hierarchies, which own memory, keep anything"
    )
)]
pub(crate) enum Preparation {
    /// Nothing.
    #[default]
    Nothing,
    /// The irradiance by the tree.
    Tree { in_tree: f64 },
    /// A cut.
    Cut,
}
