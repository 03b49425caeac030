//! Cells of visibility make hidden lights rare.

use light_render::bench::PictureBench;
use light_render::{AnyLightSampler, SamplerKind, View, VisibilityCells, World};
use light_scene::OcclusionKind;
use light_scene::glam::Vec3;
use light_testkit::Estimate;
use lights::samplers::{BvhLightSampler, VisibilityLightSampler};

use super::{Stage, is_the_mean, sums, total};

fn stage(kind: OcclusionKind) -> Stage {
    Stage::new(kind, 96, 64)
}

fn cells(world: &World, view: &View, lights: &BvhLightSampler) -> VisibilityCells {
    VisibilityCells::fill(world, view, lights).expect("few cells")
}

fn mean(pictures: &[Vec<Vec3>]) -> Vec<Vec3> {
    let scale = 1.0 / pictures.len() as f32;
    (0..pictures[0].len())
        .map(|i| pictures.iter().map(|picture| picture[i] * scale).sum())
        .collect()
}

#[test]
fn the_same_for_any_number_of_threads_and_any_part_of_the_picture() {
    let cells = stage(OcclusionKind::Rooms).measured_alike(cells);
    assert!(cells.bytes() > 1000, "{} bytes", cells.bytes());
}

/// 672 bytes for each pixel of the picture, whatever it shows: see `docs/occlusion.md`.
#[test]
fn they_take_no_more_memory_than_is_stated() {
    for kind in OcclusionKind::ALL {
        let stage = stage(kind);
        let cells = stage.measured(&stage.view, 2, cells);
        assert!(cells.bytes() <= 672 * 96 * 64, "{kind}: {}", cells.bytes());
    }
}

/// Rays that fill cells leave the large primitive that they start on. There is hardly a cell in the
/// open field; where a fiftieth of the rays hit what they start on, cells take 83 KB there.
#[test]
fn an_open_field_has_hardly_any_cells() {
    let [open, rooms] = [OcclusionKind::Open, OcclusionKind::Rooms].map(|kind| {
        let stage = stage(kind);
        stage.measured(&stage.view, 2, cells).bytes()
    });
    assert!(10 * open < rooms, "{open} bytes against {rooms} of rooms");
}

#[test]
fn between_slabs_the_mean_stays_and_the_noise_falls() {
    let stage = stage(OcclusionKind::Slabs);
    let cells = stage.measured(&stage.view, 2, cells);
    let guided = VisibilityLightSampler::new(stage.lights.view(), &cells);
    let seeds = [11, 12, 13, 14];
    let plain = seeds.map(|seed| stage.picture(&stage.lights, 1, seed));
    let guided = seeds.map(|seed| stage.picture(&guided, 1, seed + 10));
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

/// Of every kind of scene; `single_choices_keep_the_mean` has slabs and a street by default.
#[test]
fn in_cells_the_mean_is_that_of_uniform_choices() {
    for kind in OcclusionKind::ALL {
        let stage = Stage::new(kind, 48, 32);
        let cells = stage.measured(&stage.view, 2, cells);
        let guided = VisibilityLightSampler::new(stage.lights.view(), &cells);
        let uniform = AnyLightSampler::new(SamplerKind::Uniform, stage.world.lights());
        let uniform = sums(&stage, &uniform.expect("lights"), 500);
        let guided = sums(&stage, &guided, 600);
        assert!(
            is_the_mean(&guided, &uniform),
            "{kind}: {guided:?} against {uniform:?}"
        );
    }
}
