//! Spectra: functions of wavelength, samples of them, and the way to and from numbers that people use.
//!
//! Wavelengths are nanometres, from [`cie::LAMBDA_MIN`] to [`cie::LAMBDA_MAX`]; a spectrum is 0 outside. Emission spectra are per
//! nanometre.

mod blackbody;
pub mod cie;
mod constant;
mod daylight;
mod dense;
pub mod photometric;
mod piecewise_linear;
mod sampled;
mod wavelengths;

pub use blackbody::{Blackbody, BlackbodyError};
pub use constant::Constant;
pub use daylight::{Daylight, DaylightError};
pub use dense::{DenselySampled, DenselySampledError};
pub use piecewise_linear::{PiecewiseLinear, PiecewiseLinearError};
pub use sampled::SampledSpectrum;
pub use wavelengths::SampledWavelengths;

/// A function of wavelength.
pub trait Spectrum {
    /// The value at the wavelength `lambda` in nm.
    fn eval(&self, lambda: f32) -> f32;

    /// An upper bound of the values, tight up to round-off.
    fn max_value(&self) -> f32;

    /// The values at the sampled wavelengths.
    #[inline]
    fn sample<const N: usize>(&self, wavelengths: &SampledWavelengths<N>) -> SampledSpectrum<N>
    where
        Self: Sized,
    {
        SampledSpectrum::new(wavelengths.lambda().map(|lambda| self.eval(lambda)))
    }
}
