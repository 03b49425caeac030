use super::Spectrum;
use super::cie::{LAMBDA_MIN, SAMPLES, nearest_nanometre};

/// A spectrum by its values at each nanometre from 360 to 830; the nearest one counts.
///
/// `S` holds [`LEN`](Self::LEN) values: an array, a borrowed slice, a `Vec`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DenselySampled<S> {
    values: S,
}

impl<S> DenselySampled<S> {
    /// How many values there are.
    pub const LEN: usize = SAMPLES;
}

impl<S: AsRef<[f32]>> DenselySampled<S> {
    /// The spectrum whose value at `360 + i` nm is `values[i]`.
    ///
    /// # Errors
    /// If there are not [`LEN`](Self::LEN) values, or one is not finite.
    pub fn new(values: S) -> Result<Self, DenselySampledError> {
        let slice = values.as_ref();
        if slice.len() != SAMPLES {
            return Err(DenselySampledError::WrongLength);
        }
        if !slice.iter().all(|v| v.is_finite()) {
            return Err(DenselySampledError::NotFinite);
        }
        Ok(Self { values })
    }

    /// The values.
    #[must_use]
    pub fn values(&self) -> &[f32] {
        self.values.as_ref()
    }
}

impl DenselySampled<[f32; SAMPLES]> {
    /// Another spectrum's values at each nanometre.
    #[must_use]
    pub fn from_spectrum(spectrum: &impl Spectrum) -> Self {
        Self {
            values: core::array::from_fn(|i| spectrum.eval(LAMBDA_MIN + i as f32)),
        }
    }
}

impl<S: AsRef<[f32]>> Spectrum for DenselySampled<S> {
    #[inline]
    fn eval(&self, lambda: f32) -> f32 {
        nearest_nanometre(lambda)
            .and_then(|i| self.values().get(i))
            .map_or(0.0, |&v| v)
    }

    fn max_value(&self) -> f32 {
        self.values()
            .iter()
            .fold(f32::NEG_INFINITY, |a, &b| a.max(b))
    }
}

/// Why values are no densely sampled spectrum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum DenselySampledError {
    /// There is not one value for each nanometre from 360 to 830.
    WrongLength,
    /// A value is infinite or not a number.
    NotFinite,
}

impl core::fmt::Display for DenselySampledError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::WrongLength => "a densely sampled spectrum has 471 values, for 360 to 830 nm",
            Self::NotFinite => "a spectrum's value is not finite",
        })
    }
}

impl core::error::Error for DenselySampledError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::Blackbody;

    #[test]
    fn takes_the_nearest_nanometre() {
        let values: [f32; 471] = core::array::from_fn(|i| i as f32);
        let s = DenselySampled::new(&values[..]).expect("valid");
        assert_eq!((s.eval(360.0), s.eval(830.0)), (0.0, 470.0), "ends");
        assert_eq!((s.eval(400.4), s.eval(400.6)), (40.0, 41.0), "nearest");
        assert_eq!((s.eval(359.0), s.eval(831.0)), (0.0, 0.0), "outside");
        assert_eq!(s.max_value(), 470.0, "bound");
    }

    #[test]
    fn resamples_another_spectrum() {
        let b = Blackbody::new(5000.0).expect("valid");
        let s = DenselySampled::from_spectrum(&b);
        assert_eq!(s.eval(500.0), b.eval(500.0), "at a nanometre");
    }

    #[test]
    fn refuses_what_is_no_table() {
        let short = DenselySampled::new([1.0; 3]).expect_err("too short");
        assert_eq!(short, DenselySampledError::WrongLength, "length");
        let nan = DenselySampled::new([f32::NAN; 471]).expect_err("NaN");
        assert_eq!(nan, DenselySampledError::NotFinite, "values");
        assert_ne!(
            alloc::format!("{short}"),
            alloc::format!("{nan}"),
            "messages differ"
        );
    }
}
