//! Lengths and directions of normals that are as long as an area.

use crate::glam::Vec3;
use light_math::float::sqrt;

/// The length of a normal, as an area; also where that is so small that its square loses digits, or
/// so large that it overflows.
#[inline]
pub(super) fn normal_length(normal: Vec3) -> f32 {
    let length_sq = normal.length_squared();
    if has_digits(length_sq) {
        sqrt(length_sq)
    } else {
        extreme_length(normal)
    }
}

/// Whether a squared length is neither so small that it loses digits, nor infinite.
#[inline]
pub(super) fn has_digits(length_sq: f32) -> bool {
    (f32::MIN_POSITIVE..=f32::MAX).contains(&length_sq)
}

/// Divided by the largest component first, so that no square vanishes or overflows.
#[cold]
fn extreme_length(v: Vec3) -> f32 {
    let largest = v.abs().max_element();
    if largest > 0.0 {
        largest * (v / largest).length()
    } else {
        0.0
    }
}

/// The unit vector along a normal; also where that is so short, as of a tiny surface, that its
/// square loses digits, or so long that it overflows.
#[inline]
pub(super) fn unit_normal(normal: Vec3) -> Option<Vec3> {
    let length_sq = normal.length_squared();
    if has_digits(length_sq) {
        normal.try_normalize()
    } else {
        light_math::direction(normal)
    }
}
