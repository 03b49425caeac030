use lights::bounds::LightId;
use lights::glam::Vec3;

use crate::{Ray, World};

/// The infinite lights that are seen along a ray that leaves the scene, with their radiance.
#[inline]
pub(super) fn sky<'a>(
    world: &'a World,
    ray: &'a Ray,
) -> impl Iterator<Item = (LightId, Vec3)> + use<'a> {
    let lights = world.infinite_lights().iter();
    let seen = lights.map(|&light| (light, world.sky_radiance(light, ray)));
    seen.filter(|(_, le)| *le != Vec3::ZERO)
}
