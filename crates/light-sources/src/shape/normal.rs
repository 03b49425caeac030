//! Lengths and directions of normals that are as long as an area.

use crate::glam::Vec3;
use light_math::float::sqrt;

/// The length of a normal, as an area; also where that is so small that its square loses digits.
#[inline]
pub(super) fn normal_length(normal: Vec3) -> f32 {
    let length_sq = normal.length_squared();
    if length_sq >= f32::MIN_POSITIVE {
        sqrt(length_sq)
    } else {
        tiny_length(normal)
    }
}

/// Divided by the largest component first, so that no square vanishes.
#[cold]
pub(super) fn tiny_length(v: Vec3) -> f32 {
    let largest = v.abs().max_element();
    if largest > 0.0 {
        largest * (v / largest).length()
    } else {
        0.0
    }
}

/// The unit vector along a normal; also where that is so short, as of a tiny surface, that its
/// square loses digits.
#[inline]
pub(super) fn unit_normal(normal: Vec3) -> Option<Vec3> {
    if normal.length_squared() >= f32::MIN_POSITIVE {
        normal.try_normalize()
    } else {
        light_math::direction(normal)
    }
}
