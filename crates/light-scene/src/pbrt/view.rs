//! The camera and the film.

use super::file_loc::Typed;
use super::lights::fov;
use super::parameter::ParameterType;
use super::state::Reader;
use crate::glam::Vec3;
use crate::text::shown;
use crate::{Camera, Crop, Diagnostic, Lens, Projection, ScreenWindow};

/// A path scatters no more often than this.
const MOST_SCATTERING: u32 = (1 << 31) - 1;

/// A pixel has no more samples than this.
const MOST_SAMPLES: u32 = (1 << 31) - 1;

/// The strata of a pixel in x and in y, at most and by default.
const MOST_STRATA: u32 = 1 << 15;
const STRATA: u32 = 4;

/// An image has no more pixels a side than this.
const LONGEST: u32 = 65536;

impl Reader {
    pub(super) fn set_camera(&mut self, typed: &Typed<'_>) -> Result<(), Diagnostic> {
        let Typed {
            at,
            kind,
            parameters,
        } = typed;
        if self.state.is_singular() {
            return Err(at.diagnostic("expected a transform that can be inverted for the camera"));
        }
        let to_world = self.state.transform.inverse();
        let scale = |v: Vec3| to_world.transform_vector3(v).length();
        let projection = match kind.as_str() {
            "perspective" => Projection::Perspective,
            "orthographic" => Projection::Orthographic {
                scale: scale(Vec3::X),
            },
            "spherical" => self.sphere_map(typed),
            _ => {
                let what = format!("Camera \"{kind}\"");
                self.warn(*at, &what, "was taken as perspective");
                Projection::Perspective
            }
        };
        self.coordinates.insert("camera".to_owned(), to_world);
        self.scene.camera_medium = self.state.media.outside;
        let is_spherical = matches!(projection, Projection::LatLong | Projection::EqualArea);
        let fov = match projection {
            Projection::Perspective => fov(typed),
            _ => 90.0,
        };
        let screen = screen_window(typed).filter(|_| !is_spherical);
        let radius = parameters.amount_or("lensradius", 0.0);
        let focus_distance = parameters.positive_or("focaldistance", 1e6);
        // The picture is that of the moment at which the shutter opens.
        for name in ["shutteropen", "shutterclose"] {
            parameters.accept(name);
        }
        let axis = |v: Vec3| to_world.transform_vector3(v).normalize_or(v);
        self.camera = Some(Camera {
            position: to_world.transform_point3(Vec3::ZERO),
            right: axis(Vec3::X),
            up: axis(Vec3::Y),
            forward: axis(Vec3::Z),
            projection,
            fov: fov.to_radians(),
            screen,
            lens: (radius > 0.0 && !is_spherical).then_some(Lens {
                radius,
                focus_distance,
            }),
            resolution: None,
            crop: None,
            exposure: None,
        });
        Ok(())
    }

    /// Which map the picture of a spherical camera is.
    fn sphere_map(&mut self, typed: &Typed<'_>) -> Projection {
        match typed.parameters.string("mapping").unwrap_or("equalarea") {
            "equalarea" => Projection::EqualArea,
            "equirectangular" => Projection::LatLong,
            other => {
                let message = format!(
                    "expected `mapping` to be \"equalarea\" or \"equirectangular\", found \"{}\"",
                    shown(other)
                );
                typed.parameters.refuse("mapping", message);
                Projection::EqualArea
            }
        }
    }

    pub(super) fn film(&mut self, typed: &Typed<'_>) -> Result<(), Diagnostic> {
        let Typed { at, parameters, .. } = typed;
        // The command line gives the output file; the others say how other films store, or are of
        // cameras that are not read.
        for name in [
            "filename",
            "savefp16",
            "diagonal",
            "maxcomponentvalue",
            "coordinatesystem",
            "nbuckets",
            "lambdamin",
            "lambdamax",
        ] {
            parameters.accept(name);
        }
        let size = |name, default| parameters.count(name, LONGEST).unwrap_or(default);
        let resolution = [size("xresolution", 1280), size("yresolution", 720)];
        let [width, height] = resolution.map(|pixels| pixels as f32);
        // Both list the two ends in x, then the two ends in y.
        let bounds = match (
            parameters.numbers("pixelbounds", ParameterType::Integer),
            parameters.numbers("cropwindow", ParameterType::Float),
        ) {
            (None, None) => None,
            (Some(pixels), _) => Some(pixels),
            (None, Some([x0, x1, y0, y1])) => {
                Some([x0 * width, x1 * width, y0 * height, y1 * height].map(f32::ceil))
            }
        };
        parameters.check()?;
        self.crop = None;
        if let Some([x0, x1, y0, y1]) = bounds {
            if x0 < 0.0 || y0 < 0.0 || x1 > width || y1 > height {
                self.warn(*at, "what Film crops to", "ends at the edges of the image");
            }
            let min = [whole(x0), whole(y0)];
            let max = [whole(x1.min(width)), whole(y1.min(height))];
            if !(min[0] < max[0] && min[1] < max[1]) {
                return Err(at.diagnostic("expected a crop with at least one pixel of the image"));
            }
            self.crop = Some(Crop { min, max });
        }
        self.resolution = Some(resolution);
        Ok(())
    }

