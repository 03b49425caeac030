use lights::samplers::LightSampler;

use super::{Integrator, PathSettings, Traced, trace, trace_single_scattering, trace_volume};
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
    match settings.integrator {
        Integrator::Path => trace(world, sampler, settings, ray, stream),
        Integrator::VolPath => trace_volume(world, sampler, settings, ray, stream),
        Integrator::SingleScattering(method) => {
            trace_single_scattering(world, sampler, settings, method, ray, stream)
        }
    }
}
