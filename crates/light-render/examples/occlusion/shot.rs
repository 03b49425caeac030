use core::error::Error;
use core::num::NonZeroU32;

use light_render::bench::{CpuTimer, PictureBench, TimedPicture};
use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{AnyLightSampler, RenderSettings, Visibility, render};
use light_scene::Crop;
use light_scene::glam::Vec3;

use super::arguments::Arguments;
use super::methods::Method;

/// Paths of at most so many segments, with so many choices.
pub(super) const fn paths(max_depth: u32, choices: NonZeroU32) -> PathSettings {
    PathSettings {
        max_depth,
        estimator: Estimator::Mis,
        light_samples: choices,
        integrator: Integrator::Path,
    }
}

/// One picture by one method, with the time that its visibility takes.
pub(super) fn picture(
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
pub(super) fn shot(
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
