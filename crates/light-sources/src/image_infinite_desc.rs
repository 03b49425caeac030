use core::error::Error;
use core::fmt;

use crate::amount::RadianceAmount;
use crate::glam::{Affine3A, Vec3};
use crate::image::Image;
use crate::resample::equal_area_size;
use crate::rigid_transform::RigidTransformError;
use light_math::SphereMap;

/// An [`ImageInfiniteLight`](crate::ImageInfiniteLight) as a user describes it.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ImageInfiniteLightDesc {
    /// From light space to the scene; only its rotation counts.
    pub transform: Affine3A,
    /// The picture of the sky.
    pub map: EnvironmentMap,
    /// Amount of light, as a factor of the picture.
    pub amount: RadianceAmount,
}

impl ImageInfiniteLightDesc {
    /// The sky of `map` in light space, its texels in W m^-2 sr^-1: white of 1 has 683 nit in
    /// [`Rgb`](crate::Rgb). In [`Spectral`](crate::Spectral) texels are per nanometre, and white has
    /// 72,982 nit: the amount `Luminance(Nit(683.0))` makes the same sky in both.
    #[must_use]
    pub fn new(map: EnvironmentMap) -> Self {
        Self {
            transform: Affine3A::IDENTITY,
            map,
            amount: RadianceAmount::default(),
        }
    }
}

/// An image of all directions, with its map.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum EnvironmentMap {
    /// A square, by [`equal_area`](light_math::equal_area).
    EqualArea(Image),
    /// A rectangle of any shape, by [`lat_long`](light_math::lat_long); its texels are sampled and
    /// looked up as they are.
    LatLong(Image),
}

impl EnvironmentMap {
    /// This map as an equal-area one, resampled if it is another: the form of pbrt's files, and the
    /// one that a [`PortalInfiniteLight`](crate::PortalInfiniteLight) reads.
    ///
    /// # Errors
    /// When an equal-area image is not square, or texels are too bright to be summed.
    pub fn into_equal_area(self) -> Result<Self, ImageInfiniteLightError> {
        self.into_equal_area_image().map(Self::EqualArea)
    }

    /// How the image lies around the sphere.
    #[must_use]
    pub const fn sphere_map(&self) -> SphereMap {
        match self {
            Self::EqualArea(_) => SphereMap::EqualArea,
            Self::LatLong(_) => SphereMap::LatLong,
        }
    }

    pub(crate) fn into_equal_area_image(self) -> Result<Image, ImageInfiniteLightError> {
        match self {
            Self::EqualArea(image) if image.size()[0] != image.size()[1] => {
                Err(ImageInfiniteLightError::NotSquare)
            }
            Self::EqualArea(image) => Ok(image),
            Self::LatLong(image) => {
                let n = equal_area_size(image.size()[1]);
                image
                    .resampled(SphereMap::LatLong, SphereMap::EqualArea, [n, n])
                    .map_err(|_| ImageInfiniteLightError::TooBright)
            }
        }
    }
}

/// Why the description of an environment light is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ImageInfiniteLightError {
    /// `transform` is not rigid.
    Transform(RigidTransformError),
    /// `map` is an equal-area image that is not square.
    NotSquare,
    /// `map` is too bright to be summed.
    TooBright,
    /// `amount` is negative, not finite, or too large for the map.
    Amount,
}

impl ImageInfiniteLightError {
    /// Whether a map with this integral can be summed, and scaled.
    pub(crate) fn check(integral: Vec3, scale: f32) -> Result<(), Self> {
        if !integral.is_finite() {
            Err(Self::TooBright)
        } else if scale >= 0.0 && (integral * scale).is_finite() {
            Ok(())
        } else {
            Err(Self::Amount)
        }
    }
}

impl fmt::Display for ImageInfiniteLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Transform(error) => error.fmt(f),
            Self::NotSquare => f.write_str("map: an equal-area image must be square"),
            Self::TooBright => f.write_str("map: too bright to be summed"),
            Self::Amount => f.write_str("amount: must be finite, not negative, and fit the map"),
        }
    }
}

impl Error for ImageInfiniteLightError {}

impl From<RigidTransformError> for ImageInfiniteLightError {
    fn from(error: RigidTransformError) -> Self {
        Self::Transform(error)
    }
}
