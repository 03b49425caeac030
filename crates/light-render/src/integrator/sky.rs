use lights::bounds::LightId;
use lights::glam::Vec3;

use crate::{Ray, World};

/// The radiance of all infinite lights along a ray that leaves the scene, each times its `weight`.
pub(super) fn sky(world: &World, ray: &Ray, weight: impl Fn(LightId) -> f32) -> Vec3 {
    let mut radiance = Vec3::ZERO;
    for &light in world.infinite_lights() {
        let le = world.sky_radiance(light, ray);
        if le != Vec3::ZERO {
            radiance += le * weight(light);
        }
    }
    radiance
}
