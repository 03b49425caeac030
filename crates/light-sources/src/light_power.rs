use crate::color::ColorModel;
#[cfg(feature = "alloc")]
use crate::glam::Vec3;
use crate::scaled_emission::ScaledEmission;

/// The power of a light: a colour, and numbers that do not depend on the wavelength.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightPower<'a, C: ColorModel> {
    pub(crate) color: PowerColor<'a, C>,
    /// The scale of the colour.
    pub(crate) scale: f32,
    /// Solid angle, area or both.
    pub(crate) etendue: f32,
}

/// The colour of a power.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PowerColor<'a, C: ColorModel> {
    Emission(&'a ScaledEmission<C>),
    /// The mean of an image.
    #[cfg(feature = "alloc")]
    Texel(Vec3),
}

impl<'a, C: ColorModel> LightPower<'a, C> {
    pub(crate) const fn of_emission(emission: &'a ScaledEmission<C>, etendue: f32) -> Self {
        Self {
            color: PowerColor::Emission(emission),
            scale: 1.0,
            etendue,
        }
    }

    #[cfg(feature = "alloc")]
    pub(crate) const fn of_texel(rgb: Vec3, etendue: f32) -> Self {
        Self {
            color: PowerColor::Texel(rgb),
            scale: 1.0,
            etendue,
        }
    }

    /// The power at the wavelengths of a query.
    #[inline]
    pub(crate) fn at(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        let color = match self.color {
            PowerColor::Emission(emission) => emission.at(wavelengths),
            #[cfg(feature = "alloc")]
            PowerColor::Texel(rgb) => C::emit_texel(rgb, wavelengths),
        };
        color * self.scale * self.etendue
    }
}
