//! How noisy light is after equal time where most lights are hidden: relMSE times seconds of each
//! way to choose lights, in the scenes of `OcclusionKind`; and with `--ceilings` the variance of
//! one choice, split into what better choices can remove and what not; with `--means` whether the
//! means are those of uniform choices.
//!
//! Each picture is compared with both halves of a reference of many more samples, so that the noise
//! of the reference cancels on average; its own relMSE is a column. Pixels that show a light, and
//! those beside them, are left out; relMSE has a floor of the square of a tenth of the mean.
//! Seconds are those of all threads, without building the scene and the hierarchy of lights, but
//! with filling the cells of visibility.

use core::error::Error;
use core::fmt;
use core::num::NonZeroU32;
use core::str::FromStr;
use std::time::Instant;

use clap::Parser;
use light_render::bench::{ChoiceKind, CpuTimer, PictureBench, TimedPicture, scene_variance};
use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{AnyLightSampler, RenderSettings, SamplerKind, View, Visibility, World, render};
use light_scene::glam::Vec3;
use light_scene::{BuiltinScene, Crop, OcclusionKind, OcclusionScene};

/// Measures choices of lights where most lights are hidden.
#[derive(Debug, Parser)]
struct Arguments {
    /// The scenes, with commas between: names, or KIND:LAMPS:SEED; all kinds of occlusion, small
    /// and large, by default.
    #[arg(long, value_delimiter = ',', default_values_t = occluded())]
    scenes: Vec<Place>,
    /// Choices by their place in the list of all, from 0 on, with commas between; the first is what
    /// the others are set against.
    #[arg(long, value_delimiter = ',', value_parser = method)]
    methods: Vec<&'static Method>,
    /// Samples a pixel, with commas between.
    #[arg(long, value_delimiter = ',', default_values_t = [16, 64, 256, 1024])]
    samples: Vec<u32>,
    /// Width and height of the pictures.
    #[arg(long, default_value = "96x64", value_parser = size)]
    size: (u32, u32),
    /// Samples a pixel of each half of the reference.
    #[arg(long, default_value_t = 2048)]
    reference: u32,
    /// Render so many upright strips alone, evenly over the picture, that show a quarter of it: each
    /// figure is an estimate of that of the whole. Cells are those of the whole.
    #[arg(long, default_value_t = 0)]
    strips: u32,
    /// Pictures of other seeds that each figure is the mean of.
    #[arg(long, default_value_t = 2)]
    seeds: u32,
    /// Segments of the longest path: 2 is direct light.
    #[arg(long, default_value_t = 2)]
    max_depth: u32,
    /// Print the variance of one choice instead, exact over all lights.
    #[arg(long)]
    ceilings: bool,
    /// Print how far the means of pictures are from those of uniform choices instead, in standard
    /// errors: all means are the same if no light is lost.
    #[arg(long, conflicts_with = "ceilings")]
    means: bool,
    /// With --ceilings: receivers, one for each pixel of a picture of this size.
    #[arg(long, default_value = "24x16", value_parser = size)]
    receivers: (u32, u32),
    /// With --ceilings: the points of each light are the square of this.
    #[arg(long, default_value_t = 3)]
    strata: u16,
}

/// A built-in scene, or one generated with another seed or number of lamps.
#[derive(Clone, Copy, Debug)]
enum Place {
    Builtin(BuiltinScene),
    Generated(OcclusionScene),
}

/// A way to choose lights at the first vertex.
#[derive(Debug)]
struct Method {
    name: &'static str,
    sampler: SamplerKind,
    choices: NonZeroU32,
    /// Whether cells guide the choices of the default tree.
    visibility: Visibility,
}

/// What is compared; the others are set against the first.
static METHODS: [Method; 6] = [
    Method {
        name: "one choice",
        sampler: SamplerKind::Bvh,
        choices: NonZeroU32::MIN,
        visibility: Visibility::Off,
    },
    Method {
        name: "two choices",
        sampler: SamplerKind::Bvh,
        choices: PathSettings::DEFAULT_LIGHT_SAMPLES,
        visibility: Visibility::Off,
    },
    Method {
        name: "reference tree",
        sampler: SamplerKind::BvhReference,
        choices: NonZeroU32::MIN,
        visibility: Visibility::Off,
    },
    Method {
        name: "default",
        sampler: SamplerKind::Bvh,
        choices: PathSettings::DEFAULT_LIGHT_SAMPLES,
        visibility: Visibility::Share,
    },
    Method {
        name: "cells",
        sampler: SamplerKind::Bvh,
        choices: NonZeroU32::MIN,
        visibility: Visibility::Cells,
    },
    Method {
        name: "cells, two elsewhere",
        sampler: SamplerKind::Bvh,
        choices: PathSettings::DEFAULT_LIGHT_SAMPLES,
        visibility: Visibility::Cells,
    },
];

