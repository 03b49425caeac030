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

/// Columns of each of so many strips, which are about a quarter of the picture together.
fn columns(strips: u32, width: u32) -> u32 {
    (width / (4 * strips)).max(1)
}

/// The pixels of a picture over those that its strips show; 1 without strips.
pub(super) fn pixels_over_rendered(strips: u32, width: u32) -> f64 {
    if strips == 0 {
        return 1.0;
    }
    f64::from(width) / f64::from(columns(strips, width) * strips)
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
    let columns = columns(strips, width);
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
        picture.seconds += pixels_over_rendered(strips, width) * timer.seconds();
        let rows = picture.pixels.chunks_mut(width as usize);
        for (row, part) in rows.zip(film.develop().chunks(columns as usize)) {
            row[left as usize..][..part.len()].copy_from_slice(part);
        }
    }
    Ok(picture)
}
