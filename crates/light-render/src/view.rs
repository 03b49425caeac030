use core::error::Error;
use core::f32::consts::{PI, TAU};
use core::fmt;

use light_scene::{Camera, Crop, Projection};
use lights::glam::{Vec2, Vec3};
use lights::math::{equal_area, warp};

use crate::Ray;
use crate::raster::Raster;

/// A camera with a raster of square pixels: maps points of the picture to rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    camera: Camera,
    width: u32,
    height: u32,
    /// The pixels that are rendered.
    crop: Crop,
    raster: Raster,
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
    /// The window of the screen has no size, or the scale of an orthographic camera is not
    /// positive.
    Screen,
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
        if !(camera.fov > 0.0 && camera.fov < PI) {
            return Err(ViewError::FieldOfView);
        }
        let lens = camera.lens;
        if lens.is_some_and(|lens| !(lens.radius >= 0.0 && lens.focus_distance > 0.0)) {
            return Err(ViewError::Lens);
        }
        let raster = Raster::new(camera, [width, height]).ok_or(ViewError::Screen)?;
        Ok(Self {
            camera: *camera,
            width,
            height,
            crop: Crop {
                min: [0, 0],
                max: [width, height],
            },
            raster,
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

    /// The width of a pixel in the middle of the picture: at distance 0, and what each unit of
    /// distance adds.
    #[must_use]
    pub(crate) fn pixel_width(&self) -> [f32; 2] {
        let [width, height] = [self.width, self.height].map(|pixels| pixels as f32);
        match self.camera.projection {
            Projection::Perspective => [0.0, self.raster.pixel_width()],
            Projection::Orthographic { .. } => [self.raster.pixel_width(), 0.0],
            Projection::LatLong => [0.0, PI / height],
            Projection::EqualArea => [0.0, (4.0 * PI / (width * height)).sqrt()],
        }
    }

    /// The ray through the point `film` of the picture, in pixels from its top left corner, and
    /// through the point of the lens that `u_lens` in `[0, 1)^2` chooses.
    ///
    /// # Source
    /// `[PBRT4]`, sections 5.2 and 5.3.
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
        let offset = |at: Vec2| -> Vec3 { right * at.x + up * at.y };
        // `through` reaches one unit along the view.
        let (origin, through) = match self.camera.projection {
            Projection::Perspective => {
                let on_screen = offset(self.raster.centered(film)) / self.raster.distance();
                (position, forward + on_screen)
            }
            Projection::Orthographic { .. } => {
                let on_screen = offset(self.raster.centered(film)) / self.raster.distance();
                (position + on_screen, forward)
            }
            spherical => {
                let d = around(
                    spherical,
                    film / Vec2::new(self.width as f32, self.height as f32),
                );
                let direction = right * d.x + up * d.y + forward * d.z;
                return Ray {
                    origin: position,
                    direction: direction.normalize(),
                };
            }
        };
        let Some(lens) = self.camera.lens else {
            return Ray {
                origin,
                direction: through.normalize(),
            };
        };
        let on_lens = offset(warp::concentric_disk::sample(u_lens) * lens.radius);
        // All rays through a point of the picture meet at this place, seen from the camera.
        let in_focus = (origin - position) + through * lens.focus_distance;
        Ray {
            origin: position + on_lens,
            direction: (in_focus - on_lens).normalize(),
        }
    }
}

/// The direction of a point of a spherical camera's picture, given in parts of width and height:
/// along right, up and forward.
fn around(projection: Projection, at: Vec2) -> Vec3 {
    if projection == Projection::EqualArea {
        let d = equal_area::square_to_sphere(equal_area::wrap(at));
        return Vec3::new(d.x, d.z, d.y);
    }
    let ((sin_theta, cos_theta), (sin_phi, cos_phi)) =
        ((PI * at.y).sin_cos(), (TAU * at.x).sin_cos());
    Vec3::new(sin_theta * cos_phi, cos_theta, sin_theta * sin_phi)
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
            Self::Screen => "the camera's screen must have a finite size other than 0",
        })
    }
}

impl Error for ViewError {}

