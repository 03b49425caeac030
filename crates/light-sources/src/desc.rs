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

impl LightDescError {
    /// The kind of light in words, and what is wrong with its description; none of one light alone.
    fn kind_and_rule(&self) -> Option<(&'static str, &(dyn Error + 'static))> {
        Some(match self {
            Self::Point(rule) => ("point", rule),
            Self::Spot(rule) => ("spot", rule),
            Self::Projection(rule) => ("projection", rule),
            Self::Goniometric(rule) => ("goniometric", rule),
            Self::Area(rule) => ("area", rule),
            Self::Mesh(rule) => ("mesh", rule),
            Self::Distant(rule) => ("distant", rule),
            Self::Sun(rule) => ("sun", rule),
            Self::UniformInfinite(rule) => ("uniform infinite", rule),
            Self::ImageInfinite(rule) => ("image infinite", rule),
            Self::PortalInfinite(rule) => ("portal infinite", rule),
            Self::TooMany => return None,
        })
    }
}

impl fmt::Display for LightDescError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.kind_and_rule() {
            Some((kind, rule)) => write!(f, "{kind} light, {rule}"),
            None => f.write_str("too many lights: ids have 32 bits"),
        }
    }
}

impl Error for LightDescError {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.kind_and_rule().map(|(_, rule)| rule)
    }
}
