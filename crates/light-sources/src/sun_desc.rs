use crate::amount::{IrradianceAmount, RadianceAmount};
use crate::color::ColorModel;
use crate::glam::Vec3;

/// A [`SunLight`](super::sun::SunLight) as a user describes it.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct SunLightDesc<C: ColorModel> {
    /// Direction toward the middle of the sun, of any length above 0.
    pub direction: Vec3,
    /// The angle that the sun's disk spans, in `(0, pi]`; that of the earth's sun is 0.0093.
    pub angular_diameter: f32,
    /// Colour of the light.
    pub emission: C::Emission,
    /// Amount of light.
    pub amount: SunAmount,
}

impl<C: ColorModel> SunLightDesc<C> {
    /// A sun of the size of the earth's, whose middle is toward `direction`, of any length above 0.
    #[must_use]
    pub fn new(direction: Vec3, emission: C::Emission, amount: impl Into<SunAmount>) -> Self {
        Self {
            direction,
            angular_diameter: 0.0093,
            emission,
            amount: amount.into(),
        }
    }
}

/// The amount of a sun; the emission gives the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum SunAmount {
    /// The radiance of its disk.
    Radiance(RadianceAmount),
    /// The irradiance of a plane that faces it.
    Irradiance(IrradianceAmount),
}

impl From<RadianceAmount> for SunAmount {
    fn from(amount: RadianceAmount) -> Self {
        Self::Radiance(amount)
    }
}

impl From<IrradianceAmount> for SunAmount {
    fn from(amount: IrradianceAmount) -> Self {
        Self::Irradiance(amount)
    }
}
