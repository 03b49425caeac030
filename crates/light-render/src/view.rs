use core::error::Error;
use core::fmt;

use light_scene::{Camera, Crop};
use lights::glam::{Vec2, Vec3};
use lights::math::warp;

use crate::Ray;

/// A camera with a raster of square pixels: maps points of the picture to rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    camera: Camera,
    width: u32,
    height: u32,
    /// The pixels that are rendered.
    crop: Crop,
    /// The distance of the screen, in pixels.
    screen_distance: f32,
}

/// Why a camera and a size make no [`View`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ViewError {
    /// The picture has no pixels.
    EmptyPicture,
    /// The picture has more pixels than fit into 2^31.
    HugePicture,
    /// The camera's position or one of its axes is not finite.
    Axes,
    /// The angle of view is not above 0 and below 180 degrees.
    FieldOfView,
    /// The crop has no pixels, or some outside of the picture.
    Crop,
    /// The lens radius is negative, or the focus distance is not positive.
    Lens,
}

impl View {
    /// The view of `camera` in a picture of `width` by `height` pixels.
    ///
    /// # Errors
    /// One [`ViewError`] for each rule that the arguments break.
    pub fn new(camera: &Camera, width: u32, height: u32) -> Result<Self, ViewError> {
        if width == 0 || height == 0 {
            return Err(ViewError::EmptyPicture);
        }
        if u64::from(width) * u64::from(height) > 1 << 31 {
            return Err(ViewError::HugePicture);
        }
        let axes = [camera.position, camera.right, camera.up, camera.forward];
        if !axes.iter().all(|axis| axis.is_finite()) {
            return Err(ViewError::Axes);
        }
        if !(camera.fov > 0.0 && camera.fov < core::f32::consts::PI) {
            return Err(ViewError::FieldOfView);
        }
        let lens = camera.lens;
        if lens.is_some_and(|lens| !(lens.radius >= 0.0 && lens.focus_distance > 0.0)) {
            return Err(ViewError::Lens);
        }
        Ok(Self {
            camera: *camera,
            width,
            height,
            crop: Crop {
                min: [0, 0],
                max: [width, height],
            },
            screen_distance: 0.5 * width.min(height) as f32 / (0.5 * camera.fov).tan(),
        })
    }

    /// The same view, of which only some pixels are rendered: to the same values as in the whole
    /// picture.
    ///
    /// # Errors
    /// When `crop` has no pixels, or some that are outside of the picture.
    pub fn with_crop(self, crop: Crop) -> Result<Self, ViewError> {
        let Crop { min, max } = crop;
        let is_within = |axis: usize, end: u32| min[axis] < max[axis] && max[axis] <= end;
        if is_within(0, self.width) && is_within(1, self.height) {
            Ok(Self { crop, ..self })
        } else {
            Err(ViewError::Crop)
        }
    }

    /// The pixels that are rendered: all of them, unless [`with_crop`](Self::with_crop) chose some.
    #[must_use]
    pub(crate) const fn crop(&self) -> Crop {
        self.crop
    }

    /// Who looks.
    #[must_use]
    pub const fn camera(&self) -> &Camera {
        &self.camera
    }