fn main() -> Result<(), Box<dyn Error>> {
    let arguments = Arguments::parse();
    if arguments.ceilings {
        ceilings(&arguments)
    } else if arguments.means {
        means(&arguments)
    } else {
        pictures(&arguments)
    }
}

/// The scenes that are measured by default.
fn occluded() -> Vec<Place> {
    let is_occluded = |scene: &BuiltinScene| matches!(scene, BuiltinScene::Occlusion(..));
    let scenes = BuiltinScene::ALL.into_iter();
    scenes.filter(is_occluded).map(Place::Builtin).collect()
}

impl FromStr for Place {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if let Ok(scene) = text.parse() {
            return Ok(Self::Builtin(scene));
        }
        let mut words = text.split(':');
        let mut next = || words.next().unwrap_or_default();
        let (kind, lamps, seed) = (next(), next(), next());
        let kind = OcclusionKind::ALL
            .into_iter()
            .find(|k| k.to_string() == kind);
        let scene = match (kind, lamps.parse(), seed.parse()) {
            (Some(kind), Ok(lamps), Ok(seed)) => OcclusionScene { kind, lamps, seed },
            _ => return Err("expected a built-in scene or KIND:LAMPS:SEED"),
        };
        Ok(Self::Generated(scene))
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Builtin(scene) => scene.fmt(f),
            Self::Generated(OcclusionScene { kind, lamps, seed }) => {
                write!(f, "{kind}:{lamps}:{seed}")
            }
        }
    }
}

/// One of [`METHODS`].
fn method(text: &str) -> Result<&'static Method, String> {
    let method = text.parse().ok().and_then(|i: usize| METHODS.get(i));
    method.ok_or_else(|| format!("expected a number from 0 to {}", METHODS.len() - 1))
}

/// `WIDTHxHEIGHT`.
fn size(text: &str) -> Result<(u32, u32), String> {
    let read = |part: &str| part.parse().ok().filter(|&n: &u32| n > 0 && n <= 1 << 12);
    let ends = text
        .split_once('x')
        .and_then(|(width, height)| Some((read(width)?, read(height)?)));
    ends.ok_or_else(|| "expected WIDTHxHEIGHT, each 1 to 4096".to_owned())
}

/// A scene, seen by its camera.
fn load(scene: Place, (width, height): (u32, u32)) -> Result<(World, View), Box<dyn Error>> {
    let scene = match scene {
        Place::Builtin(scene) => scene.load(),
        Place::Generated(scene) => scene.load(),
    };
    let view = View::new(&scene.camera_or_default(), width, height)?;
    Ok((World::new(scene)?, view))
}

/// Paths of at most so many segments, with so many choices.
const fn paths(max_depth: u32, choices: NonZeroU32) -> PathSettings {
    PathSettings {
        max_depth,
        estimator: Estimator::Mis,
        light_samples: choices,
        integrator: Integrator::Path,
    }
}

