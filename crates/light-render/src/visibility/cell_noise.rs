use lights::bounds::LightSampleContext;
use lights::bvh::visibility::CellFactors;
use lights::glam::{Vec2, Vec3};
use lights::samplers::{BvhLightSampler, VisibilityCache, VisibilityLightSampler};

use super::census::{Sighting, camera_surface};
use super::choice_plan::ChoicePlan;
use super::fill::Cell;
use super::measured_vertex::{MeasuredVertex, VertexMoments, choices_of};
use crate::{SampleStream, View, World};

/// Pixels of a cell that are measured, at most.
const PIXELS: usize = 4;

/// Before it is filled, one of so many pixels is measured: that takes a few hundredths of a
/// picture's time.
const PIXELS_PER_MEASURED: usize = 16;

/// Light samples at each of two points of a pixel, half of them from the root and half by a cut.
const SAMPLES: u32 = 8;

/// Light samples at the middle of a pixel that compare a filled cell with a plan, half of them by
/// each.
const COMPARED: u32 = 16;

/// The seed of their random numbers.
const SEED: u32 = 0x1c3a_9e07;

/// What light samples tell of the pixels that show a cell, before it is filled: means over a few of
/// them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct CellNoise {
    /// The light of a pixel from its first vertex.
    pub(super) mean: f64,
    /// The variance of that light by one sample, by the plan.
    pub(super) variances: [f64; 3],
    /// The variance of the light over the points of a pixel.
    pub(super) within: f64,
}

impl CellNoise {
    pub(super) fn of(
        world: &World,
        view: &View,
        lights: &BvhLightSampler,
        cell: &[Sighting],
    ) -> Self {
        let mut noise = Self::default();
        let count = (cell.len() / PIXELS_PER_MEASURED).clamp(1, PIXELS);
        let weight = 1.0 / count as f64;
        for sighting in measured(cell, count) {
            let of_point = |i| at_point(world, view, lights, sighting.point.pixel, i);
            let [a, b] = [of_point(0), of_point(1)];
            noise.mean += 0.5 * weight * (a.arriving + b.arriving);
            // Half the square of the difference, without the noise of either.
            let squares = a.arriving_sq + b.arriving_sq;
            noise.within += weight * (0.5 * squares - a.arriving * b.arriving);
            for (sum, [a, b]) in noise.variances.iter_mut().zip(pairs(&a, &b)) {
                *sum += 0.5 * weight * (a + b);
            }
        }
        noise
    }
}

/// What light samples tell of the light at point `i` of a pixel: none where no light is sampled.
fn at_point(
    world: &World,
    view: &View,
    lights: &BvhLightSampler,
    pixel: u32,
    i: u32,
) -> VertexMoments {
    let stream = stream(view, pixel, i);
    let Some(vertex) = vertex(world, view, pixel, stream.camera().film) else {
        return VertexMoments::default();
    };
    let ctx = vertex.context(world);
    let choices = [ChoicePlan::OneFromRoot, ChoicePlan::OneByCut];
    let choices = choices.map(|plan| choices_of(plan, lights, &ctx));
    vertex.moments(world, &ctx, &choices, &stream, (0, SAMPLES))
}

/// The share of the noise by `plan` that is left in a filled cell, at most 1.5; `None` where the
/// samples find none.
pub(super) fn gain(
    world: &World,
    view: &View,
    lights: &BvhLightSampler,
    cell: &[Sighting],
    (coarse, fine): &Cell,
    plan: ChoicePlan,
) -> Option<f64> {
    let [mut in_cell, mut by_plan] = [0.0; 2];
    for sighting in measured(cell, PIXELS.min(cell.len())) {
        let own = fine.iter().find(|fine| fine.key() == sighting.fine);
        let factors = own.map_or(coarse.factors(), |own| own.factors(coarse));
        let Some(vertex) = vertex(world, view, sighting.point.pixel, sighting.point.at()) else {
            continue;
        };
        let ctx = vertex.context(world);
        let cache = Everywhere(factors);
        let guided = VisibilityLightSampler::new(lights.view(), &cache).choices(&ctx, 1, 1);
        // Two choices are measured by single ones of their cut.
        let single = match plan {
            ChoicePlan::AsAsked => ChoicePlan::OneByCut,
            single => single,
        };
        let choices = [guided, choices_of(single, lights, &ctx)];
        let stream = stream(view, sighting.point.pixel, 2);
        let moments = vertex.moments(world, &ctx, &choices, &stream, (0, COMPARED));
        let [first, second, two] = moments.variances();
        in_cell += first;
        by_plan += match plan {
            ChoicePlan::AsAsked => two,
            _ => second,
        };
    }
    (by_plan > 0.0).then(|| (in_cell / by_plan).clamp(0.0, 1.5))
}

/// So many pixels of a cell, which stand for all.
fn measured(cell: &[Sighting], count: usize) -> impl Iterator<Item = &Sighting> {
    (0..count).map(move |i| &cell[(2 * i + 1) * cell.len() / (2 * count)])
}

/// The first vertex of the pixel's path through the point `at` of the pixel.
fn vertex(world: &World, view: &View, pixel: u32, at: Vec2) -> Option<MeasuredVertex> {
    let (surface, scattering, wo) = camera_surface(world, view, pixel, at)?;
    Some(MeasuredVertex {
        surface,
        scattering,
        wo,
        throughput: Vec3::ONE,
    })
}

fn stream(view: &View, pixel: u32, sample: u32) -> SampleStream {
    let (width, _) = view.resolution();
    SampleStream::new(SEED, (pixel % width, pixel / width), sample)
}

/// The variances of both by each plan.
fn pairs(a: &VertexMoments, b: &VertexMoments) -> impl Iterator<Item = [f64; 2]> {
    let [a, b] = [a, b].map(VertexMoments::variances);
    a.into_iter().zip(b).map(|(a, b)| [a, b])
}

/// The factors of one cell at every place.
struct Everywhere<'a>(CellFactors<'a>);

impl VisibilityCache for Everywhere<'_> {
    fn factors<'a>(&'a self, _: &LightSampleContext) -> Option<CellFactors<'a>> {
        Some(self.0)
    }
}
