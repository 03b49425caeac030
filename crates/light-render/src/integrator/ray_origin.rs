use lights::bounds::LightId;
use lights::glam::Vec3;
use lights::samplers::LightSampler;

use super::direct::{DirectLight, LightQuery};
use crate::Ray;

/// How the current ray was chosen, which decides how the light it finds is weighted.
#[derive(Clone, Copy, Debug)]
pub(super) enum Origin {
    /// By the camera or by a Dirac: no light sample could have found the same light.
    Dirac,
    /// By the material where light was asked for so, with this density in sr^-1.
    Material { query: LightQuery, pdf: f32 },
}

impl Origin {
    /// The weight of the light `light` that the ray finds in the direction `wi`.
    #[inline]
    pub(super) fn weight<S: LightSampler>(
        self,
        direct: &DirectLight<'_, S>,
        light: LightId,
        wi: Vec3,
    ) -> f32 {
        match self {
            Self::Dirac => 1.0,
            Self::Material { query, pdf } => direct
                .estimator
                .bsdf_weight(pdf, || direct.density(&query, light, wi)),
        }
    }
}

/// The light of all infinite lights along a ray that leaves the scene.
pub(super) fn sky<S: LightSampler>(direct: &DirectLight<'_, S>, ray: &Ray, origin: Origin) -> Vec3 {
    let mut radiance = Vec3::ZERO;
    for &light in direct.world.infinite_lights() {
        let le = direct.world.sky_radiance(light, ray);
        if le == Vec3::ZERO {
            continue;
        }
        let weight = origin.weight(direct, light, ray.direction);
        radiance += le * weight;
    }
    radiance
}
