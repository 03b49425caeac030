//! Vectors of doubles, as plain arrays.

use light_math::glam::Vec3;

pub(crate) type Real3 = [f64; 3];

pub(crate) fn real3(v: Vec3) -> Real3 {
    v.to_array().map(f64::from)
}

pub(crate) fn vec3(v: Real3) -> Vec3 {
    Vec3::from_array(v.map(|c| c as f32))
}

pub(crate) fn sub(a: Real3, b: Real3) -> Real3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(crate) fn dot(a: Real3, b: Real3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Real3, b: Real3) -> Real3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(crate) fn length(v: Real3) -> f64 {
    dot(v, v).sqrt()
}

/// The unit vector along `v`; zero for the zero vector.
pub(crate) fn normalize(v: Real3) -> Real3 {
    let length = length(v);
    if length > 0.0 {
        v.map(|c| c / length)
    } else {
        v
    }
}
