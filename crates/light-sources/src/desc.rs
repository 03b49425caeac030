use core::error::Error;
use core::fmt;

use crate::color::ColorModel;
use crate::distant::{DistantLightDesc, DistantLightError};
use crate::image_infinite::{ImageInfiniteLightDesc, ImageInfiniteLightError};
use crate::mesh::{MeshLightDesc, MeshLightError};
use crate::point::{PointLightDesc, PointLightError};
use crate::scaled_emission::EmissionError;
use crate::uniform_infinite::UniformInfiniteLightDesc;

/// A light as a user describes it, in the user's units; it may hold nonsense, which the built light cannot.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum LightDesc<C: ColorModel> {
    /// A point light.
    Point(PointLightDesc<C>),
    /// An emissive mesh.
    Mesh(MeshLightDesc<C>),
    /// A light from one direction.
    Distant(DistantLightDesc<C>),
    /// A uniform sky.
    UniformInfinite(UniformInfiniteLightDesc<C>),
    /// An environment map.
    ImageInfinite(ImageInfiniteLightDesc),
}

/// Why a description is no light: the kind of light, then the field and its rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightDescError {
    /// Of a point light.
    Point(PointLightError),
    /// Of an emissive mesh.
    Mesh(MeshLightError),
    /// Of a light from one direction.
    Distant(DistantLightError),
    /// Of a uniform sky.
    UniformInfinite(EmissionError),
    /// Of an environment map.
    ImageInfinite(ImageInfiniteLightError),
    /// With this light the set would hold more lights than 32 bits can count.
    TooMany,
}

impl fmt::Display for LightDescError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point(error) => write!(f, "point light, {error}"),
            Self::Mesh(error) => write!(f, "mesh light, {error}"),
            Self::Distant(error) => write!(f, "distant light, {error}"),
            Self::UniformInfinite(error) => write!(f, "uniform infinite light, {error}"),
            Self::ImageInfinite(error) => write!(f, "image infinite light, {error}"),
            Self::TooMany => f.write_str("too many lights: ids have 32 bits"),
        }
    }
}

impl Error for LightDescError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        Some(match self {
            Self::Point(error) => error,
            Self::Mesh(error) => error,
            Self::Distant(error) => error,
            Self::UniformInfinite(error) => error,
            Self::ImageInfinite(error) => error,
            Self::TooMany => return None,
        })
    }
}