#[cfg(test)]
mod tests {
    use super::*;
    use core::f32::consts::FRAC_PI_2;
    use light_scene::{Lens, ScreenWindow};

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
    fn windows_of_the_screen_move_and_stretch_the_picture() {
        let window = |x, y| {
            View::new(
                &Camera {
                    screen: Some(ScreenWindow { x, y }),
                    ..camera()
                },
                200,
                100,
            )
        };
        // At 90 degrees the screen at distance 1 shows its own lengths.
        let view = window([-1.0, 3.0], [0.5, 1.0]).expect("a view");
        let corner = |x, y| {
            let d = view.ray(Vec2::new(x, y), Vec2::ZERO).direction;
            Vec2::new(d.x, d.y) / -d.z
        };
        for (x, y, expected) in [
            (0.0, 0.0, Vec2::new(-1.0, 1.0)),
            (200.0, 100.0, Vec2::new(3.0, 0.5)),
            (50.0, 50.0, Vec2::new(0.0, 0.75)),
        ] {
            let found = corner(x, y);
            assert!(found.distance(expected) < 1e-5, "{found}, not {expected}");
        }
        let middle = window([-2.0, 2.0], [-1.0, 1.0]).expect("a view");
        let plain = View::new(&camera(), 200, 100).expect("a view");
        for film in [Vec2::new(3.0, 4.0), Vec2::new(150.0, 80.0)] {
            let [a, b] = [&middle, &plain].map(|view| view.ray(film, Vec2::ZERO).direction);
            assert!(a.distance(b) < 1e-6, "the window that there is without one");
        }
        let error = window([1.0, 1.0], [0.0, 1.0]).err();
        assert_eq!(error, Some(ViewError::Screen), "no width");
    }

    #[test]
    fn orthographic_rays_are_parallel() {
        let camera = Camera {
            projection: Projection::Orthographic { scale: 3.0 },
            ..camera()
        };
        let view = View::new(&camera, 200, 100).expect("a view");
        let ray = view.ray(Vec2::new(200.0, 0.0), Vec2::ZERO);
        assert_eq!(ray.direction, Vec3::NEG_Z, "along the view");
        let expected = Vec3::new(6.0, 3.0, 0.0);
        assert!(
            ray.origin.distance(expected) < 1e-5,
            "from the screen: {}",
            ray.origin
        );
        let [fixed, grown] = view.pixel_width();
        assert!(
            (fixed - 0.06).abs() < 1e-6 && grown == 0.0,
            "the same at any distance"
        );
        let lens = Some(Lens {
            radius: 0.5,
            focus_distance: 2.0,
        });
        let blurred = View::new(&Camera { lens, ..camera }, 200, 100).expect("a view");
        let ray = blurred.ray(Vec2::new(200.0, 0.0), Vec2::new(0.3, 0.6));
        assert!(ray.origin.length() <= 0.5, "on the lens");
        let sharp = ray.at(-2.0 / ray.direction.z);
        assert!(
            sharp.distance(expected - Vec3::Z * 2.0) < 1e-5,
            "sharp: {sharp}"
        );
        let flat = Camera {
            projection: Projection::Orthographic { scale: 0.0 },
            ..camera
        };
        assert_eq!(View::new(&flat, 2, 2), Err(ViewError::Screen), "no size");
    }

    /// [`PBRT4`], `cameras.cpp`: the left edge of rows of latitude looks along x, a quarter further
    /// along z; the middle of a square of equal areas looks along its pole, here up.
    #[test]
    fn spherical_pictures_show_all_around() {
        let look = |projection, x, y| {
            let camera = Camera {
                projection,
                ..camera()
            };
            let view = View::new(&camera, 400, 200).expect("a view");
            view.ray(Vec2::new(x, y), Vec2::ZERO).direction
        };
        for (projection, x, y, expected) in [
            (Projection::LatLong, 0.0, 100.0, Vec3::X),
            (Projection::LatLong, 100.0, 100.0, Vec3::NEG_Z),
            (Projection::LatLong, 300.0, 100.0, Vec3::Z),
            (Projection::LatLong, 123.0, 0.0, Vec3::Y),
            (Projection::LatLong, 123.0, 200.0, Vec3::NEG_Y),
            (Projection::EqualArea, 200.0, 100.0, Vec3::Y),
            (Projection::EqualArea, 0.0, 0.0, Vec3::NEG_Y),
            (Projection::EqualArea, 400.0, 100.0, Vec3::X),
            (Projection::EqualArea, 200.0, 200.0, Vec3::NEG_Z),
        ] {
            let found = look(projection, x, y);
            assert!(
                found.distance(expected) < 1e-5,
                "{projection:?} {x} {y}: {found}"
            );
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
