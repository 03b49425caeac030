use light_math::OctahedralVector;
use light_math::glam::Vec3;

use super::input::Input;
use crate::real3::{cross, dot, length, real3};

/// Codes decode to unit vectors, and directions come back within the stated angle.
pub(super) fn octahedral(data: &[u8]) {
    let mut input = Input::new(data);
    let bits = input.u32();
    let decoded = OctahedralVector::from_bits(bits).decode();
    assert!(
        (decoded.length() - 1.0).abs() < 1e-6,
        "{bits:#x} became {decoded}"
    );
    assert!(
        angle(OctahedralVector::encode(decoded).decode(), decoded) <= 1e-6,
        "{bits:#x} does not come back"
    );

    let w = input.direction();
    let error = angle(OctahedralVector::encode(w).decode(), w);
    let bound = f64::from(OctahedralVector::MAX_ANGULAR_ERROR);
    assert!(error <= bound, "{w} comes back {error} away");

    let anything = Vec3::new(input.f32(), input.f32(), input.f32());
    let decoded = OctahedralVector::encode(anything).decode();
    assert!(
        (decoded.length() - 1.0).abs() < 1e-6,
        "{anything} became {decoded}"
    );
}

/// The angle between two vectors, in radians.
fn angle(a: Vec3, b: Vec3) -> f64 {
    let (a, b) = (real3(a), real3(b));
    length(cross(a, b)).atan2(dot(a, b))
}
