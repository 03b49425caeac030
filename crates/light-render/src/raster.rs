use light_scene::{Camera, Projection, ScreenWindow};
use lights::glam::Vec2;

/// From points of a picture to points of a camera's screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Raster {
    /// The point of the picture, in pixels, that is the middle of the screen.
    center: Vec2,
    /// How many pixels of a row show one unit at distance 1; of an orthographic camera at any.
    distance: f32,
    /// The width of a pixel over its height.
    aspect: f32,
}

impl Raster {
    /// The raster of `size` pixels on the screen of `camera`; `None` if the screen has no finite
    /// size.
    pub(crate) fn new(camera: &Camera, size: [u32; 2]) -> Option<Self> {
        // The length of 1 on the screen.
        let unit = match camera.projection {
            Projection::Perspective => (0.5 * camera.fov).tan(),
            Projection::Orthographic { scale } => scale,
            Projection::LatLong | Projection::EqualArea => 1.0,
        };
        let [width, height] = size.map(|pixels| pixels as f32);
        let raster = match camera.screen {
            None => Self {
                center: 0.5 * Vec2::new(width, height),
                distance: 0.5 * size[0].min(size[1]) as f32 / unit,
                aspect: 1.0,
            },
            Some(ScreenWindow {
                x: [left, right],
                y: [low, high],
            }) => {
                // In pixels for each unit of the screen.
                let across = width / (right - left);
                let up = height / (high - low);
                Self {
                    center: Vec2::new(-left * across, high * up),
                    distance: across / unit,
                    aspect: across / up,
                }
            }
        };
        let Self {
            center,
            distance,
            aspect,
        } = raster;
        let is_size = |x: f32| x.is_finite() && x != 0.0;
        (unit > 0.0 && center.is_finite() && is_size(distance) && is_size(aspect)).then_some(raster)
    }

    /// How far a point of the picture is from the middle of the screen, to the right and upward, in
    /// widths of pixels.
    #[inline]
    pub(crate) fn centered(&self, film: Vec2) -> Vec2 {
        Vec2::new(
            film.x - self.center.x,
            (self.center.y - film.y) * self.aspect,
        )
    }

    /// How many pixels of a row show one unit of length at distance 1, or of an orthographic camera
    /// at any; negative for a picture that is mirrored.
    #[inline]
    pub(crate) const fn distance(&self) -> f32 {
        self.distance
    }

    /// The width of a pixel at distance 1, or of an orthographic camera at any.
    pub(crate) const fn pixel_width(&self) -> f32 {
        1.0 / self.distance.abs()
    }
}
