use lights::bounds::LightSampleContext;
use lights::glam::Vec3;
use lights::samplers::LightSampler;

use super::Estimator;
use super::direct::{from_lights, light_density};
use crate::{Ray, SampleStream, World};

/// How paths are traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PathSettings {
    /// The number of segments of the longest path: 1 sees emitters directly, 2 adds direct light, and so on.
    pub max_depth: u32,
    /// How light is found.
    pub estimator: Estimator,
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
enum Origin {
    /// By the camera or by a Dirac: no light sample could have found the same light.
    Dirac,
    /// By the material at `ctx`, with this density in sr^-1.
    Material { ctx: LightSampleContext, pdf: f32 },
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
    } = *settings;
    let mut traced = Traced::default();
    let mut throughput = Vec3::ONE;
    let mut origin = Origin::Dirac;
    let mut from = None;
    for vertex in 0..max_depth {
        traced.rays += 1;
        let Some(surface) = world.closest(&ray, from) else {
            traced.radiance += throughput * sky(world, sampler, estimator, &ray, origin);
            break;
        };
        let wo = -ray.direction;
        if let Some((light, l)) = world.emitted(&surface, wo) {
            let weight = match origin {
                Origin::Dirac => 1.0,
                Origin::Material { ctx, pdf } => estimator.bsdf_weight(pdf, || {
                    light_density(world, sampler, estimator, &ctx, light, ray.direction)
                }),
            };
            traced.radiance += throughput * l * weight;
        }
        if vertex + 1 == max_depth {
            break;
        }
        let numbers = stream.vertex(vertex);
        let scattering = world.scattering(&surface);
        let ctx = world.light_context(&surface, &scattering, wo);
        if estimator.samples_lights() && !scattering.bsdf().is_dirac() {
            let direct = from_lights(
                world,
                sampler,
                estimator,
                &surface,
                &scattering,
                &ctx,
                wo,
                &numbers,
            );
            traced.radiance += throughput * direct.radiance;
            traced.rays += direct.rays;
        }
        let Some(sample) = scattering.sample(wo, numbers.lobe, numbers.direction) else {
            break;
        };
        throughput *= sample.weight;
        if vertex + 1 >= SURE_VERTICES {
            let survival = throughput.max_element().min(0.95);
            if !(numbers.roulette < survival) {
                break;
            }
            throughput /= survival;
        }
        origin = match sample.pdf {
            Some(pdf) => Origin::Material { ctx, pdf },
            None => Origin::Dirac,
        };
        ray = surface.spawn(sample.wi);
        from = Some(surface.triangle);
    }
    traced
}

/// The light of all infinite lights along a ray that leaves the scene.
fn sky<S: LightSampler>(
    world: &World,
    sampler: &S,
    estimator: Estimator,
    ray: &Ray,
    origin: Origin,
) -> Vec3 {
    let mut radiance = Vec3::ZERO;
    for &light in world.infinite_lights() {
        let le = world.sky_radiance(light, ray);
        if le == Vec3::ZERO {
            continue;
        }
        let weight = match origin {
            Origin::Dirac => 1.0,
            Origin::Material { ctx, pdf } => estimator.bsdf_weight(pdf, || {
                light_density(world, sampler, estimator, &ctx, light, ray.direction)
            }),
        };
        radiance += le * weight;
    }
    radiance
}