/// A table of relMSE, seconds and their product.
fn pictures(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let half = arguments.reference;
    let mut methods = arguments.methods.clone();
    if methods.is_empty() {
        methods = METHODS.iter().collect();
    }
    println!("Reference: two halves of {half} samples a pixel.");
    let mut title = "| scene | samples | reference".to_owned();
    let mut line = "| --- | --- | ---".to_owned();
    for (i, method) in methods.iter().enumerate() {
        title += &format!(" | {}: relMSE | s | relMSE x s", method.name);
        line += " | --- | --- | ---";
        if i > 0 {
            title += &format!(" | {} / {}", method.name, methods[0].name);
            line += " | ---";
        }
    }
    println!("{title} |\n{line} |");
    for &scene in &arguments.scenes {
        let start = Instant::now();
        let (world, view) = load(scene, arguments.size)?;
        let bench = PictureBench::new(world, view)?;
        let lights = bench.world().lights();
        let samplers: Vec<AnyLightSampler> = methods
            .iter()
            .map(|method| AnyLightSampler::new(method.sampler, lights))
            .collect::<Result<_, _>>()?;
        eprintln!("{scene}: {} lights, reference", lights.len());
        let path = paths(arguments.max_depth, NonZeroU32::MIN);
        // The default is the least noisy, and all means are the same.
        let best = AnyLightSampler::new(SamplerKind::Bvh, lights)?.by_estimates(
            bench.world(),
            bench.view(),
            arguments.max_depth,
        );
        let [a, b] = [
            shot(arguments, &bench, &best, path, half, 1001)?.pixels,
            shot(arguments, &bench, &best, path, half, 1002)?.pixels,
        ];
        let reference: Vec<_> = a.iter().zip(&b).map(|(a, b)| 0.5 * (*a + *b)).collect();
        // Pixels that are not rendered are 0, and count in means.
        let pixels = if arguments.strips > 0 { 4.0 } else { 1.0 };
        let floor = pixels * pixels * bench.tenth_of_mean(&reference);
        let relative = bench.error(&reference, floor);
        let own = 0.5 * pixels * relative.of_pair(&a, &b);
        for &samples in &arguments.samples {
            eprintln!("{scene}: {samples} samples, {:.0?}", start.elapsed());
            print!("| {scene} | {samples} | {}", figure(own));
            let mut first = None;
            for (method, sampler) in methods.iter().zip(&samplers) {
                let (mut error, mut seconds) = (0.0, 0.0);
                for seed in 1..=arguments.seeds {
                    let picture = picture(arguments, &bench, (method, sampler), samples, seed)?;
                    error += pixels * relative.against(&picture.pixels, [&a, &b]);
                    seconds += picture.seconds;
                }
                let count = f64::from(arguments.seeds.max(1));
                let (error, seconds) = (error / count, seconds / count);
                let product = error * seconds;
                print!(" | {} | {seconds:.2} | {}", figure(error), figure(product));
                if let Some(first) = first {
                    print!(" | {:.2}", product / first);
                }
                first = first.or(Some(product));
            }
            println!(" |");
        }
    }
    Ok(())
}

/// One picture by one method, with the time that its visibility takes.
fn picture(
    arguments: &Arguments,
    bench: &PictureBench,
    (method, sampler): (&Method, &AnyLightSampler),
    samples: u32,
    seed: u32,
) -> Result<TimedPicture, Box<dyn Error>> {
    let path = paths(arguments.max_depth, method.choices);
    if method.visibility == Visibility::Off {
        return shot(arguments, bench, sampler, path, samples, seed);
    }
    let sampler = sampler.clone();
    let timer = CpuTimer::start();
    let guided = match method.visibility {
        Visibility::Cells => sampler.in_cells(bench.world(), bench.view(), arguments.max_depth)?,
        _ => sampler.by_estimates(bench.world(), bench.view(), arguments.max_depth),
    };
    let filling = timer.seconds();
    let mut picture = shot(arguments, bench, &guided, path, samples, seed)?;
    picture.seconds += filling;
    Ok(picture)
}

/// A picture, or its strips in an empty one, with the seconds of the whole.
fn shot(
    arguments: &Arguments,
    bench: &PictureBench,
    sampler: &AnyLightSampler,
    path: PathSettings,
    samples: u32,
    seed: u32,
) -> Result<TimedPicture, Box<dyn Error>> {
    let strips = arguments.strips;
    if strips == 0 {
        return Ok(bench.picture(sampler, path, samples, seed));
    }
    let settings = RenderSettings {
        samples: 0..samples,
        time_limit: None,
        seed,
        path,
    };
    let (width, height) = bench.view().resolution();
    let columns = (width / (4 * strips)).max(1);
    let mut picture = TimedPicture {
        pixels: vec![Vec3::ZERO; (width * height) as usize],
        seconds: 0.0,
    };
    for strip in 0..strips {
        let left = (2 * strip + 1) * width / (2 * strips) - columns / 2;
        let crop = Crop {
            min: [left, 0],
            max: [left + columns, height],
        };
        let view = bench.view().with_crop(crop)?;
        let timer = CpuTimer::start();
        let film = render(bench.world(), &view, sampler, &settings, |_| ()).film;
        let parts = f64::from(width) / f64::from(columns * strips);
        picture.seconds += parts * timer.seconds();
        let rows = picture.pixels.chunks_mut(width as usize);
        for (row, part) in rows.zip(film.develop().chunks(columns as usize)) {
            row[left as usize..][..part.len()].copy_from_slice(part);
        }
    }
    Ok(picture)
}

