//! Spectra: functions of wavelength, samples of them, and conversions to and from colours and
//! units.
//!
//! Wavelengths are nanometres, from [`cie::LAMBDA_MIN`] to [`cie::LAMBDA_MAX`]; a spectrum is 0
//! outside. Emission spectra are per nanometre.

mod blackbody;
pub mod cie;
mod color_space;
mod constant;
mod daylight;
mod dense;
mod integrals;
mod luminance;
mod observer;
pub mod photometric;
mod piecewise_linear;
mod rgb;
mod sampled;
mod sigmoid;
mod uplift;
mod uplift_solver;
mod uplift_table;
mod visible_range;
mod wavelengths;

pub use blackbody::{Blackbody, BlackbodyError};
pub use color_space::{RgbColorSpace, RgbColorSpaceError};
pub use constant::Constant;
pub use daylight::{Daylight, DaylightError};
pub use dense::{DenselySampled, DenselySampledError};
pub use luminance::rec709_luminance;
pub use piecewise_linear::{PiecewiseLinear, PiecewiseLinearError};
pub use rgb::{RgbIlluminant, RgbSpectrumError, RgbUnbounded};
pub use sampled::SampledSpectrum;
pub use sigmoid::SigmoidPolynomial;
pub use uplift::Uplift;
pub use uplift_solver::UpliftSolver;
pub use uplift_table::{UpliftTable, UpliftTableError};
pub use wavelengths::SampledWavelengths;

use integrals::SpectrumIntegrals;

/// A function of wavelength.
pub trait Spectrum {
    /// The value at the wavelength `lambda` in nm.
    fn eval(&self, lambda: f32) -> f32;

    /// An upper bound of the values, tight unless an implementor says otherwise.
    fn max_value(&self) -> f32;

    /// The photometric, the radiometric and the colorimetric integrals. The default sums trapezoids
    /// between whole nanometres; a spectrum with narrower features has a sum of its own.
    fn integrals(&self) -> SpectrumIntegrals {
        SpectrumIntegrals::of_nanometres(|lambda| self.eval(lambda))
    }

    /// The values at the sampled wavelengths.
    #[inline]
    fn sample<const N: usize>(&self, wavelengths: &SampledWavelengths<N>) -> SampledSpectrum<N>
    where
        Self: Sized,
    {
        SampledSpectrum::new(wavelengths.lambda().map(|lambda| self.eval(lambda)))
    }
}