    /// Of an integrator the longest path counts: pbrt counts what is between the ends of a path.
    pub(super) fn integrator(&mut self, typed: &Typed<'_>) {
        let parameters = &typed.parameters;
        let depth = parameters.whole("maxdepth", MOST_SCATTERING);
        self.scene.max_depth = depth.map(|depth| depth + 1);
        // The command line says how lights are chosen.
        parameters.accept("lightsampler");
        if !matches!(
            typed.kind.as_str(),
            "path" | "volpath" | "simplepath" | "simplevolpath"
        ) {
            let what = format!("Integrator \"{}\"", typed.kind);
            self.warn(
                typed.at,
                &what,
                "was taken as the program's own path tracer",
            );
        }
    }

    /// Of a sampler the number of samples counts: the program has its own points.
    pub(super) fn sampler(&mut self, typed: &Typed<'_>) {
        let parameters = &typed.parameters;
        let samples = if typed.kind == "stratified" {
            let side = |name| parameters.count(name, MOST_STRATA);
            let sides = (side("xsamples"), side("ysamples"));
            match sides {
                (None, None) => None,
                (x, y) => Some(x.unwrap_or(STRATA) * y.unwrap_or(STRATA)),
            }
        } else {
            parameters.count("pixelsamples", MOST_SAMPLES)
        };
        self.scene.samples_per_pixel = samples;
        parameters.accept_all();
    }
}

/// The window of the screen that a camera names, or that its `frameaspectratio` makes.
fn screen_window(typed: &Typed<'_>) -> Option<ScreenWindow> {
    let parameters = &typed.parameters;
    let aspect = parameters.positive("frameaspectratio");
    let window = parameters.numbers("screenwindow", ParameterType::Float);
    if let Some([x0, x1, y0, y1]) = window {
        if x0 == x1 || y0 == y1 {
            let message = "expected two different numbers each in x and y of `screenwindow`";
            parameters.refuse("screenwindow", message.to_owned());
        }
        return Some(ScreenWindow {
            x: [x0, x1],
            y: [y0, y1],
        });
    }
    let aspect = aspect?;
    let (x, y) = (aspect.max(1.0), aspect.recip().max(1.0));
    Some(ScreenWindow {
        x: [-x, x],
        y: [-y, y],
    })
}

/// A number of pixels.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to what an image may have"
)]
const fn whole(pixels: f32) -> u32 {
    pixels.clamp(0.0, LONGEST as f32) as u32
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::super::parse_pbrt;
    use crate::{Crop, Files};

    fn crop(film: &str) -> Result<Option<Crop>, String> {
        let size = "\"integer xresolution\" 100 \"integer yresolution\" 50";
        let text = format!("Camera \"perspective\" Film \"rgb\" {size} {film} WorldBegin");
        let scene =
            parse_pbrt(Path::new("a"), &text, Files::NONE).map_err(|error| error.to_string())?;
        assert_eq!(scene.warnings, [], "all understood");
        Ok(scene.camera.expect("a camera").crop)
    }

    #[test]
    fn crops_count_pixels() {
        assert_eq!(crop(""), Ok(None), "all of it");
        let expected = Crop {
            min: [25, 10],
            max: [51, 50],
        };
        let window = "\"float cropwindow\" [.25 .505 .2 1]";
        assert_eq!(crop(window), Ok(Some(expected)), "in parts, rounded up");
        let bounds = "\"integer pixelbounds\" [25 51 10 50]";
        assert_eq!(crop(bounds), Ok(Some(expected)), "in pixels");
        let error = "a:1: expected a crop with at least one pixel of the image";
        for empty in ["[.5 .5 0 1]", "[.6 .5 0 1]", "[2 3 0 1]"] {
            let film = format!("\"float cropwindow\" {empty}");
            assert_eq!(crop(&film), Err(error.to_owned()), "{empty}");
        }
        let error = Err("a:1: expected 4 numbers for `cropwindow`, found 2".to_owned());
        assert_eq!(crop("\"float cropwindow\" [0 1]"), error, "two are missing");
    }

    #[test]
    fn crops_end_with_the_image_and_say_so() {
        let film = "Film \"rgb\" \"integer yresolution\" 50 \"integer pixelbounds\" [25 51 -3 60]";
        let text = format!("Camera \"perspective\" {film} WorldBegin");
        let scene = parse_pbrt(Path::new("a"), &text, Files::NONE).expect("a scene");
        let rows = scene.camera.and_then(|camera| camera.crop).expect("a crop");
        assert_eq!((rows.min[1], rows.max[1]), (0, 50), "rows of the image");
        let expected = "a:1: what Film crops to ends at the edges of the image";
        let warnings: Vec<_> = scene.warnings.iter().map(ToString::to_string).collect();
        assert_eq!(warnings, [expected], "named");
    }
}
