use lights::glam::Vec3;
use lights::samplers::LightSampler;

use super::direct::{Arrived, DirectLight, LightQuery, Vertex};
use super::ray_origin::{Origin, sky};
use super::{PathSettings, Traced};
use crate::{Ray, SampleStream, World};

/// Follows the camera ray `ray` through `world`, with lights chosen by `sampler`: an unbiased
/// estimate of the radiance along it, over paths of at most `settings.max_depth` segments.
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
        let query = LightQuery {
            ctx: world.light_context(&surface, &scattering, wo),
            count,
        };
        let asks = !scattering.bsdf().is_dirac();
        let chosen = if asks && estimator.samples_lights() {
            Some(direct.choose(&query, &numbers))
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
            let lit = direct.sample(&query, chosen, &vertex, &numbers, stream, |light| {
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
            Some(pdf) => Origin::Material { query, pdf },
            None => Origin::Dirac,
        };
        ray = surface.spawn(sample.wi);
        from = Some(surface.primitive);
    }
    traced
}
