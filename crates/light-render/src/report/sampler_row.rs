use crate::bench::BenchRow;
use crate::{Comparison, Flip, SamplerKind};

/// What one sampler did on the scene.
#[derive(Debug)]
pub(super) struct SamplerRow {
    pub(super) kind: SamplerKind,
    pub(super) build_ms: f64,
    /// Seconds of the whole picture.
    pub(super) seconds: f64,
    pub(super) samples: u32,
    pub(super) rays: u64,
    pub(super) rejected: u64,
    /// relMSE of the picture, from which the noise of a reference made for the report cancels.
    pub(super) rel_mse: f64,
    /// The picture against the mean of the reference.
    pub(super) comparison: Comparison,
    pub(super) flip_ldr: f64,
    pub(super) flip: Flip,
    /// Seconds, samples a pixel and relMSE of the picture as it grew.
    pub(super) convergence: Vec<(f64, u32, f64)>,
    /// The power of time that relMSE goes with.
    pub(super) slope: Option<f64>,
    pub(super) bytes: usize,
    /// Choices alone, at points of surfaces; `None` where no surface scatters light.
    pub(super) choices: Option<BenchRow>,
    /// The picture.
    pub(super) pixels: Vec<lights::glam::Vec3>,
}

impl SamplerRow {
    /// The quantity of a choice, where it is known: no V is where no point is lit.
    pub(super) fn choice(&self, of: impl FnOnce(&BenchRow) -> f64) -> Option<f64> {
        let quantity = self.choices.as_ref().map(of);
        quantity.filter(|quantity| !quantity.is_nan())
    }
}
