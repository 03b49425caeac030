use crate::Camera;
use crate::glam::Vec3;

/// From `eye` toward `target`, with `fov` degrees along the picture's height.
pub(super) fn camera(eye: Vec3, target: Vec3, fov: f32) -> Camera {
    let camera = Camera::look_at(eye, target, Vec3::Y, fov.to_radians());
    Camera {
        resolution: Some([960, 640]),
        ..camera.expect("two points and an upright vector")
    }
}
