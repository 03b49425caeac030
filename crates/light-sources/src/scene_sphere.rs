use core::error::Error;
use core::fmt;

use crate::glam::Vec3;
use light_math::Aabb;

/// The bounding sphere of the scene, through which lights at infinity send their rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SceneSphere {
    center: Vec3,
    radius: f32,
}

/// Why a bounding sphere is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SceneSphereError {
    /// The centre has a component that is not a finite number.
    Center,
    /// The radius is not a finite number above 0, or so large or small that single precision has no
    /// number for the area of its disk or for one over it: the scene is empty, a single point, or
    /// unbounded.
    Radius,
}

impl SceneSphere {
    /// The sphere with the given centre and radius, in scene units.
    ///
    /// # Errors
    /// When the centre is not finite, or the radius not finite and positive, of about 1e-19 to 1e19.
    pub fn new(center: Vec3, radius: f32) -> Result<Self, SceneSphereError> {
        if !center.is_finite() {
            return Err(SceneSphereError::Center);
        }
        let sphere = Self { center, radius };
        let area = sphere.disk_area();
        if !(radius > 0.0 && area.is_finite() && (1.0 / area).is_finite()) {
            return Err(SceneSphereError::Radius);
        }
        Ok(sphere)
    }

    /// The sphere through the corners of the scene's box.
    ///
    /// # Errors
    /// When the box is empty, a single point, or not finite.
    pub fn around(bounds: &Aabb) -> Result<Self, SceneSphereError> {
        let (center, radius) = bounds.bounding_sphere();
        Self::new(center, radius)
    }

    /// The centre.
    #[must_use]
    pub const fn center(&self) -> Vec3 {
        self.center
    }

    /// The radius, finite and positive.
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// Area of the disk of the sphere's radius, in length^2.
    #[must_use]
    pub(crate) fn disk_area(&self) -> f32 {
        core::f32::consts::PI * self.radius * self.radius
    }

    /// A point outside of the scene, seen from `p` in direction `w`.
    #[must_use]
    pub fn beyond(&self, p: Vec3, w: Vec3) -> Vec3 {
        p + w * (2.0 * self.radius)
    }
}

impl fmt::Display for SceneSphereError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Center => "scene bounds: the centre must be finite",
            Self::Radius => {
                "scene bounds: the radius must be positive, \
                 and its square a number of single precision"
            }
        })
    }
}

impl Error for SceneSphereError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_has_no_extent() {
        assert_eq!(
            SceneSphere::around(&Aabb::EMPTY),
            Err(SceneSphereError::Radius),
            "empty"
        );
        let point = Aabb::from_point(Vec3::ONE);
        assert_eq!(
            SceneSphere::around(&point),
            Err(SceneSphereError::Radius),
            "point"
        );
        assert_eq!(
            SceneSphere::new(Vec3::NAN, 1.0),
            Err(SceneSphereError::Center),
            "NaN"
        );
        for radius in [f32::NAN, -1.0, 2e19, 1e-20, f32::MAX] {
            let sphere = SceneSphere::new(Vec3::ZERO, radius);
            assert_eq!(sphere, Err(SceneSphereError::Radius), "{radius}");
        }
    }

    #[test]
    fn goes_through_the_corners() {
        let s = SceneSphere::around(&Aabb::new(Vec3::ZERO, Vec3::new(1.0, 2.0, 2.0)));
        assert_eq!(
            s,
            SceneSphere::new(Vec3::new(0.5, 1.0, 1.0), 1.5),
            "half of the diagonal 3"
        );
    }
}
