use crate::{View, ViewError};
use clap::Args;
use light_scene::{Camera, Crop, Projection, Scene};

use super::arguments::{LookAt, angle_of_view};
use super::failure::Failure;
use super::whole::whole;
use super::window::Window;

/// The camera, and the size of the picture.
#[derive(Args, Clone, Debug, Default)]
pub(crate) struct ViewArgs {
    /// Width of the image in pixels.
    #[arg(long, value_parser = whole(1..=u32::MAX))]
    width: Option<u32>,
    /// Height of the image in pixels.
    #[arg(long, value_parser = whole(1..=u32::MAX))]
    height: Option<u32>,
    /// Render this part alone, as shares of width and height from the top left corner; the image is
    /// that part.
    #[arg(long, value_name = "x0,x1,y0,y1")]
    crop: Option<Window>,
    /// Where the camera stands, what it looks at, what is up.
    #[arg(
        long,
        value_name = "ex,ey,ez,tx,ty,tz,ux,uy,uz",
        allow_hyphen_values = true
    )]
    look_at: Option<LookAt>,
    /// Angle of view across the shorter side.
    #[arg(long, value_name = "DEGREES", value_parser = angle_of_view)]
    fov: Option<f32>,
}

impl ViewArgs {
    /// The same, with the picture of the scene's own size scaled down so that its longer side has
    /// at most `side` pixels. A size that was asked for stays.
    pub(crate) fn at_most(&self, scene: &Scene, side: u32) -> Self {
        let camera = scene.camera_or_default();
        let [w, h] = camera.resolution.unwrap_or([512, 512]);
        let is_asked_for = self.width.is_some() || self.height.is_some();
        if is_asked_for || w.max(h) <= side {
            self.clone()
        } else if w >= h {
            Self {
                width: Some(side),
                ..self.clone()
            }
        } else {
            Self {
                height: Some(side),
                ..self.clone()
            }
        }
    }

    /// The scene's camera, with what the arguments change, in the picture's size.
    ///
    /// # Errors
    /// When the camera or the part of the picture is invalid.
    pub(crate) fn view(&self, scene: &Scene) -> Result<View, Failure> {
        let mut camera = scene.camera_or_default();
        if self.fov.is_some() && camera.projection != Projection::Perspective {
            let message = "--fov: expected a scene whose camera is perspective";
            return Err(Failure::Input(message.into()));
        }
        let fov = self.fov.map_or(camera.fov, f32::to_radians);
        if let Some(LookAt { eye, target, up }) = self.look_at {
            let moved = Camera::look_at(eye, target, up, fov)
                .map_err(|error| Failure::Input(format!("--look-at: {error}")))?;
            // The rest of the camera stays.
            camera = Camera {
                position: moved.position,
                right: moved.right,
                up: moved.up,
                forward: moved.forward,
                lens: None,
                exposure: None,
                ..camera
            };
        }
        camera.fov = fov;
        let [w, h] = camera.resolution.unwrap_or([512, 512]);
        let scaled = |n: u32, of: u32, to: u32| {
            u32::try_from(u64::from(n) * u64::from(to) / u64::from(of.max(1)))
                .map_or(1, |n| n.max(1))
        };
        let (width, height) = match (self.width, self.height) {
            (Some(width), Some(height)) => (width, height),
            (Some(width), None) => (width, scaled(h, w, width)),
            (None, Some(height)) => (scaled(w, h, height), height),
            (None, None) => (w, h),
        };
        let view = View::new(&camera, width, height).map_err(|error| self.refuse(error))?;
        // The crop of a file is in pixels of its own size.
        let of_file = camera.crop.map(|Crop { min, max }| Window {
            x: [min[0], max[0]].map(|x| f64::from(x) / f64::from(w)),
            y: [min[1], max[1]].map(|y| f64::from(y) / f64::from(h)),
        });
        match self.crop.or(of_file) {
            Some(window) => {
                let crop = view.with_crop(window.pixels(width, height));
                crop.map_err(|error| Failure::Input(format!("crop: {error}")))
            }
            None => Ok(view),
        }
    }

    /// What is said of a camera, with the flags that made it so.
    fn refuse(&self, error: ViewError) -> Failure {
        let has_size = self.width.is_some() || self.height.is_some();
        Failure::Input(match error {
            ViewError::FieldOfView if self.fov.is_some() => format!("--fov: {error}"),
            ViewError::HugePicture if has_size => format!("--width, --height: {error}"),
            _ => error.to_string(),
        })
    }
}
