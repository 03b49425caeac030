use core::fmt;

use lights::math::Aabb;

use crate::glam::Vec3;

/// A perspective camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Its position.
    pub position: Vec3,
    /// Unit vector to the right of the image.
    pub right: Vec3,
    /// Unit vector to the top of the image.
    pub up: Vec3,
    /// Unit vector into the scene, through the middle of the image.
    pub forward: Vec3,
    /// Field of view along the shorter side of the image, in radians, in (0, pi).
    pub fov: f32,
    /// Thin lens for depth of field; `None` for a pinhole.
    pub lens: Option<Lens>,
    /// Width and height of the image that the file asks for, in pixels.
    pub resolution: Option<[u32; 2]>,
    /// The part of that image that the file asks for; absent: all of it.
    pub crop: Option<Crop>,
    /// Factor of radiance for display; `None` leaves it to the viewer.
    pub exposure: Option<f32>,
}

/// A thin lens.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Lens {
    /// Radius of the aperture, in scene units.
    pub radius: f32,
    /// Distance along the view direction at which points are sharp, in scene units.
    pub focus_distance: f32,
}

/// Some pixels of an image: from column and row `min` on, up to those of `max`, which are not part
/// of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crop {
    /// First column and row.
    pub min: [u32; 2],
    /// First column and row beyond, each above that of `min`.
    pub max: [u32; 2],
}

impl Crop {
    /// Width and height in pixels; 0 where the ends are in the wrong order.
    #[must_use]
    pub const fn size(&self) -> (u32, u32) {
        let Self { min, max } = self;
        (max[0].saturating_sub(min[0]), max[1].saturating_sub(min[1]))
    }
}

/// Why a camera is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CameraError {
    /// Eye and target are the same point, or not finite.
    Direction,
    /// The up vector is zero, not finite, or along the view direction.
    Up,
    /// The field of view is not between 0 and pi.
    Fov,
}

impl Camera {
    /// A pinhole at `eye` that looks at `target`, right-handed: right = cross(forward, up).
    ///
    /// `fov` is the field of view along the shorter side of the image, in radians.
    ///
    /// # Errors
    /// When the view direction or the up vector is degenerate, or `fov` is not in (0, pi).
    pub fn look_at(eye: Vec3, target: Vec3, up: Vec3, fov: f32) -> Result<Self, CameraError> {
        let forward = (target - eye).try_normalize();
        let forward = forward.ok_or(CameraError::Direction)?;
        let up = up.try_normalize().ok_or(CameraError::Up)?;
        let right = forward.cross(up);
        // Below this the rounding of the inputs decides where "right" is.
        if !(right.length() > 1e-6) {
            return Err(CameraError::Up);
        }
        if !(fov > 0.0 && fov < core::f32::consts::PI) {
            return Err(CameraError::Fov);
        }
        let right = right.normalize();
        Ok(Self {
            position: eye,
            right,
            up: right.cross(forward),
            forward,
            fov,
            lens: None,
            resolution: None,
            crop: None,
            exposure: None,
        })
    }

    /// A camera that looks along `forward` (not vertical) and sees the whole box under 40 degrees.
    ///
    /// An empty box is seen as the unit box around the origin.
    #[must_use]
    pub(crate) fn framing(bounds: &Aabb, forward: Vec3) -> Self {
        let (center, radius) = bounds.bounding_sphere();
        let radius = if radius > 0.0 && radius.is_finite() {
            radius
        } else {
            1.0
        };
        let fov = 40f32.to_radians();
        let distance = radius / (0.5 * fov).sin();
        let eye = center - forward.normalize_or(Vec3::NEG_Z) * distance;
        let camera = Self::look_at(eye, center, Vec3::Y, fov);
        camera.unwrap_or(Self {
            position: Vec3::Z * distance,
            right: Vec3::X,
            up: Vec3::Y,
            forward: Vec3::NEG_Z,
            fov,
            lens: None,
            resolution: None,
            crop: None,
            exposure: None,
        })
    }
}

impl fmt::Display for CameraError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Direction => "the camera's eye and target must be two finite points",
            Self::Up => "the camera's up vector must be finite and not along the view direction",
            Self::Fov => "the camera's field of view must lie between 0 and 180 degrees",
        })
    }
}

impl core::error::Error for CameraError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn looks_right_handed() {
        let camera = Camera::look_at(Vec3::Z * 5.0, Vec3::ZERO, Vec3::Y, 1.0).expect("a camera");
        assert_eq!(camera.right, Vec3::X, "x to the right");
        assert_eq!(camera.up, Vec3::Y, "y up");
        assert_eq!(camera.forward, Vec3::NEG_Z, "into the scene");
    }

    #[test]
    fn refuses_what_is_no_camera() {
        let look_at = Camera::look_at;
        let (eye, target) = (Vec3::Z, Vec3::ZERO);
        let up = Err(CameraError::Up);
        assert_eq!(look_at(eye, target, Vec3::Z, 1.0), up, "up along the view");
        assert_eq!(look_at(eye, target, Vec3::ZERO, 1.0), up, "no up");
        assert_eq!(look_at(eye, target, Vec3::NAN, 1.0), up, "NaN up");
        let direction = Err(CameraError::Direction);
        assert_eq!(look_at(eye, eye, Vec3::Y, 1.0), direction, "no direction");
        assert_eq!(look_at(eye, Vec3::NAN, Vec3::Y, 1.0), direction, "NaN");
        let fov = Err(CameraError::Fov);
        for bad in [0.0, -1.0, 3.2, f32::NAN] {
            assert_eq!(look_at(eye, target, Vec3::Y, bad), fov, "fov {bad}");
        }
    }

    #[test]
    fn framing_sees_the_box() {
        let bounds = Aabb::new(Vec3::splat(-3.0), Vec3::new(1.0, 2.0, 9.0));
        let camera = Camera::framing(&bounds, Vec3::NEG_Z);
        for corner in [bounds.min, bounds.max] {
            let to_corner = (corner - camera.position).normalize();
            let angle = to_corner.dot(camera.forward).acos();
            assert!(angle < 0.5 * camera.fov, "{corner} in view");
        }
        let empty = Camera::framing(&Aabb::EMPTY, Vec3::Y);
        assert!(empty.position.is_finite(), "a camera for nothing");
    }
}
