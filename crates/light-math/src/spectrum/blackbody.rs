use super::Spectrum;
use crate::float::exp_m1;

/// Wien's displacement constant, in nm K.
const WIEN: f32 = 2_897_771.955;

/// `h c / (lambda k T)` at the wavelength of the maximum, the same for all temperatures.
const X_PEAK: f32 = 4.965_114_2;

/// `e^X_PEAK - 1`.
const EXP_M1_PEAK: f32 = 142.324_91;

/// The radiance of a black body, scaled so that its largest value over all wavelengths is 1.
///
/// # Source
/// Planck's law as a ratio to its maximum, with `y = lambda_max / lambda`:
/// `y^5 (e^x - 1) / (e^(x y) - 1)`, `x` = 4.9651. In this form no constant of nature but Wien's
/// appears, and nothing over- or underflows on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Blackbody {
    lambda_max: f32,
}

impl Blackbody {
    /// The spectrum at the temperature `kelvin`.
    ///
    /// # Errors
    /// If the temperature is not positive and finite.
    pub fn new(kelvin: f32) -> Result<Self, BlackbodyError> {
        if !(kelvin > 0.0 && kelvin.is_finite()) {
            return Err(BlackbodyError::Temperature);
        }
        Ok(Self {
            lambda_max: WIEN / kelvin,
        })
    }

    /// The temperature in K.
    #[must_use]
    pub fn kelvin(&self) -> f32 {
        WIEN / self.lambda_max
    }
}

impl Spectrum for Blackbody {
    #[inline]
    fn eval(&self, lambda: f32) -> f32 {
        let y = self.lambda_max / lambda;
        let y_sq = y * y;
        let denominator = exp_m1(X_PEAK * y);
        // Far below the maximum the exponential is out of range long before the power is.
        if denominator == f32::INFINITY {
            return 0.0;
        }
        y_sq * y_sq * y * (EXP_M1_PEAK / denominator)
    }

    #[inline]
    fn max_value(&self) -> f32 {
        1.0
    }
}

/// Why a black body is invalid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BlackbodyError {
    /// The temperature is zero, negative, infinite or not a number.
    Temperature,
}

impl core::fmt::Display for BlackbodyError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Temperature => "a black body's temperature in kelvin is positive and finite",
        })
    }
}

impl core::error::Error for BlackbodyError {}

#[cfg(test)]
mod tests {
    use super::*;

    /// Planck's law with the constants of nature, in double precision.
    fn planck(lambda_nm: f64, kelvin: f64) -> f64 {
        let (h, c, k) = (6.626_070_15e-34, 299_792_458.0, 1.380_649e-23);
        let lambda = lambda_nm * 1e-9;
        2.0 * h * c * c / (lambda.powi(5) * ((h * c / (lambda * k * kelvin)).exp_m1()))
    }

    #[test]
    fn agrees_with_planck() {
        for kelvin in [800.0f32, 2856.0, 5000.0, 6500.0, 40_000.0] {
            let b = Blackbody::new(kelvin).expect("valid");
            let t = f64::from(kelvin);
            let peak = planck(2_897_771.955 / t, t);
            for lambda in [360.0f32, 450.0, 555.0, 700.0, 830.0] {
                let expected = planck(f64::from(lambda), t) / peak;
                let error = (f64::from(b.eval(lambda)) / expected - 1.0).abs();
                // The exponent is rounded before e is taken to it.
                assert!(error < 5e-6, "{kelvin} K at {lambda}: {error}");
            }
        }
    }

    #[test]
    fn maximum_is_one() {
        for kelvin in [4000.0, 6000.0] {
            let b = Blackbody::new(kelvin).expect("valid");
            let peak = b.eval(WIEN / kelvin);
            assert!((peak - 1.0).abs() < 1e-5, "{peak}");
            assert_eq!(b.max_value(), 1.0, "the bound");
            assert!((b.kelvin() / kelvin - 1.0).abs() < 1e-6, "temperature");
        }
    }

    #[test]
    fn cold_and_hot_ends_are_finite() {
        for kelvin in [1e-30, 1.0, 1e9, 1e30] {
            let v = Blackbody::new(kelvin).expect("valid").eval(500.0);
            assert!((0.0..=1.0).contains(&v), "{kelvin} K: {v}");
        }
    }

    #[test]
    fn refuses_other_temperatures() {
        for kelvin in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert_eq!(
                Blackbody::new(kelvin),
                Err(BlackbodyError::Temperature),
                "{kelvin}"
            );
        }
    }
}
