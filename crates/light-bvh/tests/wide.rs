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
