//! Visibility that is measured before a picture: a function of the scene and the whole view, which
//! changes no mean.

mod cells;
mod share;

use core::num::NonZeroU32;

use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{RenderSettings, View, World, render};
use light_scene::glam::Vec3;
use light_scene::{BuiltinScene, Crop, OcclusionKind, OcclusionSize};
use light_testkit::Estimate;
use lights::samplers::{BvhLightSampler, LightSampler};

/// A small scene of this kind, its picture and its lights.
struct Stage {
    world: World,
    view: View,
    lights: BvhLightSampler,
}

impl Stage {
    fn new(kind: OcclusionKind, width: u32, height: u32) -> Self {
        let scene = BuiltinScene::Occlusion(kind, OcclusionSize::Small).load();
        let view = View::new(&scene.camera_or_default(), width, height).expect("a view");
        let world = World::new(scene).expect("a world");
        let lights = BvhLightSampler::new(&world.lights().extents()).expect("valid bounds");
        Self {
            world,
            view,
            lights,
        }
    }

    /// What is measured for `view`, by so many threads.
    fn measured<T: Send>(
        &self,
        view: &View,
        threads: usize,
        measure: impl Fn(&World, &View, &BvhLightSampler) -> T + Sync,
    ) -> T {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().expect("threads");
        pool.install(|| measure(&self.world, view, &self.lights))
    }

    /// The same for 1 and 7 threads and for a part of the picture; returns it.
    fn measured_alike<T: Send + PartialEq + core::fmt::Debug>(
        &self,
        measure: impl Fn(&World, &View, &BvhLightSampler) -> T + Sync,
    ) -> T {
        let one = self.measured(&self.view, 1, &measure);
        let seven = self.measured(&self.view, 7, &measure);
        assert!(one == seven, "seven threads: {seven:?}, one: {one:?}");
        let corner = Crop {
            min: [3, 5],
            max: [9, 8],
        };
        let part = self.view.with_crop(corner).expect("a part");
        let of_part = self.measured(&part, 2, &measure);
        assert!(one == of_part, "a part: {of_part:?}, the whole: {one:?}");
        one
    }

    /// 16 samples a pixel of direct light by light samples, of at most so many lights each.
    fn picture<S: LightSampler + Sync>(&self, sampler: &S, choices: u32, seed: u32) -> Vec<Vec3> {
        let settings = RenderSettings {
            samples: 0..16,
            time_limit: None,
            seed,
            path: PathSettings {
                max_depth: 2,
                estimator: Estimator::Light,
                light_samples: NonZeroU32::new(choices).expect("some"),
                integrator: Integrator::Path,
            },
        };
        let film = render(&self.world, &self.view, sampler, &settings, |_| ()).film;
        film.develop()
    }
}

/// The sum over all pixels.
fn total(picture: &[Vec3]) -> f64 {
    let sums = picture.iter().map(|pixel| f64::from(pixel.element_sum()));
    sums.sum()
}

/// The whole picture's direct light of so many choices, once a seed.
fn sums<S: LightSampler + Sync>(stage: &Stage, sampler: &S, base: u32) -> Estimate {
    let mut seed = base;
    Estimate::of(12, || {
        seed += 1;
        total(&stage.picture(sampler, 2, seed))
    })
}

/// Whether an estimate is within 3 standard errors of that by uniform choices, which is good to a
/// tenth.
fn is_the_mean(ours: &Estimate, uniform: &Estimate) -> bool {
    let error = ours.standard_error.hypot(uniform.standard_error);
    (ours.mean - uniform.mean).abs() <= 3.0 * error && error < 0.1 * uniform.mean
}
