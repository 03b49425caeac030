use core::error::Error;
use core::fmt;

use crate::amount::RadianceAmount;
use crate::glam::{Affine3A, Vec3};
use crate::image_infinite_desc::{EnvironmentMap, ImageInfiniteLightError};

/// A [`PortalInfiniteLight`](crate::PortalInfiniteLight) as a user describes it.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PortalInfiniteLightDesc {
    /// From light space to the scene; only its rotation counts.
    pub transform: Affine3A,
    /// The picture of the sky.
    pub map: EnvironmentMap,
    /// Amount of light, as a factor of the picture.
    pub amount: RadianceAmount,
    /// Corners of the portal in the scene, one after the other; light comes from where they run
    /// clockwise.
    pub portal: [Vec3; 4],
}

impl PortalInfiniteLightDesc {
    /// The sky of `map` in light space, as [`ImageInfiniteLightDesc`](crate::ImageInfiniteLightDesc)
    /// has it, through the rectangle of these corners in the scene, one after the other; light comes
    /// from where they run clockwise.
    #[must_use]
    pub fn new(map: EnvironmentMap, portal: [Vec3; 4]) -> Self {
        Self {
            transform: Affine3A::IDENTITY,
            map,
            amount: RadianceAmount::default(),
            portal,
        }
    }
}

/// Why the description of a portal light is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PortalInfiniteLightError {
    /// `transform`, `map` or `amount` is invalid.
    Sky(ImageInfiniteLightError),
    /// `portal` is not a planar rectangle with an area.
    Portal,
}

impl fmt::Display for PortalInfiniteLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sky(error) => error.fmt(f),
            Self::Portal => f.write_str("portal: must be a planar rectangle with an area"),
        }
    }
}

impl Error for PortalInfiniteLightError {}

impl From<ImageInfiniteLightError> for PortalInfiniteLightError {
    fn from(error: ImageInfiniteLightError) -> Self {
        Self::Sky(error)
    }
}
