use core::hint::black_box;
use core::time::Duration;
use std::time::Instant;

use lights::bounds::LightSampleContext;
use lights::glam::Vec2;
use lights::samplers::LightSampler;
use lights::sources::{Light, PdfCoverage};

use crate::{SampleStream, View, World};

/// The mean time of choosing a light and sampling a point of it, over points that the camera sees,
/// on one thread; `None` where it sees nothing.
#[must_use]
pub(crate) fn light_sample_time<S: LightSampler>(
    world: &World,
    view: &View,
    sampler: &S,
) -> Option<Duration> {
    /// Enough calls that the clock's steps do not show, and no more than a tenth of a second of
    /// them.
    const CALLS: u32 = 1 << 16;
    const LIMIT: Duration = Duration::from_millis(100);
    let contexts = seen(world, view);
    if contexts.is_empty() {
        return None;
    }
    let start = Instant::now();
    let mut calls = 0;
    for (call, ctx) in (0..CALLS).zip(contexts.iter().cycle()) {
        let u = u64::from(call).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let light = sampler.sample(ctx, u).and_then(|choice| {
            let light = world.lights().get(choice.light)?;
            light.sample_li(ctx, Vec2::splat(0.5), &(), PdfCoverage::Incomplete)
        });
        black_box(light);
        calls += 1;
        if calls % 64 == 0 && start.elapsed() > LIMIT {
            break;
        }
    }
    Some(start.elapsed() / calls)
}

/// The queries at the points that a coarse grid of camera rays meets.
fn seen(world: &World, view: &View) -> Vec<LightSampleContext> {
    const GRID: u32 = 64;
    let (width, height) = view.resolution();
    (0..GRID * GRID)
        .filter_map(|cell| {
            let (x, y) = (cell % GRID, cell / GRID);
            let place = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) / GRID as f32;
            let lens = SampleStream::new(0, (x, y), 0).camera().lens;
            let ray = view.ray(place * Vec2::new(width as f32, height as f32), lens);
            let surface = world.closest(&ray, None)?;
            let wo = -ray.direction;
            Some(world.light_context(&surface, &world.scattering(&surface), wo))
        })
        .collect()
}
