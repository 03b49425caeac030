//! Lights of other types obey the laws of lights, and a set that holds them beside its own kinds
//! obeys the laws of samplers.

#![allow(
    clippy::cast_possible_truncation,
    reason = "doubles are rounded to what lights take"
)]

mod ball;
mod choices;
mod lantern;
mod laws;

use light_sources::SceneSphere;
use light_sources::glam::Vec3;

const SCENE_RADIUS: f32 = 10.0;

fn scene() -> SceneSphere {
    SceneSphere::new(Vec3::ZERO, SCENE_RADIUS).expect("a sphere")
}
