use lights::bounds::LightSampleContext;
use lights::glam::{Vec2, Vec3};
use lights::samplers::LightSampler;

use super::PathSettings;
use super::direct::{Arrived, Scatters, Unshadowed};
use super::light_sum::LightSum;
use super::path_state::{PathState, PathVertex};
use crate::bsdf::{BsdfSample, Scattering};
use crate::{Ray, SampleStream, Surface, World};

/// Follows the camera ray `ray` through `world`, with lights chosen by `sampler`: adds an unbiased
/// estimate of the radiance along it to `sum`, over paths of at most `settings.max_depth` segments.
/// Returns the number of rays traced.
pub(crate) fn trace<S: LightSampler, L: LightSum>(
    world: &World,
    sampler: &S,
    settings: &PathSettings,
    mut ray: Ray,
    stream: &SampleStream,
    sum: &mut L,
) -> u32 {
    let mut path = PathState::new(world, sampler, settings, sum);
    let mut from = None;
    for number in 0..settings.max_depth {
        path.rays += 1;
        let Some(surface) = world.closest(&ray, from) else {
            path.add_sky(&ray);
            break;
        };
        path.add_emission(&surface, ray.direction);
        if number + 1 == settings.max_depth {
            break;
        }
        let scattering = world.scattering(&surface);
        let vertex = SurfaceVertex {
            surface,
            scattering,
        };
        let arrived = |light: &Unshadowed| {
            let shadowed = world.occluded(&surface, light.wi, light.p_light);
            let left = if shadowed { Vec3::ZERO } else { Vec3::ONE };
            Arrived { left, rays: 1 }
        };
        let Some(wi) = path.scatter(&vertex, -ray.direction, number, stream, arrived) else {
            break;
        };
        ray = surface.spawn(wi);
        from = Some(surface.primitive);
    }
    path.rays
}

/// A vertex of a path on a surface.
struct SurfaceVertex {
    surface: Surface,
    scattering: Scattering,
}

impl Scatters for SurfaceVertex {
    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        self.scattering.eval(wo, wi)
    }

    #[inline]
    fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.scattering.pdf(wo, wi)
    }
}

impl PathVertex for SurfaceVertex {
    #[inline]
    fn is_dirac(&self) -> bool {
        self.scattering.bsdf().is_dirac()
    }

    #[inline]
    fn light_context(&self, world: &World, wo: Vec3) -> LightSampleContext {
        world.light_context(&self.surface, &self.scattering, wo)
    }

    #[inline]
    fn sample(&self, wo: Vec3, u_lobe: f32, u: Vec2) -> Option<BsdfSample> {
        self.scattering.sample(wo, u_lobe, u)
    }
}
