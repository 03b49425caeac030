use lights::glam::Vec3;
use lights::samplers::LightSampler;
use lights::sources::LightType;

use super::direct::{DirectLight, LightQuery, Vertex};
use super::ray_origin::{Origin, sky};
use super::through::{MOST_CROSSINGS, across, transmittance};
use super::volume_vertex::{VolumeRay, VolumeVertex};
use super::{PathSettings, Traced};
use crate::{FlightNumbers, Ray, SampleStream, World};

/// Follows the camera ray `ray` through `world` and its media: an unbiased estimate of the radiance
/// along it, over paths of at most `settings.max_depth` segments. Boundaries between media that
/// bend nothing end no segment.
///
/// Distances are chosen by delta tracking with the throughput in the choice, so that media which
/// differ from colour to colour take no separate treatment; light that was asked for is attenuated
/// by ratio tracking, where there is no closed form. Both strategies see the same transmittance in
/// the mean, so directions alone decide their weights.
///
/// # Source
/// `[PBRT4]`, section 14.2; the tracking is that of
/// [`delta_tracking`](lights::media::delta_tracking).
#[must_use]
pub fn trace_volume<S: LightSampler>(
    world: &World,
    sampler: &S,
    settings: &PathSettings,
    ray: Ray,
    stream: &SampleStream,
) -> Traced {
    /// Paths of fewer vertices are never ended at random.
    const SURE_VERTICES: u32 = 4;
    let mut path = VolumePath {
        direct: DirectLight::new(world, sampler, settings.estimator),
        traced: Traced::default(),
        throughput: Vec3::ONE,
        origin: Origin::Dirac,
    };
    let mut here = VolumeRay {
        ray,
        from: None,
        medium: world.media().camera,
    };
    let mut count = settings.first_choices(world);
    for number in 0..settings.max_depth {
        let mut flight = stream.flight(number);
        let Some(met) = path.next_vertex(here, &mut flight) else {
            break;
        };
        if number + 1 == settings.max_depth {
            break;
        }
        let wo = -met.direction;
        let numbers = stream.vertex(number);
        let query = LightQuery {
            ctx: met.vertex.light_context(world, wo),
            count,
        };
        if !met.vertex.is_dirac() {
            if settings.estimator.samples_lights() {
                let vertex = Vertex {
                    scattering: &met.vertex,
                    wo,
                    number,
                };
                let chosen = path.direct.choose(&query, &numbers);
                let lit = path
                    .direct
                    .sample(&query, &chosen, &vertex, &numbers, stream, |light| {
                        let is_near =
                            matches!(light.kind, LightType::DeltaPosition | LightType::Area);
                        let target = is_near.then_some(light.p_light);
                        let from = met.vertex.spawn(world, light.wi);
                        transmittance(world, from, target, &mut || flight.next_u())
                    });
                path.traced.radiance += path.throughput * lit.radiance;
                path.traced.rays += lit.rays;
            }
            count = 1;
        }
        let Some(sample) = met.vertex.sample(wo, numbers.lobe, numbers.direction) else {
            break;
        };
        path.throughput *= sample.weight;
        if number + 1 >= SURE_VERTICES {
            let survival = path.throughput.max_element().min(0.95);
            if !(numbers.roulette < survival) {
                break;
            }
            path.throughput /= survival;
        }
        path.origin = match sample.pdf {
            Some(pdf) => Origin::Material { query, pdf },
            None => Origin::Dirac,
        };
        here = met.vertex.spawn(world, sample.wi);
    }
    path.traced
}

/// A path on its way.
struct VolumePath<'a, S> {
    direct: DirectLight<'a, S>,
    traced: Traced,
    throughput: Vec3,
    /// How the current segment was chosen.
    origin: Origin,
}

/// Where a segment ended, and the direction in which it arrived.
struct Met {
    vertex: VolumeVertex,
    direction: Vec3,
}

impl<S: LightSampler> VolumePath<'_, S> {
    /// Follows one segment to the next vertex, and collects the light on its way; `None` where the
    /// path ends.
    fn next_vertex(&mut self, mut here: VolumeRay, flight: &mut FlightNumbers) -> Option<Met> {
        let world = self.direct.world;
        for _ in 0..MOST_CROSSINGS {
            self.traced.rays += 1;
            let VolumeRay { ray, medium, .. } = here;
            let direction = ray.direction;
            let surface = world.closest(&ray, here.from);
            let distance = surface.map_or(f32::INFINITY, |s| (s.p - ray.origin).length());
            let flown = world
                .media()
                .flight(medium, &ray, distance, self.throughput, &mut || {
                    flight.next_u()
                });
            if let Some(flown) = flown {
                self.traced.radiance += self.throughput * flown.emitted;
                self.throughput *= flown.weight;
                if let Some(t) = flown.scattered_at {
                    let vertex = VolumeVertex::in_medium(world, ray.at(t), medium?)?;
                    return Some(Met { vertex, direction });
                }
                if self.throughput == Vec3::ZERO {
                    return None;
                }
            }
            let Some(surface) = surface else {
                let sky = sky(&self.direct, &ray, self.origin);
                self.traced.radiance += self.throughput * sky;
                return None;
            };
            if let Some((light, l)) = world.emitted(&surface, -direction) {
                let weight = self.origin.weight(&self.direct, light, direction);
                self.traced.radiance += self.throughput * l * weight;
            }
            if !world.is_interface(&surface) {
                let vertex = VolumeVertex::on_surface(world, surface, medium);
                return Some(Met { vertex, direction });
            }
            here = across(world, &surface, &ray, medium);
        }
        None
    }
}
