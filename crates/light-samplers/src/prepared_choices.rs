use light_bvh::LightCut;

/// Results of a sampler's choices at one context, kept for probability queries at the same context.
///
/// Overwritten by [`sample_many_prepared`](crate::LightSampler::sample_many_prepared). About 2 KB.
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

/// Which results are kept.
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
    /// The irradiance from the tree.
    Tree { in_tree: f64 },
    /// A cut.
    Cut,
}
