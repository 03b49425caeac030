//! Directions and angles in double precision: the truth that tests hold the tree to.

use light_bvh::light_bounds::light_math::glam::Vec3;

pub(crate) fn double(v: Vec3) -> [f64; 3] {
    v.to_array().map(f64::from)
}

fn length(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The angle between two vectors of any length.
pub(crate) fn angle(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (la, lb) = (length(a), length(b));
    let chord = core::array::from_fn(|i| a[i] / la - b[i] / lb);
    2.0 * (0.5 * length(chord)).min(1.0).asin()
}

/// The vector from one point to another.
pub(crate) fn between(from: Vec3, to: Vec3) -> [f64; 3] {
    let (from, to) = (double(from), double(to));
    core::array::from_fn(|i| to[i] - from[i])
}

/// The unit vector at the angle `theta` from the unit vector `axis`, turned about it by `turn`.
pub(crate) fn tilted(axis: Vec3, theta: f64, turn: f64) -> Vec3 {
    let (x, y) = axis.any_orthonormal_pair();
    let (sin, cos) = theta.sin_cos();
    let parts = [turn.cos() * sin, turn.sin() * sin, cos];
    let [x, y, axis] = [x, y, axis].map(double);
    let along = |i: usize| x[i] * parts[0] + y[i] * parts[1] + axis[i] * parts[2];
    #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
    Vec3::from_array([0, 1, 2].map(|i| along(i) as f32))
}
