use core::num::NonZeroU32;

use lights::bounds::LightId;
use lights::glam::Vec3;
use lights::samplers::LightSampler;

use super::direct::{Arrived, DirectLight, LightQuestion, Vertex};
use super::{Estimator, Integrator};
use crate::{Ray, SampleStream, World};

/// How paths are traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathSettings {
    /// The number of segments of the longest path: 1 sees emitters directly, 2 adds direct light, and so on.
    pub max_depth: u32,
    /// How light is found.
    pub estimator: Estimator,
    /// How many lights are chosen at the first vertex where light samples can contribute, at most as many as there are. One of
    /// them gets a shadow ray. Later vertices, which count for less, choose one.
    pub light_samples: NonZeroU32,
    /// Where paths may scatter.
    pub integrator: Integrator,
}

impl PathSettings {
    /// How many lights are chosen at the first diffuse vertex, unless told otherwise.
    ///
    /// More would cost more than they gain: what is left of the noise is shadows.
    pub const DEFAULT_LIGHT_SAMPLES: NonZeroU32 = NonZeroU32::new(2).unwrap();

    /// How many lights the first vertex chooses in `world`: more choices than lights repeat themselves.
    pub(super) fn first_choices(&self, world: &World) -> u32 {
        let lights = u32::try_from(world.lights().len()).unwrap_or(u32::MAX);
        self.light_samples.get().min(lights.max(1))
    }
}

/// What one path found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Traced {
    /// Radiance that arrives along the first ray.
    pub radiance: Vec3,
    /// How many rays were asked for, shadow rays included.
    pub rays: u32,
}

/// How the current ray was chosen, which decides how the light it finds is weighted.
#[derive(Clone, Copy, Debug)]
pub(super) enum Origin {
    /// By the camera or by a Dirac: no light sample could have found the same light.
    Dirac,
    /// By the material where light was asked for so, with this density in sr^-1.
    Material { question: LightQuestion, pdf: f32 },
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
            Self::Material { question, pdf } => direct
                .estimator
                .bsdf_weight(pdf, || direct.density(&question, light, wi)),
        }
    }
}

/// Follows the camera ray `ray` through `world`, with lights chosen by `sampler`: an unbiased estimate of the radiance
/// along it, over paths of at most `settings.max_depth` segments.
#[must_use]
pub fn trace<S: LightSampler>(
    world: &World,
    sampler: &S,
    settings: &PathSettings,
    mut ray: Ray,
    stream: &SampleStream,
) -> Traced {
    /// Paths of fewer vertices are never ended at random.
    const SURE_VERTICES: u32 = 4;
    let PathSettings {
        max_depth,
        estimator,
        ..
    } = *settings;
    let mut direct = DirectLight::new(world, sampler, estimator);
    let mut traced = Traced::default();
    let mut throughput = Vec3::ONE;
    let mut origin = Origin::Dirac;
    let mut from = None;
    let mut count = settings.first_choices(world);
    for number in 0..max_depth {
        traced.rays += 1;
        let Some(surface) = world.closest(&ray, from) else {
            traced.radiance += throughput * sky(&direct, &ray, origin);
            break;
        };
        let wo = -ray.direction;
        if let Some((light, l)) = world.emitted(&surface, wo) {
            let weight = origin.weight(&direct, light, ray.direction);
            traced.radiance += throughput * l * weight;
        }
        if number + 1 == max_depth {
            break;
        }
        let numbers = stream.vertex(number);
        let scattering = world.scattering(&surface);
        let question = LightQuestion {
            ctx: world.light_context(&surface, &scattering, wo),
            count,
        };
        let asks = !scattering.bsdf().is_dirac();
        let chosen = if asks && estimator.samples_lights() {
            Some(direct.choose(&question, &numbers))
        } else {
            None
        };
        let sample = scattering.sample(wo, numbers.lobe, numbers.direction);
        if let Some(chosen) = &chosen {
            let vertex = Vertex {
                scattering: &scattering,
                wo,
                number,
            };
            let lit = direct.sample(&question, chosen, &vertex, &numbers, stream, |light| {
                let shadowed = world.occluded(&surface, light.wi, light.p_light);
                let left = if shadowed { Vec3::ZERO } else { Vec3::ONE };
                Arrived { left, rays: 1 }
            });
            traced.radiance += throughput * lit.radiance;
            traced.rays += lit.rays;
        }
        if asks {
            count = 1;
        }
        let Some(sample) = sample else {
            break;
        };
        throughput *= sample.weight;
        if number + 1 >= SURE_VERTICES {
            let survival = throughput.max_element().min(0.95);
            if !(numbers.roulette < survival) {
                break;
            }
            throughput /= survival;
        }
        origin = match sample.pdf {
            Some(pdf) => Origin::Material { question, pdf },
            None => Origin::Dirac,
        };
        ray = surface.spawn(sample.wi);
        from = Some(surface.primitive);
    }
    traced
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
