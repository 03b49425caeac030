use core::error::Error;
use core::fmt;

use crate::color::ColorModel;

/// An emission with a scale, as every light stores it. Both are finite and not negative.
#[derive(Clone, Debug)]
pub(crate) struct ScaledEmission<C: ColorModel> {
    emission: C::Emission,
    scale: f32,
}

/// Why an emission is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum EmissionError {
    /// `emission` is negative or not finite somewhere.
    Emission,
    /// `amount` is negative or not finite, or too large for this emission.
    Amount,
    /// `amount` is a power or a photometric quantity, but the light is black, invisible or without
    /// an area.
    Dark,
    /// `amount` is so large that the power of this light is not finite, or, of a sky or a sun, its
    /// fluence.
    Power,
}

impl<C: ColorModel> ScaledEmission<C> {
    /// `scale` times `emission`.
    ///
    /// # Errors
    /// When one of them, or their product, is negative or not finite.
    pub(crate) fn new(emission: C::Emission, scale: f32) -> Result<Self, EmissionError> {
        if !C::is_valid(&emission) {
            return Err(EmissionError::Emission);
        }
        if !(scale >= 0.0 && (scale * C::maximum(&emission)).is_finite()) {
            return Err(EmissionError::Amount);
        }
        Ok(Self { emission, scale })
    }

    /// This radiance, if its integral over a solid angle is finite.
    ///
    /// # Errors
    /// When it is not.
    pub(crate) fn with_solid_angle(self, solid_angle: f32) -> Result<Self, EmissionError> {
        let is_finite = (solid_angle * self.maximum()).is_finite();
        is_finite.then_some(self).ok_or(EmissionError::Power)
    }

    /// The value at the wavelengths of a query.
    #[inline]
    #[must_use]
    pub(crate) fn at(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        C::emit(&self.emission, wavelengths) * self.scale
    }

    /// The radiant quantity of the emission, as a power in W; above 0 unless it is black. A line
    /// without width counts as wide as a nanometre.
    #[cfg(feature = "alloc")]
    #[must_use]
    pub(crate) fn radiant(&self) -> f32 {
        let radiant = C::flux(&self.emission).radiant;
        if radiant > 0.0 {
            radiant * self.scale
        } else {
            self.maximum()
        }
    }

    /// The largest value over all channels or wavelengths.
    #[must_use]
    pub(crate) fn maximum(&self) -> f32 {
        C::maximum(&self.emission) * self.scale
    }
}

impl fmt::Display for EmissionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Emission => "emission: must be finite and not negative",
            Self::Amount => "amount: must be finite and not negative",
            Self::Dark => "amount: a light that is black, invisible or without an area has none",
            Self::Power => "amount: too large, the power of the light is not finite",
        })
    }
}

impl Error for EmissionError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::amount::RadianceAmount;
    use crate::glam::Vec3;
    use crate::rgb::Rgb;
    use crate::scene_sphere::SceneSphere;
    use crate::sun::{SunLight, SunLightError};
    use crate::sun_desc::{SunAmount, SunLightDesc};
    use crate::uniform_infinite::{UniformInfiniteLight, UniformInfiniteLightDesc};
    use core::f32::consts::PI;

    #[test]
    fn refuses_nonsense_by_field() {
        let new = |e: f32, scale| ScaledEmission::<Rgb>::new(Vec3::splat(e), scale).err();
        assert_eq!(new(1.0, 0.0), None, "a light may be off");
        assert_eq!(new(-1.0, 1.0), Some(EmissionError::Emission), "negative");
        assert_eq!(new(1.0, -1.0), Some(EmissionError::Amount), "negative");
        assert_eq!(new(1.0, f32::NAN), Some(EmissionError::Amount), "NaN");
        assert_eq!(new(1e30, 1e30), Some(EmissionError::Amount), "overflow");
    }

    /// Infinite fluence would make the choice of a sky certain, and of all other lights impossible.
    #[test]
    fn skies_of_infinite_fluence_are_refused() {
        let scene = SceneSphere::new(Vec3::ZERO, 1e-3).expect("a sphere");
        let amount = RadianceAmount::default();
        let sky = |radiance| {
            let desc = UniformInfiniteLightDesc::new(Vec3::splat(radiance), amount);
            UniformInfiniteLight::<Rgb>::new(desc, scene).err()
        };
        assert_eq!(sky(2e37), None, "2.5e38 in all");
        assert_eq!(sky(3e37), Some(EmissionError::Power), "3.8e38 in all");
        let sun = |radiance| {
            let desc = SunLightDesc {
                direction: Vec3::Y,
                angular_diameter: PI,
                emission: Vec3::splat(radiance),
                amount: SunAmount::Radiance(amount),
            };
            SunLight::<Rgb>::new(desc, scene).err()
        };
        assert_eq!(sun(5e37), None, "3.1e38 in all");
        let expected = Some(SunLightError::Emission(EmissionError::Power));
        assert_eq!(sun(6e37), expected, "3.8e38 in all");
    }
}
