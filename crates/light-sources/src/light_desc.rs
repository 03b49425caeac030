use core::error::Error;
use core::fmt;

use crate::area_desc::{AreaLightDesc, AreaLightError};
use crate::color::ColorModel;
use crate::distant::{DistantLightDesc, DistantLightError};
use crate::goniometric::{GoniometricLightDesc, GoniometricLightError};
use crate::image_infinite_desc::{ImageInfiniteLightDesc, ImageInfiniteLightError};
use crate::mesh::{MeshLightDesc, MeshLightError};
use crate::own_light::{OwnLight, OwnLightError};
use crate::point::{PointLightDesc, PointLightError};
use crate::portal_infinite_desc::{PortalInfiniteLightDesc, PortalInfiniteLightError};
use crate::projection::{ProjectionLightDesc, ProjectionLightError};
use crate::scaled_emission::EmissionError;
use crate::spot_desc::{SpotLightDesc, SpotLightError};
use crate::sun::SunLightError;
use crate::sun_desc::SunLightDesc;
use crate::uniform_infinite::UniformInfiniteLightDesc;

/// The description of a light, in the user's units. It is not validated; a built light is.
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
    /// A projector.
    Projection(ProjectionLightDesc),
    /// A goniometric light.
    Goniometric(GoniometricLightDesc<C>),
    /// An area light.
    Area(AreaLightDesc<C>),
    /// An emissive mesh.
    Mesh(MeshLightDesc<C>),
    /// A light of a type of your own, which says itself what it is. It cannot be serialized.
    #[cfg_attr(feature = "serde", serde(skip_serializing))]
    Own(OwnLight<C>),
    /// A distant light.
    Distant(DistantLightDesc<C>),
    /// A sun.
    Sun(SunLightDesc<C>),
    /// A uniform infinite light.
    UniformInfinite(UniformInfiniteLightDesc<C>),
    /// An environment map.
    ImageInfinite(ImageInfiniteLightDesc),
    /// An environment map behind a portal.
    PortalInfinite(PortalInfiniteLightDesc),
}

/// Why a description is invalid: the kind of light, then the field and its rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightDescError {
    /// Of a point light.
    Point(PointLightError),
    /// Of a spot light.
    Spot(SpotLightError),
    /// Of a projector.
    Projection(ProjectionLightError),
    /// Of a goniometric light.
    Goniometric(GoniometricLightError),
    /// Of an area light.
    Area(AreaLightError),
    /// Of an emissive mesh.
    Mesh(MeshLightError),
    /// Of a light of a type of your own.
    Own(OwnLightError),
    /// Of a distant light.
    Distant(DistantLightError),
    /// Of a sun.
    Sun(SunLightError),
    /// Of a uniform infinite light.
    UniformInfinite(EmissionError),
    /// Of an environment map.
    ImageInfinite(ImageInfiniteLightError),
    /// Of an environment map behind a portal.
    PortalInfinite(PortalInfiniteLightError),
    /// With this light the set would have more lights than 32 bits can count.
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
            Self::Own(rule) => ("own", rule),
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
