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

    /// The whole picture of the same camera with at most so many pixels: if it has more, a number of
    /// times smaller in both directions.
    #[must_use]
    pub(crate) fn of_at_most(&self, pixels: usize) -> Self {
        let smaller = |scale| {
            let (width, height) = (self.width.div_ceil(scale), self.height.div_ceil(scale));
            Self::new(&self.camera, width, height).ok()
        };
        let mut all = (1..=self.width.max(self.height)).filter_map(smaller);
        all.find(|view| view.pixels() <= pixels).unwrap_or(*self)
    }

    /// How many pixels the whole picture has.
    #[must_use]
    pub(crate) const fn pixels(&self) -> usize {
        self.width as usize * self.height as usize
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
mod tests;
