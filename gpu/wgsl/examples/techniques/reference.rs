//! The picture of many choices by the CPU.

use core::f32::consts::PI;
use std::thread;

use light_gpu::light_bvh::LightBvhError;
use light_gpu::light_samplers::{BvhLightSampler, LightSampler};
use light_gpu::light_sources::light_bounds::LightSampleContext;
use light_gpu::light_sources::{Light, LightSet, PdfCoverage, Rgb};
use light_math::glam::{Vec2, Vec3};

use crate::surface::is_surface;

/// Choices of a pixel.
const CHOICES: u32 = 2048;

/// What the lights give to each pixel.
///
/// # Errors
/// If the lights are more than a tree takes.
pub fn reference(lights: &LightSet<Rgb>, pixels: &[[f32; 16]]) -> Result<Vec<Vec3>, LightBvhError> {
    let sampler = &BvhLightSampler::new(&lights.extents())?;
    let mut picture = vec![Vec3::ZERO; pixels.len()];
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let each = pixels.len().div_ceil(threads);
    thread::scope(|scope| {
        let parts = picture.chunks_mut(each).zip(pixels.chunks(each));
        for ((picture, pixels), first) in parts.zip((0..).step_by(each)) {
            scope.spawn(move || {
                for ((color, pixel), i) in picture.iter_mut().zip(pixels).zip(first..) {
                    *color = light(lights, sampler, pixel, i);
                }
            });
        }
    });
    Ok(picture)
}

fn light(lights: &LightSet<Rgb>, sampler: &BvhLightSampler, pixel: &[f32; 16], i: u64) -> Vec3 {
    let [p, n, albedo, emitted] = [0, 4, 8, 12].map(|at| Vec3::from_slice(&pixel[at..]));
    if !is_surface(pixel) {
        return Vec3::ZERO;
    }
    let ctx = &LightSampleContext::surface(p, n, n);
    let here = sampler.at(ctx, CHOICES);
    let mut state = i << 32;
    let mut random = || {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    };
    let mut sum = Vec3::ZERO;
    let u = random();
    for chosen in here.samples(u) {
        let place = Vec2::new((random() >> 40) as f32, (random() >> 40) as f32) / 16_777_216.0;
        let light = lights.get(chosen.light).expect("a light of the set");
        if let Some(it) = light.sample_li(ctx, place, &(), PdfCoverage::Complete) {
            let cosine = n.dot(it.wi).max(0.0);
            sum += albedo * it.l * (cosine / (PI * it.pdf * chosen.pmf));
        }
    }
    sum / CHOICES as f32 + emitted
}
