//! A canal by night, lit by its 20,000 lights in a compute pass:
//! `cargo run --release --example gbuffer -- [FRAMES [PICTURE.png]]`, or `-- --window`.
//!
//! The G-buffer (place, normal, albedo and emission of each pixel) is traced on the CPU. A frame
//! adds one light to each pixel, without its shadow, and every surface is matt: both are for the
//! renderer that takes the shaders. The CPU lights the same pixels from the same random numbers,
//! and the program fails where the two pictures differ. With `--window` it shows the picture of
//! ever more frames instead.

mod lit;
mod pixels;
mod window;

use core::f32::consts::PI;
use std::path::Path;

use light_gpu::light_samplers::{BvhLightSampler, LightSampler};
use light_gpu::light_sources::light_bounds::LightSampleContext;
use light_gpu::light_sources::{Light, LightSet, PdfCoverage, Rgb};
use light_math::fraction::from_words;
use light_math::glam::{Vec2, Vec3};
use light_scene::Image;

use pixels::pixels;

type Result<T> = core::result::Result<T, Box<dyn core::error::Error>>;

/// Columns and rows of the picture.
const SIZE: [u32; 2] = [320, 180];

/// The share of the pixels that may differ by more than [`ERROR`].
const OFF: f64 = 0.01;

/// The largest difference of a pixel that counts as none, as a part of it.
const ERROR: f32 = 1e-3;

fn main() -> Result<()> {
    let mut arguments = std::env::args().skip(1).peekable();
    let (lights, pixels) = pixels(SIZE)?;
    if arguments.next_if_eq("--window").is_some() {
        let picture = |frames| shown(&by_the_gpu(&lights, &pixels, frames)?);
        return window::show(SIZE, picture);
    }
    let frames: u32 = arguments.next().map_or(Ok(16), |n| n.parse())?;
    let picture = arguments.next();
    let start = std::time::Instant::now();
    let theirs = by_the_gpu(&lights, &pixels, frames)?;
    let seconds = start.elapsed().as_secs_f64();
    let ours = by_the_cpu(&lights, &pixels, frames)?;
    let differs = |(a, b): &(&Vec3, &Vec3)| a.distance(**b) > ERROR * b.length();
    let off = theirs.iter().zip(&ours).filter(differs).count() as f64 / ours.len() as f64;
    let mean = |picture: &[Vec3]| picture.iter().map(|p| p.element_sum()).sum::<f32>();
    let (count, bias) = (lights.len(), mean(&theirs) / mean(&ours) - 1.0);
    let [width, height] = SIZE;
    println!("{count} lights, {width} x {height} pixels, {frames} frames in {seconds:.1} s");
    println!(
        "{:.3} % of the pixels as the CPU has them, within {ERROR:e}; the mean {bias:+.1e}",
        100.0 * (1.0 - off)
    );
    println!("relMSE against the CPU {:.1e}", rel_mse(&theirs, &ours));
    println!("PICTURE.png as second argument writes the picture; --window alone shows it");
    if let Some(path) = picture {
        light_scene::write_image(Path::new(&path), &shown(&theirs)?)?;
    }
    if off > OFF || !(bias.abs() < ERROR) {
        return Err("the two pictures differ".into());
    }
    Ok(())
}

/// The picture as bright as a screen shows it.
fn shown(picture: &[Vec3]) -> Result<Image> {
    let [width, height] = SIZE;
    let texels = picture.iter().map(|l| (8.0 * *l) / (1.0 + 8.0 * *l)).collect();
    Ok(Image::new(width, height, texels)?)
}

/// The picture of so many frames by the shaders.
fn by_the_gpu(lights: &LightSet<Rgb>, pixels: &[[f32; 16]], frames: u32) -> Result<Vec<Vec3>> {
    let sums = lit::lit(lights, pixels, frames)?;
    Ok(sums.chunks_exact(4).map(|sum| Vec3::new(sum[0], sum[1], sum[2]) / sum[3]).collect())
}

/// The mean over pixels and channels of the squared difference over the squared reference plus a
/// hundredth of its squared mean.
fn rel_mse(picture: &[Vec3], reference: &[Vec3]) -> f32 {
    let count = 3.0 * reference.len() as f32;
    let mean = reference.iter().map(|p| p.element_sum()).sum::<f32>() / count;
    let error =
        |(a, b): (&Vec3, &Vec3)| ((a - b) * (a - b) / (b * b + 0.01 * mean * mean)).element_sum();
    picture.iter().zip(reference).map(error).sum::<f32>() / count
}

/// The same picture by the crates.
fn by_the_cpu(lights: &LightSet<Rgb>, pixels: &[[f32; 16]], frames: u32) -> Result<Vec<Vec3>> {
    let sampler = BvhLightSampler::new(&lights.extents())?;
    let pixel = |(i, pixel): (u32, &[f32; 16])| {
        let [p, n, albedo, emitted] = [0, 4, 8, 12].map(|at| Vec3::from_slice(&pixel[at..]));
        let mut sum = Vec3::ZERO;
        if n == Vec3::ZERO {
            return emitted;
        }
        let ctx = &LightSampleContext::surface(p, n, n);
        for frame in 0..frames {
            let [x, y, z, w] = random([i, frame, 0, 0]);
            let place = Vec2::new((z >> 8) as f32, (w >> 8) as f32) / 16_777_216.0;
            let Some(chosen) = sampler.sample(ctx, from_words(x, y)) else {
                continue;
            };
            let light = lights.get(chosen.light).expect("a light of the set");
            if let Some(it) = light.sample_li(ctx, place, &(), PdfCoverage::Complete) {
                let cosine = n.dot(it.wi).max(0.0);
                sum += albedo * it.l * (cosine / (PI * it.pdf * chosen.pmf));
            }
        }
        sum / frames as f32 + emitted
    };
    Ok((0..).zip(pixels).map(pixel).collect())
}

/// The random numbers of the shader.
fn random(seed: [u32; 4]) -> [u32; 4] {
    let mut v = seed.map(|word| word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    for round in 0..2 {
        v[0] = v[0].wrapping_add(v[1].wrapping_mul(v[3]));
        v[1] = v[1].wrapping_add(v[2].wrapping_mul(v[0]));
        v[2] = v[2].wrapping_add(v[0].wrapping_mul(v[1]));
        v[3] = v[3].wrapping_add(v[1].wrapping_mul(v[2]));
        if round == 0 {
            v = v.map(|word| word ^ (word >> 16));
        }
    }
    v
}
