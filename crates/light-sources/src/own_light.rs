use alloc::sync::Arc;
use core::error::Error;
use core::fmt;

use crate::color::{ColorModel, Radiance};
use crate::forward_light::forward_light;
use crate::glam::{Vec2, Vec3};
use crate::light::{AreaLight, InfiniteLight, Light};
use crate::light_sample::{EmittedRay, LePdf, LightLeSample, LightLiSample};
use crate::light_type::LightType;
use crate::medium_interface::MediumInterface;
use crate::pdf_coverage::PdfCoverage;
use crate::surface_point::SurfacePoint;
use light_bounds::{LightExtent, LightSampleContext};

/// A light of a type of your own, by how rays find it. A [`LightSet`](crate::LightSet) takes it as
/// any other: `builder.add(OwnLight::Delta(Arc::new(light)))`.
///
/// Light samplers use only its [`extent`](Light::extent): too small a box or cone loses light. A
/// light at infinity of which `phi` or `sample_le` need the sphere of the scene gets it when it is
/// made. Each query costs a virtual call; other lights of the set cost what they did.
///
/// A clone shares the light. With the feature `serde`, an own light is refused by the serializer
/// with an error: nothing says what it consists of.
///
/// The example [`own_light`][1] is a lantern among lamps.
///
/// [1]: https://github.com/lights-rs/lights/blob/main/crates/lights/examples/own_light.rs
#[derive(Clone)]
pub enum OwnLight<C: ColorModel> {
    /// No ray finds it: the light comes from one point or one direction, or from a surface that is
    /// invisible. Its type is a [`Dirac`](LightType::is_delta).
    Delta(Arc<dyn Light<C> + Send + Sync>),
    /// Rays hit it. Its type is [`LightType::Area`].
    Area(Arc<dyn AreaLight<C> + Send + Sync>),
    /// Rays find it by leaving the scene. Its type is [`LightType::Infinite`].
    Infinite(Arc<dyn InfiniteLight<C> + Send + Sync>),
}

/// Why a set does not take an [`OwnLight`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OwnLightError {
    /// `light_type` is none that the variant of [`OwnLight`] holds.
    Type,
    /// `extent` is that of a light at infinity for a light with a position, or the reverse.
    Extent,
}

/// The same expression for whichever trait it is.
macro_rules! for_each_trait {
    ($own:expr, $light:ident => $answer:expr) => {
        match $own {
            OwnLight::Delta($light) => $answer,
            OwnLight::Area($light) => $answer,
            OwnLight::Infinite($light) => $answer,
        }
    };
}

impl<C: ColorModel> OwnLight<C> {
    /// The same light, if what it says of itself fits together.
    pub(crate) fn checked(self) -> Result<Self, OwnLightError> {
        let light_type = self.light_type();
        let is_held = match &self {
            Self::Delta(_) => light_type.is_delta(),
            Self::Area(_) => light_type == LightType::Area,
            Self::Infinite(_) => light_type == LightType::Infinite,
        };
        if !is_held {
            return Err(OwnLightError::Type);
        }
        if self.extent().infinite().is_some() != self.is_infinite() {
            return Err(OwnLightError::Extent);
        }
        Ok(self)
    }

    pub(crate) fn is_infinite(&self) -> bool {
        self.light_type().is_infinite()
    }

    pub(crate) fn l(
        &self,
        at: &SurfacePoint,
        w: Vec3,
        wavelengths: &C::Wavelengths,
    ) -> C::Radiance {
        match self {
            Self::Area(light) => light.l(at, w, wavelengths),
            Self::Delta(_) | Self::Infinite(_) => C::Radiance::BLACK,
        }
    }

    pub(crate) fn hit(&self, origin: Vec3, direction: Vec3) -> Option<SurfacePoint> {
        match self {
            Self::Area(light) => light.hit(origin, direction),
            Self::Delta(_) | Self::Infinite(_) => None,
        }
    }

    pub(crate) fn le(
        &self,
        origin: Vec3,
        direction: Vec3,
        wavelengths: &C::Wavelengths,
    ) -> C::Radiance {
        match self {
            Self::Infinite(light) => light.le(origin, direction, wavelengths),
            Self::Delta(_) | Self::Area(_) => C::Radiance::BLACK,
        }
    }

    /// The address of the light, by which shared ones are known, and its own bytes, without what it
    /// points to.
    pub(crate) fn memory(&self) -> (usize, usize) {
        for_each_trait!(self, light => (Arc::as_ptr(light).addr(), size_of_val(&**light)))
    }
}

impl<C: ColorModel> Light<C> for OwnLight<C> {
    forward_light!(for_each_trait);
}

impl<C: ColorModel> fmt::Debug for OwnLight<C> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (light_type, extent) = (self.light_type(), self.extent());
        let mut own = f.debug_struct("OwnLight");
        own.field("light_type", &light_type)
            .field("extent", &extent);
        own.finish_non_exhaustive()
    }
}

impl fmt::Display for OwnLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Type => "light_type is not one that rays find as the variant says",
            Self::Extent => "extent and light_type disagree on whether it is at infinity",
        })
    }
}

impl Error for OwnLightError {}
