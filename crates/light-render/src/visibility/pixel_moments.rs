use lights::glam::{Vec2, Vec3};
use lights::samplers::BvhLightSampler;

use super::choice_plan::ChoicePlan;
use super::measured_vertex::{MeasuredVertex, VertexMoments, choices_of};
use crate::{SampleStream, View, World};

/// Vertices of a path that are looked at: later ones hardly count.
const MAX_VERTICES: u32 = 3;

/// Light samples at the first vertex, half of them from the root and half by a cut.
const FIRST_SAMPLES: u32 = 8;

/// The same at each later vertex.
const LATER_SAMPLES: u32 = 4;

/// The seed of their random numbers.
const SEED: u32 = 0x5e8a_11d3;

/// What light samples along one path tell of a pixel. Light is the sum of the channels.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PixelMoments {
    /// Light samples at the first vertex that would arrive without occlusion.
    pub(super) asked: f64,
    /// Those that arrive.
    pub(super) seen: f64,
    /// Vertices where light is sampled.
    pub(super) vertices: f64,
    /// The light of the pixel.
    pub(super) mean: f64,
    /// The variance of that light by one sample, by the plan.
    pub(super) variances: [f64; 3],
    /// The part of the variances that is of the first vertex.
    pub(super) of_first: [f64; 3],
}

/// The pixel's path with so many vertices at most, from the middle of the pixel, by numbers that
/// depend on the pixel alone.
pub(super) fn pixel_moments(
    world: &World,
    view: &View,
    lights: &BvhLightSampler,
    (x, y): (u32, u32),
    vertices: u32,
) -> PixelMoments {
    let stream = SampleStream::new(SEED, (x, y), 0);
    let corner = Vec2::new(x as f32, y as f32);
    let mut ray = view.ray(corner + 0.5, Vec2::splat(0.5));
    let (mut from, mut throughput) = (None, Vec3::ONE);
    let mut pixel = PixelMoments::default();
    for number in 0..vertices.min(MAX_VERTICES) {
        let Some(surface) = world.closest(&ray, from) else {
            break;
        };
        let vertex = MeasuredVertex {
            surface,
            scattering: world.scattering(&surface),
            wo: -ray.direction,
            throughput,
        };
        if !vertex.scattering.bsdf().is_dirac() {
            let ctx = vertex.context(world);
            let choices = [ChoicePlan::OneFromRoot, ChoicePlan::OneByCut];
            let choices = choices.map(|plan| choices_of(plan, lights, &ctx));
            let count = match number {
                0 => FIRST_SAMPLES,
                _ => LATER_SAMPLES,
            };
            let moments = vertex.moments(world, &ctx, &choices, &stream, (number, count));
            pixel.add(moments, number);
        }
        let numbers = stream.vertex(number);
        let scattered = vertex
            .scattering
            .sample(vertex.wo, numbers.lobe, numbers.direction);
        let Some(scattered) = scattered else {
            break;
        };
        throughput *= scattered.weight;
        ray = surface.spawn(scattered.wi);
        from = Some(surface.primitive);
    }
    pixel
}

impl PixelMoments {
    fn add(&mut self, vertex: VertexMoments, number: u32) {
        self.vertices += 1.0;
        self.mean += vertex.arriving;
        if number > 0 {
            // The mean over all paths of the pixel is not known, and small against the squares.
            let later = [vertex.first, vertex.second, vertex.first];
            self.variances = core::array::from_fn(|plan| self.variances[plan] + later[plan]);
            return;
        }
        self.asked += vertex.asked;
        self.seen += vertex.seen;
        self.variances = vertex.variances();
        self.of_first = self.variances;
    }
}
