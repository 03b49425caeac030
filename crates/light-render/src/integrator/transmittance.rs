use lights::glam::Vec3;
use lights::sources::MediumId;

use super::direct::Arrived;
use super::volume_vertex::VolumeRay;
use crate::{Ray, Surface, World};

/// The most boundaries that a ray crosses: one that crosses more is caught between coincident
/// surfaces, and dropped.
pub(super) const MAX_CROSSINGS: u32 = 1 << 10;

/// An unbiased estimate of the transmittance between the start of `from` and the point `target`
/// through media and their boundaries; `None` for a target at infinity.
pub(super) fn transmittance(
    world: &World,
    mut from: VolumeRay,
    target: Option<Vec3>,
    next_u: &mut impl FnMut() -> f32,
) -> Arrived {
    /// The tested part of the way: it ends before the light itself.
    const PART: f32 = 1.0 - 1e-4;
    let mut left = Vec3::ONE;
    for rays in 1..=MAX_CROSSINGS {
        let distance = match target {
            Some(target) => {
                let way = target - from.ray.origin;
                let distance = way.length();
                if !(distance > 0.0) {
                    return Arrived { left, rays };
                }
                from.ray.direction = way / distance;
                distance
            }
            None => f32::INFINITY,
        };
        let VolumeRay { ray, medium, .. } = from;
        if !world.media().have_interfaces {
            if world.blocked(&ray, distance * PART, from.from) {
                return Arrived::nothing(rays);
            }
            left *= world.media().transmittance(medium, &ray, distance, next_u);
            return Arrived { left, rays };
        }
        let hit = world.closest(&ray, from.from);
        let hit = hit.map(|surface| (surface, (surface.p - ray.origin).length()));
        let Some((surface, reached)) = hit.filter(|(_, reached)| *reached < distance * PART) else {
            left *= world.media().transmittance(medium, &ray, distance, next_u);
            return Arrived { left, rays };
        };
        if !world.is_interface(&surface) {
            return Arrived::nothing(rays);
        }
        left *= world.media().transmittance(medium, &ray, reached, next_u);
        if left == Vec3::ZERO {
            return Arrived::nothing(rays);
        }
        from = across(world, &surface, &ray, medium);
    }
    Arrived::nothing(MAX_CROSSINGS)
}

/// The same ray on the other side of an interface.
pub(super) fn across(
    world: &World,
    surface: &Surface,
    ray: &Ray,
    medium: Option<MediumId>,
) -> VolumeRay {
    VolumeRay {
        ray: surface.spawn(ray.direction),
        from: Some(surface.primitive),
        medium: world.medium_toward(surface, ray.direction, medium),
    }
}
