use lights::samplers::LightSampler;

use super::{
    Integrator, LightSum, PathSettings, Total, Traced, trace, trace_single_scattering, trace_volume,
};
use crate::{Ray, SampleStream, World};

/// The light along a camera ray, by the integrator that `settings` name.
#[inline]
#[must_use]
pub fn li<S: LightSampler>(
    world: &World,
    sampler: &S,
    settings: &PathSettings,
    ray: Ray,
    stream: &SampleStream,
) -> Traced {
    let mut sum = Total::default();
    let rays = add_li(world, sampler, settings, ray, stream, &mut sum);
    let Total(radiance) = sum;
    Traced { radiance, rays }
}

/// Adds the light along a camera ray to `sum`, and returns the number of rays traced. Integrators
/// of single scattering do not separate lights.
#[inline]
pub(crate) fn add_li<S: LightSampler, L: LightSum>(
    world: &World,
    sampler: &S,
    settings: &PathSettings,
    ray: Ray,
    stream: &SampleStream,
    sum: &mut L,
) -> u32 {
    match settings.integrator {
        Integrator::Path => trace(world, sampler, settings, ray, stream, sum),
        Integrator::VolPath => trace_volume(world, sampler, settings, ray, stream, sum),
        Integrator::SingleScattering(method) => {
            trace_single_scattering(world, sampler, settings, method, ray, stream, sum)
        }
    }
}
