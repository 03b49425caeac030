#[cfg(feature = "alloc")]
use alloc::sync::Arc;

use light_math::spectrum::photometric::SpectrumIntegrals;
use light_math::spectrum::{
    Blackbody, Constant, Daylight, RgbIlluminant, RgbUnbounded, SampledSpectrum,
    SampledWavelengths, Spectrum,
};
#[cfg(feature = "alloc")]
use light_math::spectrum::{DenselySampled, PiecewiseLinear};

/// The emission spectrum of a light in the spectral colour model: one of the spectra of
/// `light-math`.
///
/// Tables are shared by clones.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SpectralEmission {
    /// Constant over wavelength.
    Constant(Constant),
    /// A black body, 1 at its maximum.
    Blackbody(Blackbody),
    /// Daylight, with the luminance 1.
    Daylight(Daylight),
    /// A colour as a light: white is the illuminant.
    RgbIlluminant(RgbIlluminant),
    /// A colour as a factor: white is constant.
    RgbUnbounded(RgbUnbounded),
    /// Measured at each nanometre.
    #[cfg(feature = "alloc")]
    Dense(DenselySampled<Arc<[f32]>>),
    /// Measured at some wavelengths.
    #[cfg(feature = "alloc")]
    PiecewiseLinear(PiecewiseLinear<Arc<[f32]>>),
}

impl SpectralEmission {
    /// Whether the spectrum is finite and nowhere negative.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        let values_are_valid = match self {
            // Their constructors ensure it.
            Self::Blackbody(_) | Self::Daylight(_) => true,
            Self::RgbIlluminant(_) | Self::RgbUnbounded(_) => true,
            Self::Constant(constant) => constant.0 >= 0.0,
            #[cfg(feature = "alloc")]
            Self::Dense(dense) => dense.values().iter().all(|&v| v >= 0.0),
            #[cfg(feature = "alloc")]
            Self::PiecewiseLinear(linear) => linear.values().iter().all(|&v| v >= 0.0),
        };
        values_are_valid && self.max_value().is_finite()
    }
}

impl Spectrum for SpectralEmission {
    #[inline]
    fn eval(&self, lambda: f32) -> f32 {
        match self {
            Self::Constant(s) => s.eval(lambda),
            Self::Blackbody(s) => s.eval(lambda),
            Self::Daylight(s) => s.eval(lambda),
            Self::RgbIlluminant(s) => s.eval(lambda),
            Self::RgbUnbounded(s) => s.eval(lambda),
            #[cfg(feature = "alloc")]
            Self::Dense(s) => s.eval(lambda),
            #[cfg(feature = "alloc")]
            Self::PiecewiseLinear(s) => s.eval(lambda),
        }
    }

    fn max_value(&self) -> f32 {
        match self {
            Self::Constant(s) => s.max_value(),
            Self::Blackbody(s) => s.max_value(),
            Self::Daylight(s) => s.max_value(),
            Self::RgbIlluminant(s) => s.max_value(),
            Self::RgbUnbounded(s) => s.max_value(),
            #[cfg(feature = "alloc")]
            Self::Dense(s) => s.max_value(),
            #[cfg(feature = "alloc")]
            Self::PiecewiseLinear(s) => s.max_value(),
        }
    }

    fn integrals(&self) -> SpectrumIntegrals {
        match self {
            Self::Constant(s) => s.integrals(),
            Self::Blackbody(s) => s.integrals(),
            Self::Daylight(s) => s.integrals(),
            Self::RgbIlluminant(s) => s.integrals(),
            Self::RgbUnbounded(s) => s.integrals(),
            #[cfg(feature = "alloc")]
            Self::Dense(s) => s.integrals(),
            #[cfg(feature = "alloc")]
            Self::PiecewiseLinear(s) => s.integrals(),
        }
    }

