//! Vectors in double precision.

use light_math::glam::Vec3;

pub(crate) type Real3 = [f64; 3];

pub(crate) fn minus(a: Vec3, b: Vec3) -> Real3 {
    core::array::from_fn(|i| f64::from(a[i]) - f64::from(b[i]))
}

pub(crate) fn dot(a: Real3, b: Real3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Real3, b: Real3) -> Real3 {
    core::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        a[j] * b[k] - a[k] * b[j]
    })
}

pub(crate) fn length(a: Real3) -> f64 {
    dot(a, a).sqrt()
}