    /// Width and height of the whole picture, in pixels.
    #[must_use]
    pub const fn resolution(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// The width of a pixel in the middle of the picture, at distance 1.
    #[must_use]
    pub(crate) const fn pixel_angle(&self) -> f32 {
        1.0 / self.screen_distance
    }

    /// The ray through the point `film` of the picture, in pixels from its top left corner, and
    /// through the point of the lens that `u_lens` in `[0, 1)^2` chooses.
    #[inline]
    #[must_use]
    pub fn ray(&self, film: Vec2, u_lens: Vec2) -> Ray {
        let Camera {
            position,
            right,
            up,
            forward,
            ..
        } = self.camera;
        let x = film.x - 0.5 * self.width as f32;
        let y = 0.5 * self.height as f32 - film.y;
        // Reaches one unit along the view.
        let through = forward + (right * x + up * y) / self.screen_distance;
        let Some(lens) = self.camera.lens else {
            return Ray {
                origin: position,
                direction: through.normalize(),
            };
        };
        let Vec2 { x, y } = warp::concentric_disk::sample(u_lens) * lens.radius;
        let offset: Vec3 = right * x + up * y;
        Ray {
            origin: position + offset,
            direction: (through * lens.focus_distance - offset).normalize(),
        }
    }
}

impl fmt::Display for ViewError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::EmptyPicture => "the picture must have at least one pixel a side",
            Self::HugePicture => "the picture must not have more than 2^31 pixels",
            Self::Axes => "the camera's position and axes must be finite",
            Self::FieldOfView => "the angle of view must lie between 0 and 180 degrees",
            Self::Crop => "the part of the picture must have pixels, none of them outside of it",
            Self::Lens => {
                "the lens radius must not be negative and its focus distance must be positive"
            }
        })
    }
}

impl Error for ViewError {}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f32::consts::FRAC_PI_2;
    use light_scene::Lens;

    fn camera() -> Camera {
        Camera::look_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, FRAC_PI_2).expect("a plain camera")
    }

    #[test]
    fn the_picture_is_upright_and_right_handed() {
        let view = View::new(&camera(), 200, 100).expect("a view");
        let at = |x, y| view.ray(Vec2::new(x, y), Vec2::ZERO).direction;
        assert!(at(100.0, 50.0).distance(Vec3::NEG_Z) < 1e-6, "the middle");
        let top = Vec3::new(0.0, 1.0, -1.0).normalize();
        assert!(
            at(100.0, 0.0).distance(top) < 1e-6,
            "the angle spans the shorter side"
        );
        let right = Vec3::new(2.0, 0.0, -1.0).normalize();
        assert!(
            at(200.0, 50.0).distance(right) < 1e-6,
            "+x is right when looking along -z"
        );
    }

    #[test]
    fn a_lens_keeps_the_focal_plane_sharp() {
        let lens = Some(Lens {
            radius: 0.1,
            focus_distance: 3.0,
        });
        let blurred = View::new(&Camera { lens, ..camera() }, 200, 100).expect("a view");
        let film = Vec2::new(60.0, 20.0);
        let pinhole = View::new(&camera(), 200, 100)
            .expect("a view")
            .ray(film, Vec2::ZERO);
        let sharp = pinhole.at(3.0 / -pinhole.direction.z);
        for u in [Vec2::new(0.1, 0.9), Vec2::new(0.7, 0.3)] {
            let ray = blurred.ray(film, u);
            assert!(ray.origin != Vec3::ZERO, "starts on the lens");
            let p = ray.at((-3.0 - ray.origin.z) / ray.direction.z);
            assert!(p.distance(sharp) < 1e-5, "all rays meet in the focal plane");
        }
    }

    #[test]
    fn bad_views_are_named() {
        let error = |camera: Camera, width| View::new(&camera, width, 1).err();
        let lens = |radius, focus_distance| {
            Some(Lens {
                radius,
                focus_distance,
            })
        };
        assert_eq!(
            error(camera(), 0),
            Some(ViewError::EmptyPicture),
            "no pixel"
        );
        assert_eq!(
            View::new(&camera(), u32::MAX, 2),
            Err(ViewError::HugePicture),
            "huge"
        );
        let position = Vec3::NAN;
        assert_eq!(
            error(
                Camera {
                    position,
                    ..camera()
                },
                1
            ),
            Some(ViewError::Axes),
            "NaN"
        );
        for fov in [0.0, 4.0, f32::NAN] {
            let bad = Camera { fov, ..camera() };
            assert_eq!(error(bad, 1), Some(ViewError::FieldOfView), "{fov}");
        }
        for lens in [lens(-1.0, 1.0), lens(1.0, 0.0), lens(f32::NAN, 1.0)] {
            let bad = Camera { lens, ..camera() };
            assert_eq!(error(bad, 1), Some(ViewError::Lens), "{lens:?}");
        }
    }
}
