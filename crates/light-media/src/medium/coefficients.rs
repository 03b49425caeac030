use light_math::glam::Vec3;
use light_math::spectrum::Constant;
use light_sources::{ColorModel, Radiance, Rgb, Spectral, SpectralEmission};

/// The coefficients of a medium at one point, per unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients<R> {
    /// Absorption coefficient, per unit length.
    pub sigma_a: R,
    /// Scattering coefficient, per unit length.
    pub sigma_s: R,
    /// Emitted radiance per unit length, in W m^-2 sr^-1 per unit length.
    pub emission: R,
}

impl<R: Radiance> Coefficients<R> {
    /// Vacuum.
    pub const VACUUM: Self = Self {
        sigma_a: R::BLACK,
        sigma_s: R::BLACK,
        emission: R::BLACK,
    };

    /// The extinction: absorption and scattering together.
    #[inline]
    #[must_use]
    pub fn sigma_t(&self) -> R {
        self.sigma_a + self.sigma_s
    }
}

impl<R: Radiance> Default for Coefficients<R> {
    /// Vacuum.
    fn default() -> Self {
        Self::VACUUM
    }
}

/// The coefficients of a medium at density 1.
#[derive(Clone, Debug)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(bound = "C::Emission: serde::Serialize")
)]
pub struct Substance<C: ColorModel> {
    sigma_a: C::Emission,
    sigma_s: C::Emission,
    le: C::Emission,
    max_sigma_t: f32,
}

/// Why a substance is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CoefficientsError {
    /// The absorption coefficient is negative or not finite.
    SigmaA,
    /// The scattering coefficient is negative or not finite.
    SigmaS,
    /// The emitted radiance is negative or not finite.
    Le,
    /// Absorption and scattering together are not finite.
    SigmaT,
    /// Absorption times emitted radiance is not finite.
    Emission,
}

impl<C: ColorModel> Substance<C> {
    /// A substance with absorption `sigma_a` and scattering `sigma_s` per unit length that emits
    /// `sigma_a le` per unit length: an optically thick layer without scattering has radiance `le`.
    ///
    /// # Errors
    /// A value is negative or not finite, or the extinction or the emission is not finite.
    pub fn new(
        sigma_a: C::Emission,
        sigma_s: C::Emission,
        le: C::Emission,
    ) -> Result<Self, CoefficientsError> {
        for (value, error) in [
            (&sigma_a, CoefficientsError::SigmaA),
            (&sigma_s, CoefficientsError::SigmaS),
            (&le, CoefficientsError::Le),
        ] {
            if !C::is_valid(value) {
                return Err(error);
            }
        }
        let absorbed = C::maximum(&sigma_a);
        let max_sigma_t = absorbed + C::maximum(&sigma_s);
        if !max_sigma_t.is_finite() {
            return Err(CoefficientsError::SigmaT);
        }
        if !(absorbed * C::maximum(&le)).is_finite() {
            return Err(CoefficientsError::Emission);
        }
        Ok(Self {
            sigma_a,
            sigma_s,
            le,
            max_sigma_t,
        })
    }

    /// The coefficients at the given density.
    #[inline]
    #[must_use]
    pub(crate) fn at_density(
        &self,
        density: f32,
        wavelengths: &C::Wavelengths,
    ) -> Coefficients<C::Radiance> {
        let sigma_a = C::emit(&self.sigma_a, wavelengths) * density;
        Coefficients {
            sigma_a,
            sigma_s: C::emit(&self.sigma_s, wavelengths) * density,
            emission: sigma_a * C::emit(&self.le, wavelengths),
        }
    }

    /// The extinction at density 1.
    #[inline]
    #[must_use]
    pub fn sigma_t(&self, wavelengths: &C::Wavelengths) -> C::Radiance {
        C::emit(&self.sigma_a, wavelengths) + C::emit(&self.sigma_s, wavelengths)
    }

    /// An upper bound of the extinction at density 1 over all channels or wavelengths.
    #[inline]
    #[must_use]
    pub(crate) fn max_sigma_t(&self) -> f32 {
        self.max_sigma_t
    }
}

impl<C: ColorModel> Substance<C> {
    /// An upper bound of the emission at density 1 over all channels or wavelengths.
    pub(super) fn max_emission(&self) -> f32 {
        C::maximum(&self.sigma_a) * C::maximum(&self.le)
    }

    /// Vacuum, given the emission that is black in this colour model.
    fn vacuum(black: &C::Emission) -> Self {
        Self {
            sigma_a: black.clone(),
            sigma_s: black.clone(),
            le: black.clone(),
            max_sigma_t: 0.0,
        }
    }
}

impl Default for Substance<Rgb> {
    /// Vacuum.
    fn default() -> Self {
        Self::vacuum(&Vec3::ZERO)
    }
}

impl<const N: usize> Default for Substance<Spectral<N>> {
    /// Vacuum.
    fn default() -> Self {
        Self::vacuum(&SpectralEmission::Constant(Constant(0.0)))
    }
}

impl core::fmt::Display for CoefficientsError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::SigmaA => "sigma_a must be finite and nowhere negative",
            Self::SigmaS => "sigma_s must be finite and nowhere negative",
            Self::Le => "the emission of a medium must be finite and nowhere negative",
            Self::SigmaT => "sigma_a + sigma_s must be finite",
            Self::Emission => "sigma_a times the emission of a medium must be finite",
        })
    }
}

impl core::error::Error for CoefficientsError {}
