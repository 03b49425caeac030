//! How long a sky takes to build from a lat-long picture, on one thread and on two, and how many
//! bytes a texel its tables take.
//!
//! `cargo run --release -p benches --example sky_build`. Other programs take processors away: the
//! least time is that of the machine, the median that of the moment; the load is stated.

use core::error::Error;
use std::time::Instant;

use lights::glam::Vec3;
use lights::sources::{
    Channels, EnvironmentMap, Image, ImageInfiniteLight, ImageInfiniteLightDesc, LightSetBuilder,
    Rgb, SceneSphere,
};
use rayon::ThreadPoolBuilder;

const SIZES: [[u32; 2]; 3] = [[512, 256], [1024, 512], [4096, 2048]];
const ROUNDS: usize = 11;

/// A sky brighter at the top, with a sun.
fn panorama([width, height]: [u32; 2]) -> Result<Image, Box<dyn Error>> {
    let sun = width * (height / 4) + width / 3;
    let texel = |i: u32| {
        let up = 1.0 - (i / width) as f32 / height as f32;
        let bright = if i == sun { 1e5 } else { 1.0 };
        [0.2 * bright, (0.1 + 0.3 * up) * bright, up * bright]
    };
    let texels: Vec<f32> = (0..width * height).flat_map(texel).collect();
    Ok(Image::from_f32([width, height], Channels::Rgb, texels)?)
}

/// Seconds to build the light, in rising order.
fn seconds(desc: &ImageInfiniteLightDesc, threads: usize) -> Result<Vec<f64>, Box<dyn Error>> {
    let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
    let scene = SceneSphere::new(Vec3::ZERO, 1.0)?;
    let mut seconds = Vec::new();
    for _ in 0..ROUNDS {
        let desc = desc.clone();
        let start = Instant::now();
        let light = pool.install(|| ImageInfiniteLight::<Rgb>::new(desc, scene))?;
        seconds.push(start.elapsed().as_secs_f64());
        drop(light);
    }
    seconds.sort_by(f64::total_cmp);
    Ok(seconds)
}

fn main() -> Result<(), Box<dyn Error>> {
    let load = || std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
    println!("load before: {}", load().trim());
    println!("| texels | threads | least ms | median ms | table bytes a texel |");
    println!("| --- | --- | --- | --- | --- |");
    for size in SIZES {
        let image = panorama(size)?;
        let desc = ImageInfiniteLightDesc::new(EnvironmentMap::LatLong(image.clone()));
        let mut set = LightSetBuilder::<Rgb>::new(SceneSphere::new(Vec3::ZERO, 1.0)?);
        set.add(desc.clone())?;
        let tables = set.build().bytes().images - image.bytes();
        let texels = f64::from(size[0]) * f64::from(size[1]);
        for threads in [1, 2] {
            let seconds = seconds(&desc, threads)?;
            println!(
                "| {} x {} | {threads} | {:.1} | {:.1} | {:.2} |",
                size[0],
                size[1],
                1e3 * seconds[0],
                1e3 * seconds[ROUNDS / 2],
                tables as f64 / texels
            );
        }
    }
    println!("load after: {}", load().trim());
    Ok(())
}
