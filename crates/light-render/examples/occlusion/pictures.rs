//! What pictures by each choice cost.

use core::error::Error;
use core::num::NonZeroU32;
use std::time::Instant;

use light_render::bench::PictureBench;
use light_render::{AnyLightSampler, SamplerKind};

use super::arguments::Arguments;
use super::figure::figure;
use super::place::load;
use super::shot::{paths, picture, pixels_over_rendered, shot};

/// A table of relMSE, seconds and their product.
pub(super) fn pictures(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    let half = arguments.reference;
    let methods = &arguments.methods;
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
        let (world, view) = load(scene, arguments.gloss, arguments.size)?;
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
        let pixels = pixels_over_rendered(arguments.strips, arguments.size.0);
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
