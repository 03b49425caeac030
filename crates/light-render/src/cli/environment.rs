use core::fmt;
use std::path::Path;

use clap::ValueEnum;
use light_scene::{Diagnostic, Image as Picture, ImageFile, read_environment};
use lights::math::SphereMap;
use lights::sources::{EnvironmentMap, Image};

use super::failure::Failure;
use super::stdout::report_warnings;

/// How an image lies around the sphere, on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MapName {
    /// Rows of latitude.
    LatLong,
    /// Equal areas, a square.
    EqualArea,
}

/// An image with its place around the sphere.
#[derive(Debug)]
pub(super) struct Environment {
    pub(super) image: Image,
    pub(super) map: SphereMap,
}

impl Environment {
    /// Reads an image; by its shape it is lat-long (2:1) or equal-area (square), unless `map` says
    /// what it is.
    ///
    /// # Errors
    /// When the file cannot be read, or its shape and `map` do not go together.
    pub(super) fn read(path: &Path, map: Option<MapName>) -> Result<Self, Failure> {
        let refuse = |message: String| Failure::input(Diagnostic::file(path, message));
        let ImageFile { image, warning } = read_environment(path).map_err(Failure::input)?;
        report_warnings(warning.as_slice());
        let (width, height) = (image.width(), image.height());
        let map = match map {
            Some(MapName::EqualArea) if width != height => {
                return Err(refuse(format!(
                    "expected a square equal-area map, found {width} x {height}"
                )));
            }
            Some(map) => map.into(),
            None => map_of_shape(&image)
                .ok_or_else(|| refuse(format!("{}; say which map it is", unclear_shape(&image))))?,
        };
        let image = image
            .to_light()
            .map_err(|error| refuse(error.to_string()))?;
        Ok(Self { image, map })
    }
}

/// Reads the environment of a scene, with what is strange about it: of another shape than 2:1 or a
/// square it is lat-long.
///
/// # Errors
/// When the file cannot be read, or holds what is no light.
pub(super) fn read_sky(path: &Path) -> Result<(EnvironmentMap, Vec<Diagnostic>), Failure> {
    let ImageFile { image, warning } = read_environment(path).map_err(Failure::input)?;
    let mut warnings: Vec<Diagnostic> = warning.into_iter().collect();
    let map = map_of_shape(&image);
    if map.is_none() {
        let message = format!("{}; it is taken as lat-long", unclear_shape(&image));
        warnings.push(Diagnostic::file(path, message));
    }
    let light = image
        .to_light()
        .map_err(|error| Failure::input(Diagnostic::file(path, error.to_string())))?;
    let map = match map {
        Some(SphereMap::EqualArea) => EnvironmentMap::EqualArea(light),
        Some(SphereMap::LatLong) | None => EnvironmentMap::LatLong(light),
    };
    Ok((map, warnings))
}

/// How an image of this shape lies around the sphere; `None` where that is unclear.
fn map_of_shape(image: &Picture) -> Option<SphereMap> {
    let (width, height) = (image.width(), image.height());
    if width == height {
        Some(SphereMap::EqualArea)
    } else if width == height.saturating_mul(2) {
        Some(SphereMap::LatLong)
    } else {
        None
    }
}

/// What is said of an image where the shape does not say what it is.
fn unclear_shape(image: &Picture) -> String {
    let (width, height) = (image.width(), image.height());
    format!("expected 2:1 (lat-long) or a square (equal-area), found {width} x {height}")
}

impl From<MapName> for SphereMap {
    fn from(name: MapName) -> Self {
        match name {
            MapName::LatLong => Self::LatLong,
            MapName::EqualArea => Self::EqualArea,
        }
    }
}

impl From<SphereMap> for MapName {
    fn from(map: SphereMap) -> Self {
        match map {
            SphereMap::LatLong => Self::LatLong,
            SphereMap::EqualArea => Self::EqualArea,
        }
    }
}

impl fmt::Display for MapName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::LatLong => "lat-long",
            Self::EqualArea => "equal-area",
        })
    }
}
