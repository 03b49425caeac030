//! What games do today against the tree, in the same compute pass, at equal time:
//! `cargo run --release --example techniques -- [SECONDS [WIDTH HEIGHT]]`.
//!
//! Each technique adds frames to the picture of the canal by night for so many seconds (default:
//! 4): of processor time on a software driver, of the clock on a graphics card. A reference of many
//! choices by the CPU says how far each picture is off. Shadows are in none of them. The default
//! size, 160 x 96, is for software drivers: it does not fill a graphics card.

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

/// Columns and rows of the picture, unless others are asked for.
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
    let mut arguments = std::env::args().skip(1);
    let seconds: f64 = arguments.next().map_or(Ok(4.0), |n| n.parse())?;
    let mut size = SIZE;
    for edge in &mut size {
        *edge = arguments.next().map_or(Ok(*edge), |n| n.parse())?;
    }
    let (lights, pixels) = pixels::pixels(size)?;
    let reference = reference::reference(&lights, &pixels)?;
    let surfaces = pixels.iter().filter(|pixel| is_surface(pixel)).count() as f32;
    let mean = reference.iter().map(|p| p.element_sum()).sum::<f32>() / (3.0 * surfaces);
    let tree = light_sampler_rows(&BvhLightSampler::new(&lights.extents())?.view())?;
    let set = light_set_rows(&lights)?;
    let [width, height] = size;
    let rows = |lists: &Tiles| {
        let set_at = 2 + tree.len() as u32;
        let tiles_at = set_at + set.len() as u32;
        let head = [
            [set_at, tiles_at, tiles_at + lists.tiles.len() as u32, 0],
            [width, lists.columns, lights.len() as u32, 0],
        ];
        [&head[..], &tree, &set, &lists.tiles, &lists.entries].concat()
    };
    let compute = Compute::new(&rows(&Tiles::default()), &pixels)?;
    let (count, device) = (lights.len(), compute.name());
    println!("{count} lights, {width} x {height} pixels, {seconds} s each on {device}");
    println!("| technique | frames | relMSE | of 99 % | mean |");
    println!("| --- | ---: | ---: | ---: | ---: |");
    let print = |name: &str, lit: &Lit| {
        let it = compare(&lit.picture, &reference, mean);
        let (frames, bias) = (f64::from(lit.frames), 100.0 * it.bias);
        let [error, most] = [it.error, it.error_of_most];
        println!("| {name} | {frames} | {error:.2e} | {most:.2e} | {bias:+.1} % |");
        (frames * most, it.bias)
    };
    let mut is_right = true;
    let mut of_tree = f64::INFINITY;
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
        let lists = tiles(&lights, &pixels, size, part * mean);
        let compute = Compute::new(&rows(&lists), &pixels)?;
        let name = format!("lists of tiles, {:.0} lights on average", lists.mean_length());
        print(&name, &compute.light("by_tile", seconds)?);
    }
    if is_right { Ok(()) } else { Err("another mean, or a cut is worse than the tree".into()) }
}

/// How far a picture is off.
struct Compared {
    /// relMSE over the pixels with a surface.
    error: f64,
    /// The same without the hundredth of them that is furthest off: where a light is within
    /// centimetres of a surface, a single choice of it may outweigh all other pixels.
    error_of_most: f64,
    /// How far the mean is off.
    bias: f32,
}

fn compare(picture: &[Option<Vec3>], reference: &[Vec3], mean: f32) -> Compared {
    let (mut errors, mut sums) = (Vec::new(), [0.0; 2]);
    for (a, b) in picture.iter().zip(reference) {
        let Some(a) = *a else { continue };
        let d = a - b;
        errors.push(f64::from((d * d / (b * b + 0.01 * mean * mean)).element_sum() / 3.0));
        sums = [sums[0] + a.element_sum(), sums[1] + b.element_sum()];
    }
    errors.sort_unstable_by(f64::total_cmp);
    let average = |errors: &[f64]| errors.iter().sum::<f64>() / errors.len() as f64;
    Compared {
        error: average(&errors),
        error_of_most: average(&errors[..errors.len() - errors.len() / 100]),
        bias: sums[0] / sums[1] - 1.0,
    }
}
