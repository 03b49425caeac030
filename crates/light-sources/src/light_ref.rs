use crate::area::DiffuseAreaLight;
use crate::color::{ColorModel, Radiance};
use crate::distant::DistantLight;
use crate::forward_light::forward_light;
use crate::glam::{Vec2, Vec3};
use crate::goniometric::GoniometricLight;
use crate::image_infinite::ImageInfiniteLight;
use crate::light::{AreaLight, InfiniteLight, Light};
use crate::light_kinds::light_kinds;
use crate::light_sample::{EmittedRay, LePdf, LightLeSample, LightLiSample};
use crate::light_type::LightType;
use crate::medium_interface::MediumInterface;
use crate::own_light::OwnLight;
use crate::pdf_coverage::PdfCoverage;
use crate::point::PointLight;
use crate::portal_infinite::PortalInfiniteLight;
use crate::projection::ProjectionLight;
use crate::shape::{AnyShape, Triangle};
use crate::spot::SpotLight;
use crate::sun::SunLight;
use crate::surface_point::SurfacePoint;
use crate::uniform_infinite::UniformInfiniteLight;
use light_bounds::{LightExtent, LightSampleContext};

/// One light of a set, of any kind: a closed enum next to the trait, and a variant for lights of
/// your own types.
#[derive(Debug)]
#[non_exhaustive]
pub enum LightRef<'a, C: ColorModel> {
    /// A point light.
    Point(&'a PointLight<C>),
    /// A spot light.
    Spot(&'a SpotLight<C>),
    /// A projector.
    Projection(&'a ProjectionLight<C>),
    /// A goniometric light.
    Goniometric(&'a GoniometricLight<C>),
    /// An area light.
    Area(DiffuseAreaLight<'a, C, &'a AnyShape>),
    /// A triangle of an emissive mesh.
    Triangle(DiffuseAreaLight<'a, C, Triangle>),
    /// A light of a type of your own, which may be at infinity.
    Own(&'a OwnLight<C>),
    /// A distant light.
    Distant(&'a DistantLight<C>),
    /// A sun.
    Sun(&'a SunLight<C>),
    /// A uniform infinite light.
    UniformInfinite(&'a UniformInfiniteLight<C>),
    /// An environment map.
    ImageInfinite(&'a ImageInfiniteLight<C>),
    /// An environment map behind a portal.
    PortalInfinite(&'a PortalInfiniteLight<C>),
}

macro_rules! match_kinds {
    (($light:expr, $it:ident => $answer:expr) $($kind:ident, $list:ident: $stored:ty;)*) => {
        match $light {
            $(LightRef::$kind($it) => $answer,)*
        }
    };
}

/// The same expression for whichever light it is.
macro_rules! for_each_kind {
    ($light:expr, $it:ident => $answer:expr) => {
        light_kinds!(match_kinds! ($light, $it => $answer))
    };
}

impl<C: ColorModel> LightRef<'_, C> {
    /// Radiance that leaves the surface at `at` in direction `w`; black unless this is an area
    /// light.
    #[inline]
    #[must_use]
    pub fn l(&self, at: &SurfacePoint, w: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        match self {
            Self::Area(light) => light.l(at, w, wavelengths),
            Self::Triangle(light) => light.l(at, w, wavelengths),
            Self::Own(light) => light.l(at, w, wavelengths),
            Self::Point(_)
            | Self::Spot(_)
            | Self::Projection(_)
            | Self::Goniometric(_)
            | Self::Distant(_)
            | Self::Sun(_)
            | Self::UniformInfinite(_)
            | Self::ImageInfinite(_)
            | Self::PortalInfinite(_) => C::Radiance::BLACK,
        }
    }

    /// The first point of the light's surface on the ray from `origin` in the unit direction
    /// `direction`, from either side; `None` unless this is an area light that the ray hits.
    #[must_use]
    pub fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        match self {
            Self::Area(light) => light.hit(origin, direction),
            Self::Triangle(light) => light.hit(origin, direction),
            Self::Own(light) => light.hit(origin, direction),
            Self::Point(_)
            | Self::Spot(_)
            | Self::Projection(_)
            | Self::Goniometric(_)
            | Self::Distant(_)
            | Self::Sun(_)
            | Self::UniformInfinite(_)
            | Self::ImageInfinite(_)
            | Self::PortalInfinite(_) => None,
        }
    }

    /// Radiance that arrives along a ray that leaves the scene; black unless this is an infinite
    /// light.
    #[inline]
    #[must_use]
    pub fn le(&self, origin: Vec3, direction: Vec3, wavelengths: &C::Wavelengths) -> C::Radiance {
        match self {
            Self::Own(light) => light.le(origin, direction, wavelengths),
            Self::Sun(light) => light.le(origin, direction, wavelengths),
            Self::UniformInfinite(light) => light.le(origin, direction, wavelengths),
            Self::ImageInfinite(light) => light.le(origin, direction, wavelengths),
            Self::PortalInfinite(light) => light.le(origin, direction, wavelengths),
            Self::Point(_)
            | Self::Spot(_)
            | Self::Projection(_)
            | Self::Goniometric(_)
            | Self::Area(_)
            | Self::Triangle(_)
            | Self::Distant(_) => C::Radiance::BLACK,
        }
    }
}

impl<C: ColorModel> Light<C> for LightRef<'_, C> {
    forward_light!(for_each_kind, #[inline]);
}
