//! Where shapes of the tests are, where rays meet them, and what is around them.

use light_sources::glam::{Affine3A, Quat, Vec3};
use light_testkit::{Cap, naive};

const POSITION: Vec3 = Vec3::new(1.0, 2.0, -1.0);

/// A translation and a rotation without special values.
pub(super) fn tilted() -> Affine3A {
    let rotation = Quat::from_rotation_x(0.7) * Quat::from_rotation_y(-1.9);
    Affine3A::from_rotation_translation(rotation, POSITION)
}

/// A ray of the scene in the shape's own space.
pub(super) fn local(p: Vec3, wi: Vec3) -> ([f64; 3], [f64; 3]) {
    let inverse = tilted().inverse();
    let doubles = |v: Vec3| v.to_array().map(f64::from);
    (
        doubles(inverse.transform_point3(p)),
        doubles(inverse.transform_vector3(wi)),
    )
}

/// The azimuth of a point as a fraction of a turn.
pub(super) fn turn(x: f64, y: f64) -> f64 {
    (y.atan2(x) / core::f64::consts::TAU).rem_euclid(1.0)
}

/// The barycentric coordinates of a point of a triangle.
pub(super) fn barycentric(p: Vec3, [a, b, c]: [Vec3; 3]) -> Vec3 {
    let normal = (b - a).cross(c - a);
    let part = |v: Vec3, w: Vec3| (v - p).cross(w - p).dot(normal) / normal.length_squared();
    Vec3::new(part(b, c), part(c, a), part(a, b))
}

/// The corners of a box of these half sizes across and along the axis z of the shape's own space.
pub(super) fn box_around(across: f32, along: f32) -> Vec<Vec3> {
    let corner = |i: u8| {
        let sign = |bit: u8| if i & bit == 0 { -1.0 } else { 1.0 };
        tilted().transform_point3(Vec3::new(
            across * sign(1),
            across * sign(2),
            along * sign(4),
        ))
    };
    (0..8).map(corner).collect()
}

/// A planar quadrilateral whose corners run counter-clockwise.
pub(super) fn hit_quad(p: Vec3, wi: Vec3, [a, b, c, d]: [Vec3; 4]) -> Option<f64> {
    naive::hit_triangle(p, wi, [a, b, c]).or_else(|| naive::hit_triangle(p, wi, [a, c, d]))
}

/// A cap around all directions from `p` to a convex shape with these corners.
pub(super) fn cap_around(p: Vec3, corners: &[Vec3]) -> Cap {
    let to = |corner: &Vec3| (*corner - p).normalize();
    let axis: Vec3 = corners.iter().map(to).sum();
    let angles = corners.iter().map(|c| f64::from(to(c).angle_between(axis)));
    let angle = angles.fold(1e-3, f64::max);
    // Beyond a hemisphere the sides of the shape bulge out of the cap through its corners.
    if angle < 1.5 {
        Cap::new(axis, angle + 1e-3)
    } else {
        Cap::sphere()
    }
}