    /// Matches the kind of spectrum once, not once per wavelength.
    #[inline]
    fn sample<const N: usize>(&self, wavelengths: &SampledWavelengths<N>) -> SampledSpectrum<N> {
        match self {
            Self::Constant(s) => s.sample(wavelengths),
            Self::Blackbody(s) => s.sample(wavelengths),
            Self::Daylight(s) => s.sample(wavelengths),
            Self::RgbIlluminant(s) => s.sample(wavelengths),
            Self::RgbUnbounded(s) => s.sample(wavelengths),
            #[cfg(feature = "alloc")]
            Self::Dense(s) => s.sample(wavelengths),
            #[cfg(feature = "alloc")]
            Self::PiecewiseLinear(s) => s.sample(wavelengths),
        }
    }
}

impl Default for SpectralEmission {
    /// Constant 1.
    fn default() -> Self {
        Self::Constant(Constant(1.0))
    }
}

impl From<Constant> for SpectralEmission {
    fn from(spectrum: Constant) -> Self {
        Self::Constant(spectrum)
    }
}

impl From<Blackbody> for SpectralEmission {
    fn from(spectrum: Blackbody) -> Self {
        Self::Blackbody(spectrum)
    }
}

impl From<Daylight> for SpectralEmission {
    fn from(spectrum: Daylight) -> Self {
        Self::Daylight(spectrum)
    }
}

impl From<RgbIlluminant> for SpectralEmission {
    fn from(spectrum: RgbIlluminant) -> Self {
        Self::RgbIlluminant(spectrum)
    }
}

impl From<RgbUnbounded> for SpectralEmission {
    fn from(spectrum: RgbUnbounded) -> Self {
        Self::RgbUnbounded(spectrum)
    }
}

#[cfg(feature = "alloc")]
impl From<DenselySampled<Arc<[f32]>>> for SpectralEmission {
    fn from(spectrum: DenselySampled<Arc<[f32]>>) -> Self {
        Self::Dense(spectrum)
    }
}

#[cfg(feature = "alloc")]
impl From<PiecewiseLinear<Arc<[f32]>>> for SpectralEmission {
    fn from(spectrum: PiecewiseLinear<Arc<[f32]>>) -> Self {
        Self::PiecewiseLinear(spectrum)
    }
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use crate::glam::Vec3;
    use light_math::spectrum::UpliftTable;

    fn table(values: &[f32]) -> SpectralEmission {
        let lambdas: Arc<[f32]> = Arc::from([400.0, 500.0, 700.0].as_slice());
        let linear = PiecewiseLinear::new(lambdas, Arc::from(values));
        linear.expect("valid").into()
    }

    /// One of each kind.
    fn kinds() -> [SpectralEmission; 7] {
        let rgb = Vec3::new(0.2, 0.5, 0.9);
        let unbounded = RgbUnbounded::new(&UpliftTable::SRGB, rgb).expect("valid");
        let illuminant = RgbIlluminant::new(&UpliftTable::SRGB, Daylight::D65, rgb).expect("valid");
        let dense: Arc<[f32]> = Arc::from([2.0; 471].as_slice());
        [
            Constant(3.0).into(),
            Blackbody::new(3000.0).expect("valid").into(),
            Daylight::D50.into(),
            illuminant.into(),
            unbounded.into(),
            DenselySampled::new(dense).expect("valid").into(),
            table(&[1.0, 4.0, 0.0]),
        ]
    }

    #[test]
    fn samples_are_values_and_below_the_bound() {
        let w = SampledWavelengths::<8>::uniform(0.7);
        for emission in kinds() {
            assert!(emission.is_valid(), "{emission:?}");
            for (value, lambda) in emission.sample(&w).values().iter().zip(w.lambda()) {
                assert_eq!(*value, emission.eval(*lambda), "{emission:?}");
                assert!(*value <= emission.max_value() * 1.000_01, "{emission:?}");
            }
        }
    }

    #[test]
    fn negative_values_in_tables_are_refused() {
        assert!(!table(&[1.0, -1e-6, 1.0]).is_valid(), "between good ones");
        let mut values = [1.0; 471];
        values[200] = -1.0;
        let dense: Arc<[f32]> = Arc::from(values.as_slice());
        let dense = DenselySampled::new(dense).expect("finite");
        assert!(!SpectralEmission::from(dense).is_valid(), "one nanometre");
    }
}
