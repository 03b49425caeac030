use core::fmt;
use std::path::Path;

use clap::ValueEnum;
use light_scene::{Diagnostic, ImageFile, read_environment};
use lights::math::SphereMap;
use lights::sources::Image;

use super::failure::Failure;
use super::scene_input::report_warnings;

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
            None if width == height => SphereMap::EqualArea,
            None if width == height.saturating_mul(2) => SphereMap::LatLong,
            None => {
                return Err(refuse(format!(
                    "expected 2:1 (lat-long) or a square (equal-area), found {width} x {height}; \
                     say which map it is"
                )));
            }
        };
        let image = image
            .to_light()
            .map_err(|error| refuse(error.to_string()))?;
        Ok(Self { image, map })
    }
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
