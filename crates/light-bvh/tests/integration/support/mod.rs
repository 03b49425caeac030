//! What tests of the default tree share.

#[cfg(feature = "std")]
pub(crate) mod double;
#[cfg(feature = "std")]
pub(crate) mod two_rooms;

use light_bvh::light_bounds::light_math::{Aabb, glam::Vec3};
use light_bvh::light_bounds::{LightBounds, LightExtent};

/// A small diffuse lamp that shines down.
pub(crate) fn lamp(at: Vec3, phi: f32) -> LightExtent {
    LightExtent::Bounded(LightBounds {
        bounds: Aabb::from_point(at),
        w: Vec3::NEG_Z,
        phi,
        cos_theta_o: 1.0,
        cos_theta_e: 0.0,
        two_sided: false,
    })
}
