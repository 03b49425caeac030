//! The amount of light of an emitter, in the unit that the user knows.
//!
//! A radiometric amount is a factor of the emission. With a photometric amount or a power, the
//! emission gives the colour alone, and its scale cancels. For an image (a projected picture, a
//! textured surface or a sky), intensity and luminance are those of its white, `(1, 1, 1)`: an
//! image in cd/m^2 has the luminance `Nit(1.0)`.

use core::f32::consts::PI;

use crate::flux::Flux;
use crate::scaled_emission::EmissionError;
use light_math::spectrum::photometric::{Candela, Lumen, Lux, Nit, Watt};

/// The amount of a point light; the emission gives the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum IntensityAmount {
    /// The intensity is this times the emission, in W/sr; per nanometre in
    /// [`Spectral`](crate::Spectral).
    Radiometric(f32),
    /// The largest intensity: inside of a spot's falloff, where a distribution or picture is 1.
    LuminousIntensity(Candela),
    /// The power in all directions.
    LuminousPower(Lumen),
    /// The power in all directions.
    RadiantPower(Watt),
}

/// The amount of a distant light; the emission gives the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum IrradianceAmount {
    /// The irradiance of a plane that faces the light is this times the emission, in W m^-2; per
    /// nanometre in [`Spectral`](crate::Spectral).
    Radiometric(f32),
    /// The illuminance of a plane that faces the light.
    Illuminance(Lux),
}

/// The amount of a surface or a sky; the emission gives the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum RadianceAmount {
    /// The radiance is this times the emission, in W m^-2 sr^-1; per nanometre in
    /// [`Spectral`](crate::Spectral), where white of an image is 106.9 times as bright as in
    /// [`Rgb`](crate::Rgb).
    Radiometric(f32),
    /// The luminance in all directions. A whole sky of it makes an illuminance of pi times as many
    /// lux on open ground.
    Luminance(Nit),
}

/// The amount of a surface with an area; the emission gives the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum SurfaceAmount {
    /// The radiance or luminance at each point.
    Radiance(RadianceAmount),
    /// The power of all emitting sides and all triangles of a mesh.
    LuminousPower(Lumen),
    /// The power of all emitting sides and all triangles of a mesh.
    RadiantPower(Watt),
}

impl IntensityAmount {
    /// The factor of an emission that has the given intensity and power.
    pub(crate) fn scale(self, intensity: Flux, power: Flux) -> Result<f32, EmissionError> {
        match self {
            Self::Radiometric(scale) => Ok(scale),
            Self::LuminousIntensity(Candela(amount)) => quotient(amount, intensity.luminous),
            Self::LuminousPower(Lumen(amount)) => quotient(amount, power.luminous),
            Self::RadiantPower(Watt(amount)) => quotient(amount, power.radiant),
        }
    }
}

impl IrradianceAmount {
    /// The factor of an emission that has the given irradiance.
    pub(crate) fn scale(self, irradiance: Flux) -> Result<f32, EmissionError> {
        match self {
            Self::Radiometric(scale) => Ok(scale),
            Self::Illuminance(Lux(amount)) => quotient(amount, irradiance.luminous),
        }
    }
}

impl RadianceAmount {
    /// The luminance of a uniform sky that gives open ground an illuminance of `lux`.
    #[must_use]
    pub const fn of_sky(lux: Lux) -> Self {
        Self::Luminance(Nit(lux.0 / PI))
    }

    /// The factor of an emission that has the given radiance.
    pub(crate) fn scale(self, radiance: Flux) -> Result<f32, EmissionError> {
        match self {
            Self::Radiometric(scale) => Ok(scale),
            Self::Luminance(Nit(amount)) => quotient(amount, radiance.luminous),
        }
    }
}

#[cfg(feature = "alloc")]
impl SurfaceAmount {
    /// The factor of an emission that has the given radiance and, over the whole surface, the power
    /// that `power` finds.
    pub(crate) fn scale(
        self,
        radiance: Flux,
        power: impl FnOnce() -> Flux,
    ) -> Result<f32, EmissionError> {
        match self {
            Self::Radiance(amount) => amount.scale(radiance),
            Self::LuminousPower(Lumen(amount)) => quotient(amount, power().luminous),
            Self::RadiantPower(Watt(amount)) => quotient(amount, power().radiant),
        }
    }
}

/// `amount` divided by `unit`. The caller refuses NaN.
fn quotient(amount: f32, unit: f32) -> Result<f32, EmissionError> {
    if unit != 0.0 {
        Ok(amount / unit)
    } else if amount == 0.0 {
        Ok(0.0)
    } else {
        Err(EmissionError::Dark)
    }
}

impl Default for IntensityAmount {
    fn default() -> Self {
        Self::Radiometric(1.0)
    }
}

impl Default for IrradianceAmount {
    fn default() -> Self {
        Self::Radiometric(1.0)
    }
}

impl Default for RadianceAmount {
    fn default() -> Self {
        Self::Radiometric(1.0)
    }
}

impl Default for SurfaceAmount {
    fn default() -> Self {
        RadianceAmount::default().into()
    }
}

impl From<RadianceAmount> for SurfaceAmount {
    fn from(amount: RadianceAmount) -> Self {
        Self::Radiance(amount)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dark_lights_can_only_be_off() {
        let dark = Flux::default();
        let bright = IrradianceAmount::Illuminance(Lux(1.0));
        assert_eq!(bright.scale(dark), Err(EmissionError::Dark), "1 lx");
        let off = IrradianceAmount::Illuminance(Lux(0.0));
        assert_eq!(off.scale(dark), Ok(0.0), "off");
        let power = IntensityAmount::RadiantPower(Watt(1.0));
        assert_eq!(power.scale(dark, dark), Err(EmissionError::Dark), "1 W");
    }
}
