use lights::math::Aabb;
use lights::sources::SceneSphere;

/// Why no scene can hold what is in this box: it is so large that the area of a sphere around it
/// overflows.
pub(crate) fn extent_fault(bounds: &Aabb) -> Option<String> {
    let (center, radius) = bounds.bounding_sphere();
    // What is small may be part of a larger scene.
    if bounds.is_empty() || SceneSphere::new(center, radius.max(1.0)).is_ok() {
        return None;
    }
    let size = bounds.diagonal();
    let axis = size.max_position();
    let name = ["x", "y", "z"][axis];
    let (min, max) = (bounds.min[axis], bounds.max[axis]);
    Some(format!(
        "expected a size of at most about 1e19, found {name} from {min:?} to {max:?}"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::glam::Vec3;

    #[test]
    fn what_is_too_large_for_a_scene_has_a_fault() {
        let of = |min: Vec3, max: Vec3| extent_fault(&Aabb::new(min, max));
        assert_eq!(of(Vec3::ZERO, Vec3::splat(1e18)), None, "large");
        assert_eq!(of(Vec3::ONE, Vec3::ONE), None, "a point");
        assert_eq!(extent_fault(&Aabb::EMPTY), None, "nothing");
        let fault = of(Vec3::NEG_Y, Vec3::new(1.0, 1e30, 2.0)).expect("too large");
        assert!(fault.ends_with("found y from -1.0 to 1e30"), "{fault}");
        let far = of(Vec3::splat(2e38), Vec3::splat(3e38));
        assert!(far.is_some(), "too far from the origin");
    }
}
