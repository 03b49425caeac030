use core::error::Error;
use core::fmt;

use crate::amount::IntensityAmount;
use crate::color::ColorModel;
use crate::glam::Affine3A;
use crate::medium_interface::MediumInterface;
use crate::rigid_transform::RigidTransformError;
use crate::scaled_emission::EmissionError;

/// A [`SpotLight`](crate::SpotLight) as a user describes it.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct SpotLightDesc<C: ColorModel> {
    /// From light space, where the light is at the origin and emits along +z, to scene space.
    pub transform: Affine3A,
    /// Angle between the axis and the rim of the cone, in `[5e-20, pi]`.
    pub angle: f32,
    /// Angle between the axis and where the light starts to fall off, in `[0, angle]`.
    pub falloff_start: f32,
    /// Colour of the light.
    pub emission: C::Emission,
    /// Amount of light, inside of the falloff.
    pub amount: IntensityAmount,
    /// The medium around it, `outside`.
    pub media: MediumInterface,
}

impl<C: ColorModel> SpotLightDesc<C> {
    /// A light of even intensity up to the rim of its cone, at `angle` in `[5e-20, pi]` from the
    /// axis +z of `transform`, in vacuum.
    #[must_use]
    pub fn new(
        transform: Affine3A,
        angle: f32,
        emission: C::Emission,
        amount: IntensityAmount,
    ) -> Self {
        Self {
            transform,
            angle,
            falloff_start: angle,
            emission,
            amount,
            media: MediumInterface::default(),
        }
    }
}

/// Why the description of a spot light is invalid; each variant names a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SpotLightError {
    /// `transform` is not rigid.
    Transform(RigidTransformError),
    /// `angle` does not lie in `(0, pi]`, or is so small that one over the solid angle of the cone
    /// is no finite number, below about 5e-20.
    Angle,
    /// `falloff_start` does not lie in `[0, angle]`.
    FalloffStart,
    /// `emission` or `amount` is invalid.
    Emission(EmissionError),
}

impl fmt::Display for SpotLightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Transform(error) => error.fmt(f),
            Self::Angle => f.write_str("angle: must lie in [5e-20, pi]"),
            Self::FalloffStart => f.write_str("falloff_start: must lie in [0, angle]"),
            Self::Emission(error) => error.fmt(f),
        }
    }
}

impl Error for SpotLightError {}

impl From<RigidTransformError> for SpotLightError {
    fn from(error: RigidTransformError) -> Self {
        Self::Transform(error)
    }
}

impl From<EmissionError> for SpotLightError {
    fn from(error: EmissionError) -> Self {
        Self::Emission(error)
    }
}
