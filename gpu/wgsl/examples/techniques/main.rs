//! What games do today against the tree, in the same compute pass, at equal time:
//! `cargo run --release --example techniques -- [SECONDS]`.
//!
//! Each technique adds frames to the picture of the canal by night for so many seconds (default:
//! 4): of processor time on a software driver, of the clock on a graphics card. A reference of many
//! choices by the CPU says how far each picture is off. Shadows are in none of them.

mod compute;
#[path = "../gbuffer/pixels.rs"]
mod pixels;
mod reference;
mod surface;
mod tiles;

use light_gpu::light_samplers::BvhLightSampler;
use light_gpu::{light_sampler_rows, light_set_rows};
use light_math::glam::Vec3;

use compute::{Compute, Lit};
use surface::is_surface;
use tiles::{Tiles, tiles};

type Result<T> = core::result::Result<T, Box<dyn core::error::Error>>;

/// Columns and rows of the picture.
const SIZE: [u32; 2] = [160, 96];

/// The entry points, and what they are.
const TECHNIQUES: [(&str, &str); 5] = [
    ("by_tree", "the tree, one choice"),
    ("by_cut", "the tree, four choices by a cut"),
    ("by_chance", "equal probabilities, one choice"),
    ("by_8_candidates", "equal probabilities, one of 8 candidates resampled"),
    ("by_32_candidates", "equal probabilities, one of 32 candidates resampled"),
];

/// Where the range of a light ends, for lists of tiles: the irradiance there, as a part of the mean
/// radiance of the picture.
const RANGES: [f32; 3] = [1e-2, 1e-3, 1e-4];

fn main() -> Result<()> {
    let seconds: f64 = std::env::args().nth(1).map_or(Ok(4.0), |n| n.parse())?;
    let (lights, pixels) = pixels::pixels(SIZE)?;
    let reference = reference::reference(&lights, &pixels)?;
    let surfaces = pixels.iter().filter(|pixel| is_surface(pixel)).count() as f32;
    let mean = reference.iter().map(|p| p.element_sum()).sum::<f32>() / (3.0 * surfaces);
    let tree = light_sampler_rows(&BvhLightSampler::new(&lights.extents())?.view())?;
    let set = light_set_rows(&lights)?;
    let [width, height] = SIZE;
    let rows = |lists: &Tiles| {
        let set_at = 2 + tree.len() as u32;
        let tiles_at = set_at + set.len() as u32;
        let head = [
            [set_at, tiles_at, tiles_at + lists.tiles.len() as u32, 0],
            [width, lists.columns, lights.len() as u32, 0],
        ];
        [&head[..], &tree, &set, &lists.tiles, &lists.entries].concat()
    };
    println!("{} lights, {width} x {height} pixels, {seconds} s each", lights.len());
    println!("| technique | frames | relMSE | mean |\n| --- | ---: | ---: | ---: |");
    let print = |name: &str, lit: &Lit| {
        let (error, bias) = compare(&lit.picture, &reference, mean);
        println!("| {name} | {} | {error:.2e} | {:+.1} % |", lit.frames, 100.0 * bias);
        (error * f64::from(lit.frames), bias)
    };
    let mut is_right = true;
    let mut of_tree = f64::INFINITY;
    let compute = Compute::new(&rows(&Tiles::default()), &pixels)?;
    for (entry, name) in TECHNIQUES {
        let (error, bias) = print(name, &compute.light(entry, seconds)?);
        // The others need more time for a mean that says something.
        match entry {
            "by_tree" => (of_tree, is_right) = (error, bias.abs() < 0.02),
            // Of four choices each may be as far off as one of the tree, and none further.
            "by_cut" => is_right &= bias.abs() < 0.02 && 4.0 * error < of_tree,
            _ => {}
        }
    }
    for part in RANGES {
        let lists = tiles(&lights, &pixels, SIZE, part * mean);
        let compute = Compute::new(&rows(&lists), &pixels)?;
        let name = format!("lists of tiles, {:.0} lights on average", lists.mean_length());
        print(&name, &compute.light("by_tile", seconds)?);
    }
    if is_right { Ok(()) } else { Err("another mean, or a cut is worse than the tree".into()) }
}

/// relMSE over the pixels with a surface, and how far the mean is off.
fn compare(picture: &[Option<Vec3>], reference: &[Vec3], mean: f32) -> (f64, f32) {
    let (mut error, mut count, mut sums) = (0.0, 0, [0.0; 2]);
    for (a, b) in picture.iter().zip(reference) {
        let Some(a) = *a else { continue };
        let d = a - b;
        error += f64::from((d * d / (b * b + 0.01 * mean * mean)).element_sum());
        count += 3;
        sums = [sums[0] + a.element_sum(), sums[1] + b.element_sum()];
    }
    (error / f64::from(count), sums[0] / sums[1] - 1.0)
}
