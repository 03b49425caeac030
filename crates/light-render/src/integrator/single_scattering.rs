use core::cell::Cell;

use lights::glam::Vec3;
use lights::media::{Span, StepSize, Visibility, VolumeIntegrator, VolumeLight};
use lights::samplers::LightSampler;
use lights::sources::Rgb;

use super::direct::{DirectLight, Vertex};
use super::light_sum::LightSum;
use super::path_state::PathVertex;
use super::sky::sky;
use super::transmittance::transmittance;
use super::volume_vertex::VolumeVertex;
use super::{Estimator, PathSettings, SingleScattering};
use crate::{Ray, SampleStream, World};

/// Adds the light along a camera ray that was scattered at most once to `sum`, attributed to no
/// light: scattered by the medium around the camera or by the first surface. Specular surfaces stay
/// black. Returns the number of rays traced.
///
/// # Source
/// Marching and light sampling are those of [`VolumeIntegrator`].
pub(crate) fn trace_single_scattering<S: LightSampler>(
    world: &World,
    sampler: &S,
    settings: &PathSettings,
    method: SingleScattering,
    ray: Ray,
    stream: &SampleStream,
    sum: &mut impl LightSum,
) -> u32 {
    // No ray continues from the surface, so light samples have to find all light.
    let direct = DirectLight::new(world, sampler, Estimator::Light);
    let mut flight = stream.flight(0);
    let medium = world.media().camera;
    let surface = world.closest(&ray, None);
    let mut rays = 1;
    let distance = surface.map_or(f32::INFINITY, |s| (s.p - ray.origin).length());
    let mut lo = Vec3::ZERO;
    match surface {
        None => lo = sky(world, &ray).map(|(_, le)| le).sum(),
        Some(surface) => {
            let wo = -ray.direction;
            if let Some((_, l)) = world.emitted(&surface, wo) {
                lo += l;
            }
            let vertex = VolumeVertex::on_surface(world, surface, medium);
            if !vertex.is_dirac() {
                let ctx = vertex.light_context(world, wo);
                let count = settings.first_choices(world);
                let query = direct.query(ctx, count);
                let at = Vertex {
                    scattering: &vertex,
                    wo,
                    number: 0,
                };
                let numbers = stream.vertex(0);
                let chosen = direct.choose(&query, &numbers);
                let lit = direct.sample(&query, &chosen, &at, &numbers, stream, |light| {
                    let target = (!light.kind.is_infinite()).then_some(light.p_light);
                    let from = vertex.spawn(world, light.wi);
                    transmittance(world, from, target, &mut || flight.next_u())
                });
                lo += lit.radiance;
                rays += lit.rays;
            }
        }
    }
    let medium = world.media().get(medium);
    let volume = match medium.zip(Span::new(0.0, distance)) {
        None => VolumeLight::vacuum(),
        Some((medium, span)) => {
            let shadows = Shadows {
                world,
                rays: Cell::new(0),
            };
            let step = match method {
                SingleScattering::Classic(step) => step,
                SingleScattering::NextEvent => coarse_step(world),
            };
            let integrator = VolumeIntegrator::<Rgb, _, _, _> {
                medium,
                lights: world.lights(),
                sampler,
                scene: &shadows,
                wavelengths: &(),
                step,
                shadow_step: step,
            };
            let (ray, seed) = ((&ray).into(), stream.key());
            let next_u = &mut || flight.next_u();
            let volume = match method {
                SingleScattering::Classic(_) => {
                    integrator.single_scattering(&ray, span, seed, next_u)
                }
                SingleScattering::NextEvent => {
                    let count = settings.first_choices(world);
                    integrator.next_event(&ray, span, count, seed, next_u)
                }
            };
            rays += shadows.rays.get();
            volume
        }
    };
    sum.add(None, lo * volume.transmittance + volume.l);
    rays
}

/// Visibility of lights from points in a medium, with a count of the rays.
#[derive(Debug)]
struct Shadows<'a> {
    world: &'a World,
    rays: Cell<u32>,
}

impl Visibility for Shadows<'_> {
    fn unoccluded(&self, from: Vec3, to: Vec3) -> bool {
        self.rays.set(self.rays.get() + 1);
        self.world.sees(from, to)
    }
}

/// The default step length of marches: a hundredth of the diagonal of the scene.
///
/// # Panics
/// Never: a scene without size gets steps of 0.1.
#[must_use]
pub(crate) fn coarse_step(world: &World) -> StepSize {
    let size = world.bounds().diagonal().length();
    let step = StepSize::new(0.01 * size).or(StepSize::new(0.1));
    step.expect("a positive length")
}
