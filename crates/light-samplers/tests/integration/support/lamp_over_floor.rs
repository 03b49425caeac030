//! Lamps 2 above a point of the floor that face it, and that point.

use light_samplers::light_bounds::glam::Vec3;
use light_samplers::light_bounds::light_math::Aabb;
use light_samplers::light_bounds::{LightBounds, LightExtent, LightSampleContext};

/// A lamp of this power in W.
pub(crate) fn lamp(phi: f32) -> LightExtent {
    LightExtent::Bounded(LightBounds {
        bounds: Aabb::from_point(Vec3::Z * 2.0),
        w: Vec3::NEG_Z,
        phi,
        cos_theta_o: 1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    })
}

/// The point of the floor.
pub(crate) fn floor() -> LightSampleContext {
    LightSampleContext::surface(Vec3::ZERO, Vec3::Z, Vec3::Z)
}
