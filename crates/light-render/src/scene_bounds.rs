use light_scene::Scene;
use lights::glam::Vec3;
use lights::math::Aabb;
use lights::sources::SceneSphere;

use crate::SceneLightsError;

/// The sphere around `bounds`, the box of `scene`.
///
/// # Errors
/// When the box is too large or too small; the error names what reaches farthest.
pub(crate) fn scene_sphere(scene: &Scene, bounds: &Aabb) -> Result<SceneSphere, SceneLightsError> {
    let sphere = if bounds.is_empty() {
        SceneSphere::new(Vec3::ZERO, 1.0)
    } else {
        // A scene of a single point still has an outside.
        let (center, radius) = bounds.bounding_sphere();
        SceneSphere::new(center, radius.max(f32::MIN_POSITIVE))
    };
    sphere.map_err(|error| SceneLightsError::Bounds {
        name: scene.farthest_part().to_owned(),
        bounds: *bounds,
        error,
    })
}
