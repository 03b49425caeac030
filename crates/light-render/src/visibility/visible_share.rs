use lights::math::fraction::stratum;
use lights::samplers::{BvhLightSampler, LightSampler};
use rayon::prelude::*;

use super::census::place;
use crate::{SampleStream, View, World};

/// Rows and columns of the grid of pixels that are looked at.
const GRID: u32 = 32;

/// Light samples at the surface that each of these pixels shows.
const SAMPLES: u32 = 2;

/// The seed of their random numbers.
const SEED: u32 = 0x5e8a_11d3;

/// The share of light samples that arrive at the surfaces that the camera sees, among those that
/// would without occlusion; `None` where there are no such samples.
///
/// Measured by 2,048 rays at most, from a grid of pixels to lights that `sampler` chooses: a pure
/// function of the scene and of the whole picture's view, whatever part of it is rendered.
#[must_use]
pub fn visible_share(world: &World, view: &View, sampler: &BvhLightSampler) -> Option<f32> {
    let (seen, asked) = (0..GRID * GRID)
        .into_par_iter()
        .map(|i| count(world, view, sampler, (i % GRID, i / GRID)))
        .reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1));
    (asked > 0).then(|| seen as f32 / asked as f32)
}

/// How many of the light samples at one place of the grid arrive, and how many would without
/// occlusion.
fn count(world: &World, view: &View, sampler: &BvhLightSampler, (i, j): (u32, u32)) -> (u32, u32) {
    let (width, height) = view.resolution();
    let (x, y) = (middle(i, width), middle(j, height));
    let Some(place) = place(world, view, y * width + x) else {
        return (0, 0);
    };
    let stream = SampleStream::new(SEED, (x, y), 0);
    let u = stream.vertex(0).light;
    let (mut seen, mut asked) = (0, 0);
    for sample in 0..SAMPLES {
        let u_point = stream.light_point(0, sample, SAMPLES);
        let choice = sampler.sample(&place.ctx, stratum(sample, SAMPLES, u));
        let sees = choice.and_then(|choice| place.sees(world, choice.light, u_point));
        asked += u32::from(sees.is_some());
        seen += u32::from(sees == Some(true));
    }
    (seen, asked)
}

/// The pixel in the middle of part `i` of so many pixels.
#[expect(clippy::cast_possible_truncation, reason = "less than `pixels`")]
const fn middle(i: u32, pixels: u32) -> u32 {
    ((2 * i as u64 + 1) * pixels as u64 / (2 * GRID as u64)) as u32
}
