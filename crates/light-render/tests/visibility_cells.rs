//! Cells of visibility are functions of the scene and the view, change no mean, and make hidden
//! lights rare.

use core::num::NonZeroU32;

use light_render::bench::PictureBench;
use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{RenderSettings, View, VisibilityCells, World, render};
use light_scene::glam::Vec3;
use light_scene::{BuiltinScene, Crop, OcclusionKind, OcclusionSize};
use light_testkit::Estimate;
use lights::samplers::{BvhLightSampler, LightSampler, VisibilityLightSampler};

struct Stage {
    world: World,
    view: View,
    lights: BvhLightSampler,
}

impl Stage {
    fn new(kind: OcclusionKind) -> Self {
        let scene = BuiltinScene::Occlusion(kind, OcclusionSize::Small).load();
        let view = View::new(&scene.camera_or_default(), 96, 64).expect("a view");
        let world = World::new(scene).expect("a world");
        let lights = BvhLightSampler::new(&world.lights().extents()).expect("valid bounds");
        Self {
            world,
            view,
            lights,
        }
    }

    fn cells(&self, view: &View, threads: usize) -> VisibilityCells {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().expect("threads");
        pool.install(|| VisibilityCells::fill(&self.world, view, &self.lights))
            .expect("few cells")
    }

    /// Direct light with one choice.
    fn picture<S: LightSampler + Sync>(&self, sampler: &S, seed: u32) -> Vec<Vec3> {
        let settings = RenderSettings {
            samples: 0..16,
            time_limit: None,
            seed,
            path: PathSettings {
                max_depth: 2,
                estimator: Estimator::Light,
                light_samples: NonZeroU32::MIN,
                integrator: Integrator::Path,
            },
        };
        let film = render(&self.world, &self.view, sampler, &settings, |_| ()).film;
        film.develop()
    }
}

fn mean(pictures: &[Vec<Vec3>]) -> Vec<Vec3> {
    let scale = 1.0 / pictures.len() as f32;
    (0..pictures[0].len())
        .map(|i| pictures.iter().map(|picture| picture[i] * scale).sum())
        .collect()
}

/// The sum over all pixels.
fn total(picture: &[Vec3]) -> f64 {
    let sums = picture.iter().map(|pixel| f64::from(pixel.element_sum()));
    sums.sum()
}

#[test]
fn the_same_for_any_number_of_threads_and_any_part_of_the_picture() {
    let stage = Stage::new(OcclusionKind::Rooms);
    let one = stage.cells(&stage.view, 1);
    assert!(one.bytes() > 1000, "{} bytes", one.bytes());
    assert_eq!(one, stage.cells(&stage.view, 7), "seven threads");
    let corner = Crop {
        min: [3, 5],
        max: [9, 8],
    };
    let part = stage.view.with_crop(corner).expect("a part");
    assert_eq!(one, stage.cells(&part, 2), "a part of the picture");
}

/// Rays that fill cells leave the large primitive that they start on.
#[test]
fn an_open_field_has_hardly_any_cells() {
    let [open, rooms] = [OcclusionKind::Open, OcclusionKind::Rooms].map(|kind| {
        let stage = Stage::new(kind);
        stage.cells(&stage.view, 2).bytes()
    });
    assert!(10 * open < rooms, "{open} bytes against {rooms} of rooms");
}

#[test]
fn between_slabs_the_mean_stays_and_the_noise_falls() {
    let stage = Stage::new(OcclusionKind::Slabs);
    let cells = stage.cells(&stage.view, 2);
    let guided = VisibilityLightSampler::new(stage.lights.view(), &cells);
    let seeds = [11, 12, 13, 14];
    let plain = seeds.map(|seed| stage.picture(&stage.lights, seed));
    let guided = seeds.map(|seed| stage.picture(&guided, seed + 10));
    let whole = [&plain[..], &guided].concat();
    let reference = mean(&whole);
    let bench = PictureBench::new(stage.world, stage.view).expect("a bench");
    let relative = bench.error(&reference, bench.tenth_of_mean(&reference));
    let [before, after] = [&plain, &guided].map(|pictures| {
        relative.of_pair(&pictures[0], &pictures[1]) + relative.of_pair(&pictures[2], &pictures[3])
    });
    assert!(after < 0.4 * before, "relMSE {after} against {before}");
    let [before, after] = [&plain, &guided].map(|pictures| {
        let mut sums = pictures.iter().map(|picture| total(picture));
        Estimate::of(4, || sums.next().unwrap_or_default())
    });
    assert!(
        before.agrees_with_estimate(&after),
        "{after:?} against {before:?}"
    );
}
