use lights::glam::Vec3;
use lights::samplers::LightSampler;

use super::PathSettings;
use super::direct::Unshadowed;
use super::light_sum::LightSum;
use super::path_state::PathState;
use super::transmittance::{MAX_CROSSINGS, across, transmittance};
use super::volume_vertex::{VolumeRay, VolumeVertex};
use crate::{FlightNumbers, Ray, SampleStream, World};

/// Follows the camera ray `ray` through `world` and its media: adds an unbiased estimate of the
/// radiance along it to `sum`, over paths of at most `settings.max_depth` segments. Boundaries
/// between media that do not refract end no segment. Returns the number of rays traced.
///
/// Distances are chosen by delta tracking with the throughput in the choice, so that media with
/// different coefficients per channel need no separate treatment. Light samples are attenuated by
/// ratio tracking, where there is no closed form. Both strategies have the same mean transmittance,
/// so that MIS weights depend on the densities of directions alone.
///
/// # Source
/// `[PBRT4]`, section 14.2; the tracking is that of
/// [`delta_tracking`](lights::media::delta_tracking).
pub(crate) fn trace_volume<S: LightSampler, L: LightSum>(
    world: &World,
    sampler: &S,
    settings: &PathSettings,
    ray: Ray,
    stream: &SampleStream,
    sum: &mut L,
) -> u32 {
    let mut path = PathState::new(world, sampler, settings, sum);
    let mut here = VolumeRay {
        ray,
        from: None,
        medium: world.media().camera,
    };
    for number in 0..settings.max_depth {
        let mut flight = stream.flight(number);
        let Some(hit) = next_vertex(world, &mut path, here, &mut flight) else {
            break;
        };
        if number + 1 == settings.max_depth {
            break;
        }
        let arrived = |light: &Unshadowed| {
            let target = (!light.kind.is_infinite()).then_some(light.p_light);
            let from = hit.vertex.spawn(world, light.wi);
            transmittance(world, from, target, &mut || flight.next_u())
        };
        let Some(wi) = path.scatter(&hit.vertex, -hit.direction, number, stream, arrived) else {
            break;
        };
        here = hit.vertex.spawn(world, wi);
    }
    path.rays
}

/// The vertex where a segment ended, and the direction in which the segment arrived.
struct VertexHit {
    vertex: VolumeVertex,
    direction: Vec3,
}

/// Follows one segment to the next vertex, and adds the emission along it; `None` where the path
/// ends.
fn next_vertex<S: LightSampler, L: LightSum>(
    world: &World,
    path: &mut PathState<'_, S, L>,
    mut here: VolumeRay,
    flight: &mut FlightNumbers,
) -> Option<VertexHit> {
    for _ in 0..MAX_CROSSINGS {
        path.rays += 1;
        let VolumeRay { ray, medium, .. } = here;
        let direction = ray.direction;
        let surface = world.closest(&ray, here.from);
        let distance = surface.map_or(f32::INFINITY, |s| (s.p - ray.origin).length());
        let flown = world
            .media()
            .flight(medium, &ray, distance, path.throughput, &mut || {
                flight.next_u()
            });
        if let Some(flown) = flown {
            path.add_medium(flown.emitted);
            path.throughput *= flown.weight;
            if let Some(t) = flown.scattered_at {
                let vertex = VolumeVertex::in_medium(world, ray.at(t), medium?)?;
                return Some(VertexHit { vertex, direction });
            }
            if path.throughput == Vec3::ZERO {
                return None;
            }
        }
        let Some(surface) = surface else {
            path.add_sky(&ray);
            return None;
        };
        path.add_emission(&surface, direction);
        if !world.is_interface(&surface) {
            let vertex = VolumeVertex::on_surface(world, surface, medium);
            return Some(VertexHit { vertex, direction });
        }
        here = across(world, &surface, &ray, medium);
    }
    None
}