/// A table of means and their standard errors, one for each method.
fn means(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let mut methods = arguments.methods.clone();
    if methods.is_empty() {
        methods = METHODS.iter().collect();
    }
    let samples = arguments.samples.first().copied().unwrap_or(1);
    println!("{} pictures of {samples} samples a pixel.", arguments.seeds);
    let mut title = "| scene | uniform choices".to_owned();
    let mut line = "| --- | ---".to_owned();
    for method in &methods {
        title += &format!(" | {} | standard errors", method.name);
        line += " | --- | ---";
    }
    println!("{title} |\n{line} |");
    for &scene in &arguments.scenes {
        let (world, view) = load(scene, arguments.size)?;
        let bench = PictureBench::new(world, view)?;
        let uniform = AnyLightSampler::new(SamplerKind::Uniform, bench.world().lights())?;
        let path = paths(arguments.max_depth, NonZeroU32::MIN);
        let light = |pixels: &[Vec3]| -> f64 {
            let sum = pixels.iter().map(|pixel| f64::from(pixel.element_sum()));
            sum.sum::<f64>() / pixels.len() as f64
        };
        let expected = mean(arguments, 1000, |seed| {
            Ok(light(&bench.picture(&uniform, path, samples, seed).pixels))
        })?;
        print!("| {scene} | {} +- {:.1e}", figure(expected[0]), expected[1]);
        for (method, number) in methods.iter().zip(2..) {
            let sampler = AnyLightSampler::new(method.sampler, bench.world().lights())?;
            let [mean, error] = mean(arguments, 1000 * number, |seed| {
                let picture = picture(arguments, &bench, (method, &sampler), samples, seed)?;
                Ok(light(&picture.pixels))
            })?;
            let apart = (mean - expected[0]) / error.hypot(expected[1]);
            print!(" | {} +- {error:.1e} | {apart:.1}", figure(mean));
        }
        println!(" |");
    }
    Ok(())
}

/// The mean over seeds, and its standard error.
fn mean(
    arguments: &Arguments,
    base: u32,
    mut of_seed: impl FnMut(u32) -> Result<f64, Box<dyn Error>>,
) -> Result<[f64; 2], Box<dyn Error>> {
    let values: Vec<f64> = (base..base + arguments.seeds)
        .map(&mut of_seed)
        .collect::<Result<_, _>>()?;
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares = values.iter().map(|value| (value - mean).powi(2));
    let error = (squares.sum::<f64>() / (count * (count - 1.0))).sqrt();
    Ok([mean, error])
}

/// A table of the variance of one choice.
fn ceilings(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let mut title = "| scene | lights | receivers | arriving".to_owned();
    let mut line = "| --- | --- | --- | ---".to_owned();
    for kind in ChoiceKind::ALL {
        title += &format!(" | {}", kind.name());
        line += " | ---";
    }
    println!("{title} |\n{line} |");
    for &scene in &arguments.scenes {
        let start = Instant::now();
        let (world, view) = load(scene, arguments.receivers)?;
        eprintln!("{scene}: {} lights", world.lights().len());
        let variance = scene_variance(&world, &view, arguments.strata, 1)?;
        print!(
            "| {scene} | {} | {} | {:.2}",
            world.lights().len(),
            variance.receivers,
            variance.arriving
        );
        for (kind, v) in &variance.rows {
            print!(" | {} + {}", figure(v.between), figure(v.within));
            if v.lost > 0.0 {
                eprintln!("{scene}: {} loses {:e} of the light", kind.name(), v.lost);
            }
        }
        println!(" |");
        eprintln!("{scene}: {:.0?}", start.elapsed());
    }
    Ok(())
}

/// Two or three significant digits.
fn figure(x: f64) -> String {
    match x.abs() {
        a if a >= 100.0 => format!("{x:.0}"),
        a if a >= 10.0 => format!("{x:.1}"),
        a if a >= 0.1 => format!("{x:.2}"),
        a if a >= 0.001 => format!("{x:.4}"),
        _ => format!("{x:.1e}"),
    }
}
