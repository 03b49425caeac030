use lights::bounds::LightId;
use lights::glam::Vec3;

use crate::LightLayers;

/// Adds up the light of a path.
pub(crate) trait LightSum {
    /// Adds the radiance that `light` has emitted; `None` for emission of media.
    fn add(&mut self, light: Option<LightId>, radiance: Vec3);

    /// Back to zero.
    fn clear(&mut self);

    /// The sum of each layer.
    fn layers(&self) -> &[Vec3];
}

/// The light of all lights together.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Total(pub(crate) Vec3);

impl LightSum for Total {
    #[inline]
    fn add(&mut self, _: Option<LightId>, radiance: Vec3) {
        self.0 += radiance;
    }

    #[inline]
    fn clear(&mut self) {
        self.0 = Vec3::ZERO;
    }

    #[inline]
    fn layers(&self) -> &[Vec3] {
        core::slice::from_ref(&self.0)
    }
}

/// The light of each layer.
#[derive(Clone, Debug)]
pub(crate) struct LayerSums<'a> {
    layers: &'a LightLayers,
    sums: Vec<Vec3>,
}

impl<'a> LayerSums<'a> {
    /// No light.
    pub(crate) fn new(layers: &'a LightLayers) -> Self {
        let sums = vec![Vec3::ZERO; layers.names().len()];
        Self { layers, sums }
    }
}

impl LightSum for LayerSums<'_> {
    #[inline]
    fn add(&mut self, light: Option<LightId>, radiance: Vec3) {
        self.sums[self.layers.of(light)] += radiance;
    }

    fn clear(&mut self) {
        self.sums.fill(Vec3::ZERO);
    }

    fn layers(&self) -> &[Vec3] {
        &self.sums
    }
}
