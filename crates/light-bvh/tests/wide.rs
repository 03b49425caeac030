//! The default tree is bounded in depth, whole, and the same every time.

#![cfg(feature = "alloc")]

use light_bvh::light_bounds::light_math::glam::Vec3;
use light_bvh::light_bounds::{LightExtent, LightId, LightSampleContext};
use light_bvh::{LightBvh, LightBvhError, LightBvhOptions, MAX_DEPTH};

mod support;
use support::lamp;

const MODES: [LightBvhOptions; 3] = [
    LightBvhOptions::QUALITY,
    LightBvhOptions::FAST,
    LightBvhOptions::DYNAMIC,
];

fn nasty_sets() -> Vec<Vec<LightExtent>> {
    let n = 3000;
    vec![
        (0..n).map(|_| lamp(Vec3::ONE, 1.0)).collect(),
        (0..n).map(|i| lamp(Vec3::X * i as f32, 1.0)).collect(),
        (0..n)
            .map(|i| lamp(Vec3::X * 0.5f32.powi(i % 120), 1.0))
            .collect(),
        (0..n)
            .map(|i| lamp(Vec3::splat(1e18 * (i as f32).sin()), 1.0))
            .collect(),
        (0..n)
            .map(|i| lamp(Vec3::splat(1e-20 * (i as f32).sin()), 1.0))
            .collect(),
        (0..n)
            .map(|i| lamp(Vec3::X * i as f32, 2f32.powi(i % 200 - 100)))
            .collect(),
    ]
}

#[test]
fn depth_is_bounded_and_every_light_is_in_the_tree() {
    let sets = nasty_sets();
    for (i, (lights, options)) in sets.iter().flat_map(|s| MODES.map(|o| (s, o))).enumerate() {
        let tree = LightBvh::build_with(lights, &options).expect("valid lights");
        assert!(tree.depth() <= MAX_DEPTH, "set {i}: {}", tree.depth());
        let medium = LightSampleContext::medium(Vec3::new(0.5, 0.25, -1.0));
        let sum: f64 = (0..3000)
            .map(|id| f64::from(tree.pmf(&medium, LightId(id))))
            .sum();
        assert!((sum - 1.0).abs() < 1e-4, "set {i}: {sum}");
    }
}

#[test]
fn the_same_lights_give_the_same_tree() {
    for lights in nasty_sets() {
        let build = || LightBvh::build_with(&lights, &LightBvhOptions::FAST);
        let (a, b) = (build(), build());
        let (a, b) = (a.expect("valid lights"), b.expect("valid lights"));
        assert_eq!(a.view().nodes(), b.view().nodes(), "nodes");
        assert_eq!(a.view().order(), b.view().order(), "order");
    }
}

#[test]
fn lights_beyond_reach_are_refused_by_name() {
    let lights = [lamp(Vec3::ONE, 1.0), lamp(Vec3::splat(1e37), 1.0)];
    let error = LightBvh::build(&lights).expect_err("too far");
    assert_eq!(error, LightBvhError::TooFar { light: LightId(1) }, "which");
}

#[test]
fn lights_without_power_are_not_in_the_tree() {
    let tree = LightBvh::build(&[lamp(Vec3::ONE, 0.0)]).expect("valid lights");
    let medium = LightSampleContext::medium(Vec3::ZERO);
    assert_eq!(tree.sample(&medium, 0.5), None, "nothing to choose");
    assert_eq!(tree.pmf(&medium, LightId(0)), 0.0, "known, but dark");
    assert_eq!(tree.irradiance(&medium), 0.0, "no light");
}

#[test]
fn many_lights_at_one_point_along_a_line_or_in_nested_clusters_make_no_deep_tree() {
    let n = 60_000u16;
    let sets: [&dyn Fn(u16) -> Vec3; 3] = [&|_| Vec3::ONE, &|i| Vec3::X * f32::from(i), &|i| {
        Vec3::new(1.0, f32::from(i % 7), f32::from(i % 5)) * 0.125f32.powi(i32::from(i % 24))
    }];
    for (k, at) in sets.iter().enumerate() {
        let lights: Vec<LightExtent> = (0..n).map(|i| lamp(at(i), 1.0)).collect();
        for options in MODES {
            let tree = LightBvh::build_with(&lights, &options).expect("valid lights");
            assert!(tree.depth() <= MAX_DEPTH, "set {k}: {}", tree.depth());
            assert!(
                tree.bytes() < 40 * lights.len(),
                "set {k}: {} bytes",
                tree.bytes()
            );
        }
    }
}

#[test]
fn lights_far_closer_than_the_cells_of_the_whole_set_part_by_place() {
    // Two clusters of 300 lights in turn, 1e-3 apart, and a lamp so far away that a cell of the whole is wider than both.
    let place = |i: u16| match i {
        600 => Vec3::splat(1e6),
        _ => Vec3::X * 1e-3 * (f32::from(i % 2) + 0.1 * f32::from(i) / 600.0),
    };
    let lights: Vec<LightExtent> = (0..601).map(|i| lamp(place(i), 1.0)).collect();
    for options in MODES {
        let tree = LightBvh::build_with(&lights, &options).expect("valid lights");
        let order = tree.view().order();
        let turns = order.windows(2).filter(|w| w[0] % 2 != w[1] % 2).count();
        assert!(turns < 8, "{options:?}: clusters mix {turns} times");
    }
}
