//! The laws that every light obeys: densities against samples, estimates against integrals, power,
//! bounds.

#![expect(
    clippy::cast_possible_truncation,
    reason = "doubles are rounded to what lights take"
)]

mod at_infinity;
mod at_points;
mod edges;
mod extremes;
mod lat_long;
mod portals;
mod powers;
mod shape_geometry;
mod shapes;
mod spectral;

use light_sources::SceneSphere;
use light_sources::glam::Vec3;

const SCENE_RADIUS: f32 = 5.0;

fn scene() -> SceneSphere {
    SceneSphere::new(Vec3::ZERO, SCENE_RADIUS).expect("a sphere")
}
