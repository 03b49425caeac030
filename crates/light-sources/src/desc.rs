use core::error::Error;
use core::fmt;

use crate::area_desc::{AreaLightDesc, AreaLightError};
use crate::color::ColorModel;
use crate::distant::{DistantLightDesc, DistantLightError};
use crate::goniometric::{GoniometricLightDesc, GoniometricLightError};
use crate::image_infinite::{ImageInfiniteLightDesc, ImageInfiniteLightError};
use crate::mesh::{MeshLightDesc, MeshLightError};
use crate::point::{PointLightDesc, PointLightError};
use crate::portal_infinite::{PortalInfiniteLightDesc, PortalInfiniteLightError};
use crate::projection::{ProjectionLightDesc, ProjectionLightError};
use crate::scaled_emission::EmissionError;
use crate::spot_desc::{SpotLightDesc, SpotLightError};
use crate::sun::SunLightError;
use crate::sun_desc::SunLightDesc;
use crate::uniform_infinite::UniformInfiniteLightDesc;

/// A light as a user describes it, in the user's units; it may hold nonsense, which the built light
/// cannot.
#[derive(Clone, Debug)]
#[non_exhaustive]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub enum LightDesc<C: ColorModel> {
    /// A point light.
    Point(PointLightDesc<C>),
    /// A spot light.
    Spot(SpotLightDesc<C>),
    /// A light that throws a picture.
    Projection(ProjectionLightDesc),
    /// A light with a measured distribution.
    Goniometric(GoniometricLightDesc<C>),
    /// A shape that shines.
    Area(AreaLightDesc<C>),
    /// An emissive mesh.
    Mesh(MeshLightDesc<C>),
    /// A light from one direction.
    Distant(DistantLightDesc<C>),
    /// A disk in the sky.
    Sun(SunLightDesc<C>),
    /// A uniform sky.
    UniformInfinite(UniformInfiniteLightDesc<C>),
    /// An environment map.
    ImageInfinite(ImageInfiniteLightDesc),
    /// An environment map behind a window.
    PortalInfinite(PortalInfiniteLightDesc),
}

/// Why a description is no light: the kind of light, then the field and its rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightDescError {
    /// Of a point light.
    Point(PointLightError),
    /// Of a spot light.
    Spot(SpotLightError),
    /// Of a light that throws a picture.
    Projection(ProjectionLightError),
    /// Of a light with a measured distribution.
    Goniometric(GoniometricLightError),
    /// Of a shape that shines.
    Area(AreaLightError),
    /// Of an emissive mesh.
    Mesh(MeshLightError),
    /// Of a light from one direction.
    Distant(DistantLightError),
    /// Of a disk in the sky.
    Sun(SunLightError),
    /// Of a uniform sky.
    UniformInfinite(EmissionError),
    /// Of an environment map.
    ImageInfinite(ImageInfiniteLightError),
    /// Of an environment map behind a window.
    PortalInfinite(PortalInfiniteLightError),
    /// With this light the set would hold more lights than 32 bits can count.
    TooMany,
}

impl fmt::Display for LightDescError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point(error) => write!(f, "point light, {error}"),
            Self::Spot(error) => write!(f, "spot light, {error}"),
            Self::Projection(error) => write!(f, "projection light, {error}"),
            Self::Goniometric(error) => write!(f, "goniometric light, {error}"),
            Self::Area(error) => write!(f, "area light, {error}"),
            Self::Mesh(error) => write!(f, "mesh light, {error}"),
            Self::Distant(error) => write!(f, "distant light, {error}"),
            Self::Sun(error) => write!(f, "sun light, {error}"),
            Self::UniformInfinite(error) => write!(f, "uniform infinite light, {error}"),
            Self::ImageInfinite(error) => write!(f, "image infinite light, {error}"),
            Self::PortalInfinite(error) => write!(f, "portal infinite light, {error}"),
            Self::TooMany => f.write_str("too many lights: ids have 32 bits"),
        }
    }
}

impl Error for LightDescError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        Some(match self {
            Self::Point(error) => error,
            Self::Spot(error) => error,
            Self::Projection(error) => error,
            Self::Goniometric(error) => error,
            Self::Area(error) => error,
            Self::Mesh(error) => error,
            Self::Distant(error) => error,
            Self::Sun(error) => error,
            Self::UniformInfinite(error) => error,
            Self::ImageInfinite(error) => error,
            Self::PortalInfinite(error) => error,
            Self::TooMany => return None,
        })
    }
}
