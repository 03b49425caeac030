use core::fmt;

use lights::math::Aabb;

use crate::glam::Vec3;

/// A camera: where it is, and how it maps the picture to rays.
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
    /// How points of the image become rays.
    pub projection: Projection,
    /// Field of view along the shorter side of the image, in radians, in (0, pi); of a perspective
    /// camera alone.
    pub fov: f32,
    /// The part of the screen that the image shows; `None` for the middle, with square pixels. A
    /// spherical camera has none.
    pub screen: Option<ScreenWindow>,
    /// Thin lens for depth of field; `None` for a pinhole.
    pub lens: Option<Lens>,
    /// Width and height of the image that the file asks for, in pixels.
    pub resolution: Option<[u32; 2]>,
    /// The part of that image that the file asks for; absent: all of it.
    pub crop: Option<Crop>,
    /// Factor of radiance for display; `None` leaves it to the viewer.
    pub exposure: Option<f32>,
}

/// How points of the image become rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub enum Projection {
    /// All rays start at the camera, toward points of a plane screen.
    #[default]
    Perspective,
    /// All rays are parallel to the view direction.
    Orthographic {
        /// The length of 1 on the screen, in scene units, above 0: without a window of the screen
        /// the shorter side of the image shows twice as much.
        scale: f32,
    },
    /// All directions around the camera, in rows of latitude: row 0 looks along `up`, the left edge
    /// along `right`, and a quarter of the width further along `forward`.
    LatLong,
    /// All directions around the camera in a square, by the map of equal areas; its pole is `up`.
    EqualArea,
}

/// A part of the screen of a camera, where x runs to the right, y upward, and (0, 0) is ahead. The
/// shorter side of an image without a window shows -1 to 1.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ScreenWindow {
    /// The left and the right edge of the image; two different numbers.
    pub x: [f32; 2],
    /// The lower and the upper edge; two different numbers.
    pub y: [f32; 2],
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
    /// Eye and target are so close or so far apart that single precision has no square of their
    /// distance.
    Distance,
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
        let is_pair = eye.is_finite() && target.is_finite() && eye != target;
        let forward = (target - eye).try_normalize();
        let forward = forward.ok_or(if is_pair {
            CameraError::Distance
        } else {
            CameraError::Direction
        })?;
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
            projection: Projection::Perspective,
            fov,
            screen: None,
            lens: None,
            resolution: None,
            crop: None,
            exposure: None,
        })
    }

    /// A camera that looks along `forward` (not vertical) and sees the whole box under 40 degrees,
    /// in an image of any shape, as near as that allows.
    ///
    /// An empty box is seen as the unit box around the origin.
    #[must_use]
    pub(crate) fn framing(bounds: &Aabb, forward: Vec3) -> Self {
        let (center, radius) = bounds.bounding_sphere();
        let is_sized = radius > 0.0 && radius.is_finite() && center.is_finite();
        let (center, half) = if is_sized {
            (center, 0.5 * bounds.diagonal())
        } else {
            (Vec3::ZERO, Vec3::splat(0.5))
        };
        let fov = 40f32.to_radians();
        // Some room around what is seen.
        let slope = (0.5 * fov).tan() / 1.05;
        let look = |distance: f32| {
            let eye = center - forward.normalize_or(Vec3::NEG_Z) * distance;
            Self::look_at(eye, center, Vec3::Y, fov)
        };
        let axes = Self::look_at(-forward, Vec3::ZERO, Vec3::Y, fov);
        let Ok(axes) = axes else {
            let upright = Self::look_at(Vec3::Z, Vec3::ZERO, Vec3::Y, fov);
            return upright.expect("a camera along -z");
        };
        let corners = (0..8u8).map(|corner| {
            let sign = |bit: u8| if corner & bit == 0 { -1.0 } else { 1.0 };
            half * Vec3::new(sign(1), sign(2), sign(4))
        });
        // So far away is a camera that has a corner on the edge of its picture.
        let needed = corners.map(|corner| {
            let aside = corner.dot(axes.right).abs().max(corner.dot(axes.up).abs());
            aside / slope - corner.dot(axes.forward)
        });
        let distance = needed.fold(0.0, f32::max);
        look(distance).unwrap_or(axes)
    }
}

impl fmt::Display for CameraError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Direction => "the camera's eye and target must be two different finite points",
            Self::Distance => "the camera's eye and target must be 1e-19 to 1e19 apart",
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
        let distance = Err(CameraError::Distance);
        for far in [1e30, -3e38, 1e-30] {
            assert_eq!(
                look_at(Vec3::X * far, target, Vec3::Y, 1.0),
                distance,
                "{far}"
            );
        }
        for far in [1e-19, 1e19] {
            assert!(
                look_at(Vec3::X * far, target, Vec3::Y, 1.0).is_ok(),
                "{far}"
            );
        }
        let fov = Err(CameraError::Fov);
        for bad in [0.0, -1.0, 3.2, f32::NAN] {
            assert_eq!(look_at(eye, target, Vec3::Y, bad), fov, "fov {bad}");
        }
    }

    #[test]
    fn framing_sees_the_box() {
        let bounds = Aabb::new(Vec3::splat(-3.0), Vec3::new(1.0, 2.0, 9.0));
        let camera = Camera::framing(&bounds, Vec3::NEG_Z);
        let slope = (0.5 * camera.fov).tan();
        let mut largest = 0.0f32;
        for corner in (0..8u8).map(|k| {
            let pick = |bit: u8| k & bit != 0;
            Vec3::select(
                glam::BVec3::new(pick(1), pick(2), pick(4)),
                bounds.min,
                bounds.max,
            )
        }) {
            let to = corner - camera.position;
            let depth = to.dot(camera.forward);
            assert!(depth > 0.0, "{corner} in front");
            let across = to.dot(camera.right).abs().max(to.dot(camera.up).abs());
            largest = largest.max(across / depth / slope);
        }
        assert!(
            (0.9..1.0).contains(&largest),
            "fills the picture: {largest}"
        );
        let raised = Camera::framing(&bounds, Vec3::new(-0.6, -0.45, -1.0));
        assert!(raised.position.y > bounds.max.y, "from above");
        for nothing in [Aabb::EMPTY, Aabb::new(Vec3::NAN, Vec3::NAN)] {
            let camera = Camera::framing(&nothing, Vec3::NEG_Z);
            assert!(camera.position.is_finite(), "a camera for nothing");
        }
        let vertical = Camera::framing(&bounds, Vec3::NEG_Y);
        assert!(vertical.position.is_finite(), "any camera");
    }
}
