//! What an error of a build says, and what it rests on.

use core::error::Error;

use light_bvh::light_bounds::light_math::glam::Vec3;
use light_bvh::light_bounds::{InfiniteBounds, LightExtent};
use light_bvh::reference::ReferenceLightBvh;
use light_bvh::{LightBvh, LightBvhError};

use crate::support::lamp;

#[test]
fn bad_bounds_are_the_source_of_the_error() {
    let bad = [lamp(Vec3::ZERO, 1.0), lamp(Vec3::ZERO, -1.0)];
    let error = LightBvh::build(&bad).expect_err("a negative power");
    let source = error.source().expect("the reason").to_string();
    assert_eq!(error.to_string(), format!("light 1: {source}"), "bounds");
    let sky = LightExtent::Infinite(InfiniteBounds::distant(-1.0, Vec3::Z));
    let error = LightBvh::build(&[sky]).expect_err("a negative irradiance");
    let source = error.source().expect("the reason").to_string();
    assert_eq!(error.to_string(), format!("light 0: {source}"), "a sky");
}

#[test]
fn other_errors_are_their_own_reason() {
    let far = LightBvh::build(&[lamp(Vec3::splat(2e36), 1.0)]);
    let far = far.expect_err("beyond all scenes");
    let mut tree = LightBvh::build(&[lamp(Vec3::ZERO, 1.0)]).expect("a lamp");
    let other = tree.refit(&[]).expect_err("none in place of one");
    let sky = LightExtent::Infinite(InfiniteBounds::distant(1.0, Vec3::Z));
    let no_place = tree.refit(&[sky]).expect_err("a sky in place of a lamp");
    for (error, says) in [
        (far, "light 0: a coordinate is beyond 1e36"),
        (other, "expected 1 lights, as when the tree was built"),
        (
            no_place,
            "light 0: no place in the tree that fits; build a new tree",
        ),
        (
            LightBvhError::TooManyLights { most: 9 },
            "expected at most 9 lights, which the tree can address",
        ),
    ] {
        assert_eq!(error.to_string(), says, "{error:?}");
        assert!(error.source().is_none(), "{error:?}");
    }
}

#[test]
fn a_reference_tree_counts_its_lights_and_nodes() {
    let lamps: Vec<_> = (0..9u8)
        .map(|i| lamp(Vec3::X * f32::from(i), f32::from(i % 3)))
        .collect();
    let tree = ReferenceLightBvh::build(&lamps).expect("lamps");
    let stats = tree.stats();
    // Three of them are off.
    assert_eq!((stats.lights, stats.nodes), (6, 11), "{stats:?}");
    let mean = stats.mean_depth;
    assert!(
        (2.0..=5.0).contains(&mean) && mean <= stats.max_depth as f32,
        "{stats:?}"
    );
}
