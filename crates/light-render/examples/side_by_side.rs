//! The scenes of `testdata/foreign` as we render them, above what Mitsuba or Cycles made of them.
//!
//! `cargo run --release -p light-render --example side_by_side` writes `out/side_by_side.png`, two
//! rows of seven pairs in the order of the table that it prints: our mean over theirs, the relMSE
//! between both pictures, and what the noise of both alone makes it.

use std::fs;
use std::path::Path;

use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{AnyLightSampler, Comparison, RenderSettings, SamplerKind, View, World, render};
use light_scene::glam::Vec3;
use light_scene::{Image, read_image, read_pbrt, write_png};

/// Pixels a side of each picture.
const SIZE: u32 = 48;

/// Screen pixels a pixel, and pairs in a row.
const ZOOM: u32 = 2;
const COLUMNS: u32 = 7;

/// Screen pixels between pictures.
const GAP: u32 = 4;

/// Samples a pixel of each of two pictures of ours, whose mean is shown.
const SPP: u32 = 512;

/// Scenes that Cycles rendered; Mitsuba the others.
const BY_CYCLES: [&str; 2] = ["brushed", "leaves"];

type Result<T> = core::result::Result<T, Box<dyn core::error::Error>>;

/// A scene: our picture, and theirs.
type Pair = [Vec<Vec3>; 2];

fn main() -> Result<()> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("testdata/foreign");
    let table = fs::read_to_string(folder.join("references.tsv"))?;
    println!(
        "| scene | by | ours over theirs | relMSE | of it noise |\n| --- | --- | --- | --- | --- |"
    );
    let mut pairs: Vec<Pair> = Vec::new();
    for row in table.lines().skip(1) {
        let figures: Vec<&str> = row.split('\t').collect();
        let [name, depth, .., their_noise] = figures[..] else {
            return Err(format!("{row}: expected the columns of references.tsv").into());
        };
        let depth: u32 = depth.parse()?;
        let [a, b] = [1, 2].map(|seed| picture(&folder.join(format!("{name}.pbrt")), depth, seed));
        let (a, b) = (a?, b?);
        let ours: Vec<Vec3> = a.iter().zip(&b).map(|(a, b)| 0.5 * (*a + *b)).collect();
        let theirs = read_image(&folder.join(format!("{name}.exr")))?
            .image
            .into_texels();
        let compared = |a, b| Comparison::new(a, b).ok_or("pictures of two sizes");
        // The mean of two pictures has a quarter of the square of their difference.
        let noise = 0.25 * compared(&a, &b)?.rel_mse + their_noise.parse::<f64>()?;
        println!(
            "| `{name}` | {} | {:.4} | {:.5} | {noise:.5} |",
            if BY_CYCLES.contains(&name) {
                "Cycles"
            } else {
                "Mitsuba"
            },
            mean(&ours) / mean(&theirs),
            compared(&ours, &theirs)?.rel_mse,
        );
        pairs.push([ours, theirs]);
    }
    fs::create_dir_all("out")?;
    write_png(Path::new("out/side_by_side.png"), &sheet(&pairs)?)?;
    Ok(())
}

/// What we make of a scene.
fn picture(path: &Path, max_depth: u32, seed: u32) -> Result<Vec<Vec3>> {
    let scene = read_pbrt(path)?;
    let view = View::new(&scene.camera_or_default(), SIZE, SIZE)?;
    let world = World::new(scene)?;
    let sampler = AnyLightSampler::new(SamplerKind::DEFAULT, world.lights())?;
    let settings = RenderSettings {
        samples: 0..SPP,
        time_limit: None,
        seed,
        path: PathSettings {
            max_depth,
            estimator: Estimator::Mis,
            light_samples: PathSettings::DEFAULT_LIGHT_SAMPLES,
            integrator: Integrator::fitting(&world),
        },
    };
    let film = render(&world, &view, &sampler, &settings, |_| ()).film;
    Ok(film.develop())
}

/// The mean of all pixels and channels.
fn mean(pixels: &[Vec3]) -> f64 {
    let sum: f64 = pixels.iter().map(|p| f64::from(p.element_sum())).sum();
    sum / (3 * pixels.len()) as f64
}

/// All pairs, ours above theirs, at the exposure that makes the mean of theirs 0.3.
fn sheet(pairs: &[Pair]) -> Result<Image> {
    let step = SIZE * ZOOM + GAP;
    let rows = 2 * u32::try_from(pairs.len())?.div_ceil(COLUMNS);
    let at = |x: u32, y: u32| {
        let (column, row) = (x / step, y / step);
        let pair = pairs.get((row / 2 * COLUMNS + column) as usize);
        let (x, y) = (x % step / ZOOM, y % step / ZOOM);
        match pair {
            Some([ours, theirs]) if x < SIZE && y < SIZE => {
                let pixels = [ours, theirs][(row % 2) as usize];
                #[expect(clippy::cast_possible_truncation, reason = "an exposure")]
                let exposure = 0.3 / mean(theirs) as f32;
                (pixels[(y * SIZE + x) as usize] * exposure).min(Vec3::ONE)
            }
            _ => Vec3::ONE,
        }
    };
    let [width, height] = [COLUMNS, rows].map(|count| count * step - GAP);
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Ok(Image::new(
        width,
        height,
        pixels.map(|(x, y)| at(x, y)).collect(),
    )?)
}
