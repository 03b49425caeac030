use lights::samplers::LightSampler;

use super::{PathSettings, SingleScattering, Traced, trace, trace_single_scattering, trace_volume};
use crate::{Ray, SampleStream, World};

/// How the light along a camera ray is found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Integrator {
    /// Paths from surface to surface; media are left out.
    #[default]
    Path,
    /// Paths that scatter in media as well.
    VolPath,
    /// Light that was scattered once.
    SingleScattering(SingleScattering),
}

impl Integrator {
    /// The one that shows all that is in `world`.
    #[must_use]
    pub fn fitting(world: &World) -> Self {
        if world.has_media() {
            Self::VolPath
        } else {
            Self::Path
        }
    }
}

/// The light along a camera ray, by the integrator that `settings` name.
#[inline]
#[must_use]
pub fn follow<S: LightSampler>(
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
