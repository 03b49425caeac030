use core::num::NonZeroU32;

use lights::glam::Vec3;

use crate::integrator::{Estimator, Integrator, PathSettings};
use crate::{
    AnyLightSampler, AnyLightSamplerError, RenderSettings, SamplerKind, View, World, render,
};

/// For each pixel, whether neither it nor one of its neighbours shows a light. The edges of small
/// lamps are noise that no light sampler can remove.
///
/// # Errors
/// When the lights are more than ids.
pub(crate) fn pixels_without_lights(
    world: &World,
    view: &View,
) -> Result<Vec<bool>, AnyLightSamplerError> {
    let sampler = AnyLightSampler::new(SamplerKind::Uniform, world.lights())?;
    let settings = RenderSettings {
        samples: 0..32,
        time_limit: None,
        seed: 1,
        path: PathSettings {
            max_depth: 1,
            estimator: Estimator::Bsdf,
            light_samples: NonZeroU32::MIN,
            integrator: Integrator::Path,
        },
    };
    let film = render(world, view, &sampler, &settings, |_| ()).film;
    let (width, height) = film.resolution();
    let seen = film.develop();
    let is_dark = |x: u32, y: u32| seen[(y * width + x) as usize] == Vec3::ZERO;
    let around = |i: u32, end: u32| i.saturating_sub(1)..(i + 2).min(end);
    let dark = |x, y| around(y, height).all(|v| around(x, width).all(|u| is_dark(u, v)));
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Ok(pixels.map(|(x, y)| dark(x, y)).collect())
}
