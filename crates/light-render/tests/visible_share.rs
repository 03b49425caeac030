//! The share of light that arrives, and single choices where much is hidden.

use core::num::NonZeroU32;

use light_render::integrator::{Estimator, Integrator, PathSettings};
use light_render::{
    AnyLightSampler, RenderSettings, SamplerKind, View, World, render, visible_share,
};
use light_scene::{BuiltinScene, Crop, OcclusionKind, OcclusionSize};
use light_testkit::Estimate;
use lights::samplers::{BvhLightSampler, LightSampler};

fn stage(kind: OcclusionKind) -> (World, View) {
    let scene = BuiltinScene::Occlusion(kind, OcclusionSize::Small).load();
    let view = View::new(&scene.camera_or_default(), 48, 32).expect("a view");
    (World::new(scene).expect("a world"), view)
}

fn share(world: &World, view: &View, threads: usize) -> Option<f32> {
    let lights = BvhLightSampler::new(&world.lights().extents()).expect("valid bounds");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    let pool = pool.build().expect("threads");
    pool.install(|| visible_share(world, view, &lights))
}

#[test]
fn the_share_is_that_of_the_whole_picture_for_any_number_of_threads() {
    let (world, view) = stage(OcclusionKind::Street);
    let one = share(&world, &view, 1);
    assert!(one > Some(0.4) && one < Some(0.9), "{one:?}");
    assert_eq!(one, share(&world, &view, 7), "seven threads");
    let corner = Crop {
        min: [3, 5],
        max: [9, 8],
    };
    let part = view.with_crop(corner).expect("a part");
    assert_eq!(one, share(&world, &part, 2), "a part of the picture");
}

#[test]
fn only_hidden_light_is_missing() {
    let (world, view) = stage(OcclusionKind::Open);
    assert!(share(&world, &view, 2) > Some(0.95), "the open field");
    let (world, view) = stage(OcclusionKind::Rooms);
    assert!(share(&world, &view, 2) < Some(0.3), "rooms");
}

#[test]
fn a_scene_without_lights_has_no_share() {
    let mut scene = BuiltinScene::Occlusion(OcclusionKind::Open, OcclusionSize::Small).load();
    scene.lights.clear();
    for material in &mut scene.materials {
        material.emission = None;
    }
    let view = View::new(&scene.camera_or_default(), 48, 32).expect("a view");
    let world = World::new(scene).expect("a world");
    assert_eq!(share(&world, &view, 2), None, "nothing emits");
}

/// The whole picture's direct light by light samples, once a seed.
fn sums<S: LightSampler + Sync>((world, view): &(World, View), sampler: &S, base: u32) -> Estimate {
    let mut seed = base;
    Estimate::of(12, || {
        seed += 1;
        let settings = RenderSettings {
            samples: 0..16,
            time_limit: None,
            seed,
            path: PathSettings {
                max_depth: 2,
                estimator: Estimator::Light,
                light_samples: NonZeroU32::new(2).expect("two"),
                integrator: Integrator::Path,
            },
        };
        let film = render(world, view, sampler, &settings, |_| ()).film;
        let pixels = film.develop();
        pixels.iter().map(|p| f64::from(p.element_sum())).sum()
    })
}

/// Within 3 standard errors of uniform choices.
#[test]
fn single_choices_keep_the_mean() {
    for kind in [OcclusionKind::Slabs, OcclusionKind::Street] {
        let stage = stage(kind);
        let (world, view) = &stage;
        let of = |kind| AnyLightSampler::new(kind, world.lights()).expect("valid bounds");
        let single = of(SamplerKind::Bvh).by_visible_share(world, view);
        assert!(
            matches!(single, AnyLightSampler::BvhSingleChoice(_)),
            "{kind}: much is hidden"
        );
        let [ours, uniform] = [
            sums(&stage, &single, 100),
            sums(&stage, &of(SamplerKind::Uniform), 200),
        ];
        let error = ours.standard_error.hypot(uniform.standard_error);
        assert!(
            (ours.mean - uniform.mean).abs() <= 3.0 * error && error < 0.1 * uniform.mean,
            "{kind}: {ours:?} against {uniform:?}"
        );
    }
}
