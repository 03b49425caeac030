//! What light samples before a picture tell of its light, and the choices that follow from it.

use light_render::{
    AnyLightSampler, ChoiceEstimates, ChoicePlan, PlannedLightSampler, SamplerKind, View, World,
};
use light_scene::{BuiltinScene, OcclusionKind, OcclusionScene, OcclusionSize, Scene};
use lights::samplers::BvhLightSampler;

use super::{Stage, is_the_mean, sums};

/// Segments of the longest path with direct light alone.
const DIRECT: u32 = 2;

fn stage(kind: OcclusionKind) -> Stage {
    Stage::new(kind, 48, 32)
}

fn estimates(world: &World, view: &View, lights: &BvhLightSampler) -> ChoiceEstimates {
    ChoiceEstimates::new(world, view, lights, DIRECT).expect("lit")
}

fn of_scene(scene: Scene, max_depth: u32) -> Option<ChoiceEstimates> {
    let view = View::new(&scene.camera_or_default(), 48, 32).expect("a view");
    let world = World::new(scene).expect("a world");
    let lights = BvhLightSampler::new(&world.lights().extents()).expect("valid bounds");
    ChoiceEstimates::new(&world, &view, &lights, max_depth)
}

fn of_kind(kind: OcclusionKind) -> ChoiceEstimates {
    let scene = BuiltinScene::Occlusion(kind, OcclusionSize::Small).load();
    of_scene(scene, DIRECT).expect("lit")
}

#[test]
fn they_are_those_of_the_whole_picture_for_any_number_of_threads() {
    let street = stage(OcclusionKind::Street).measured_alike(estimates);
    let share = street.visible_share();
    assert!(share > 0.4 && share < 0.9, "{street:?}");
}

#[test]
fn only_hidden_light_is_missing() {
    let open = of_kind(OcclusionKind::Open).visible_share();
    assert!(open > 0.95, "the open field: {open}");
    let rooms = of_kind(OcclusionKind::Rooms).visible_share();
    assert!(rooms < 0.3, "rooms: {rooms}");
}

#[test]
fn a_scene_without_lights_has_none() {
    let mut scene = BuiltinScene::Occlusion(OcclusionKind::Open, OcclusionSize::Small).load();
    scene.lights.clear();
    for material in &mut scene.materials {
        material.emission = None;
    }
    assert_eq!(of_scene(scene, DIRECT), None, "nothing emits");
}

/// The plans that have the least error at equal time: by pictures, see `docs/occlusion.md`.
#[test]
fn the_best_plan_is_that_of_pictures() {
    for (kind, lamps, seed, best) in [
        (OcclusionKind::Slabs, 300, 8, ChoicePlan::OneFromRoot),
        (OcclusionKind::Rooms, 60, 9, ChoicePlan::OneFromRoot),
        (OcclusionKind::Street, 200, 6, ChoicePlan::OneByCut),
        (OcclusionKind::Trunks, 300, 5, ChoicePlan::OneByCut),
        (OcclusionKind::Open, 100, 3, ChoicePlan::AsAsked),
    ] {
        let scene = OcclusionScene { kind, lamps, seed }.load();
        let found = of_scene(scene, DIRECT).expect("lit").best();
        assert_eq!(found, best, "{kind} of {lamps} lamps, seed {seed}");
    }
    let trunks = BuiltinScene::Occlusion(OcclusionKind::Trunks, OcclusionSize::Small).load();
    let found = of_scene(trunks, 8).expect("lit").best();
    assert_eq!(found, ChoicePlan::OneByCut, "whole paths among trunks");
    // A single choice of few lights is what any cut makes, and is faster.
    let box_of_two = BuiltinScene::CornellBox.load();
    let found = of_scene(box_of_two, 8).expect("lit").best();
    assert_eq!(found, ChoicePlan::OneFromRoot, "two lights");
}

