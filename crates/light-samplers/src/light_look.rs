use light_bvh::LightCut;

/// What a sampler found out about the lights at one place when it chose several, so that their probabilities may be asked for without
/// finding it out again.
///
/// Filled by [`sample_many_looking`](crate::LightSampler::sample_many_looking), whatever it held before. About 1.8 KB.
#[derive(Clone, Debug, Default)]
pub struct LightLook(pub(crate) Option<LightCut>);
