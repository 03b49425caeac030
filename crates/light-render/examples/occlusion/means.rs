//! Whether each choice has the mean of uniform choices.

use core::error::Error;
use core::num::NonZeroU32;

use light_render::bench::PictureBench;
use light_render::{AnyLightSampler, SamplerKind};
use light_scene::glam::Vec3;

use super::arguments::Arguments;
use super::figure::figure;
use super::place::load;
use super::shot::{paths, picture};

/// A table of means and their standard errors, one for each method: of whole pictures.
pub(super) fn means(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let arguments = &Arguments {
        strips: 0,
        seeds: arguments.seeds.max(2),
        ..arguments.clone()
    };
    let methods = &arguments.methods;
    let samples = arguments.samples.first().copied().unwrap_or(1);
    println!("{} pictures of {samples} samples a pixel.", arguments.seeds);
    let mut title = "| scene | uniform choices".to_owned();
    let mut line = "| --- | ---".to_owned();
    for method in methods {
        title += &format!(" | {} | standard errors", method.name);
        line += " | --- | ---";
    }
    println!("{title} |\n{line} |");
    for &scene in &arguments.scenes {
        let (world, view) = load(scene, arguments.gloss, arguments.size)?;
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