/// Variances are near those of `docs/occlusion.md`, exact over all lights. Few samples find too
/// little of rare light, so the bounds are wide.
#[test]
fn variances_are_near_the_exact_ones() {
    for (kind, root, by_cut) in [
        (OcclusionKind::Slabs, 4.2, 6.4),
        (OcclusionKind::Street, 1.4, 0.73),
        (OcclusionKind::Boxes, 3.9, 2.8),
        (OcclusionKind::Trunks, 1.3, 0.88),
    ] {
        let found = of_kind(kind);
        for (plan, exact) in [
            (ChoicePlan::OneFromRoot, root),
            (ChoicePlan::OneByCut, by_cut),
        ] {
            let ratio = found.variance(plan) / exact;
            assert!(ratio > 0.6 && ratio < 1.5, "{kind}, {plan:?}: {found:?}");
        }
    }
}

/// Within 3 standard errors of uniform choices: from the root, by a cut, and in cells.
#[test]
fn single_choices_keep_the_mean() {
    for (kind, plan) in [
        (OcclusionKind::Slabs, ChoicePlan::OneFromRoot),
        (OcclusionKind::Street, ChoicePlan::OneByCut),
    ] {
        let stage = stage(kind);
        let Stage { world, view, .. } = &stage;
        let of = |kind| AnyLightSampler::new(kind, world.lights()).expect("valid bounds");
        let planned = PlannedLightSampler::new(stage.lights.clone(), plan);
        let in_cells = of(SamplerKind::Bvh).by_estimates(world, view, DIRECT);
        assert!(pixels_in_cells(&in_cells) > 0, "{kind}: cells pay");
        let uniform = sums(&stage, &of(SamplerKind::Uniform), 200);
        for ours in [sums(&stage, &planned, 100), sums(&stage, &in_cells, 300)] {
            assert!(
                is_the_mean(&ours, &uniform),
                "{kind}: {ours:?} against {uniform:?}"
            );
        }
    }
}

/// How many pixels show a cell with factors.
fn pixels_in_cells(sampler: &AnyLightSampler) -> usize {
    match sampler {
        AnyLightSampler::BvhInCells(sampler) => sampler.cells().pixels(),
        _ => 0,
    }
}

fn by_estimates(world: &World, view: &View, max_depth: u32) -> AnyLightSampler {
    let lights = AnyLightSampler::new(SamplerKind::Bvh, world.lights()).expect("valid bounds");
    lights.by_estimates(world, view, max_depth)
}

/// Cells are filled where pictures of 64 samples have less error with them at equal time, and where
/// they have not, there are none: see `docs/occlusion.md`.
#[test]
fn cells_are_filled_where_they_pay() {
    for (kind, pays) in [
        (OcclusionKind::Rooms, true),
        (OcclusionKind::Slabs, true),
        (OcclusionKind::Boxes, true),
        (OcclusionKind::Street, true),
        (OcclusionKind::Open, false),
    ] {
        let Stage { world, view, .. } = Stage::new(kind, 96, 64);
        let pixels = pixels_in_cells(&by_estimates(&world, &view, DIRECT));
        assert_eq!(pixels > 96 * 64 / 5, pays, "{kind}: {pixels} pixels");
        assert_eq!(pixels > 0, pays, "{kind}: {pixels} pixels");
    }
    // Most noise of whole paths is of later vertices, where no cell is.
    let Stage { world, view, .. } = Stage::new(OcclusionKind::Rooms, 96, 64);
    assert_eq!(pixels_in_cells(&by_estimates(&world, &view, 8)), 0);
}

#[test]
fn cells_that_pay_are_those_of_the_whole_picture_for_any_number_of_threads() {
    let cells = stage(OcclusionKind::Slabs).measured_alike(|world, view, _| {
        match by_estimates(world, view, DIRECT) {
            AnyLightSampler::BvhInCells(sampler) => sampler.cells().clone(),
            other => panic!("no cells: {other:?}"),
        }
    });
    assert!(cells.bytes() > 1000, "{} bytes", cells.bytes());
}
