use light_bvh::LightCut;

/// What a sampler found out about the lights at one place when it chose there, so that their probabilities may be asked for without
/// finding it out again.
///
/// Filled by [`sample_many_looking`](crate::LightSampler::sample_many_looking), whatever it held before. About 2 KB.
#[derive(Clone, Debug, Default)]
#[cfg_attr(
    not(feature = "alloc"),
    expect(
        dead_code,
        reason = "only hierarchies, which own memory, keep anything"
    )
)]
pub struct LightLook {
    pub(crate) seen: Seen,
    /// What the lights are if they were seen closely.
    pub(crate) cut: LightCut,
}

/// How the lights were looked at.
#[derive(Clone, Copy, Debug, Default)]
#[cfg_attr(
    not(feature = "alloc"),
    expect(
        dead_code,
        reason = "only hierarchies, which own memory, keep anything"
    )
)]
pub(crate) enum Seen {
    /// Not, or nothing was kept.
    #[default]
    Never,
    /// As they are in a tree, which is worth so much.
    FromAfar { in_tree: f64 },
    /// As the cut has them.
    Closely,
}
