use super::asymmetry::{AsymmetryError, check_asymmetry};
use super::phase_function::PhaseFunction;
use core::f32::consts::PI;

/// A rational approximation of Henyey-Greenstein: no square root, and an inversion with one
/// division.
///
/// # Source
/// `[Blasi1993]`, section 3.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Schlick {
    k: f32,
}

impl Schlick {
    /// The phase function `(1 - k^2) / (4 pi (1 - k cos)^2)`.
    ///
    /// # Errors
    /// `k` does not lie strictly between -1 and 1.
    pub fn new(k: f32) -> Result<Self, AsymmetryError> {
        check_asymmetry(k).map(|k| Self { k })
    }

    /// The approximation of Henyey-Greenstein of mean cosine `g`: `k = 1.55 g - 0.55 g^3`.
    ///
    /// # Errors
    /// `g` does not lie strictly between -1 and 1, or is above 0.938 or below -0.938, where that `k`
    /// does not lie between them.
    pub fn from_asymmetry(g: f32) -> Result<Self, AsymmetryError> {
        let g = check_asymmetry(g)?;
        Self::new(1.55 * g - 0.55 * g * g * g).map_err(|_| AsymmetryError::NoApproximation)
    }
}

impl PhaseFunction for Schlick {
    #[inline]
    fn value(&self, cos_theta: f32) -> f32 {
        let k = self.k;
        let denominator = 1.0 - k * cos_theta;
        (1.0 - k * k) / (4.0 * PI * denominator * denominator)
    }

    #[inline]
    fn sample_cos(&self, u: f32) -> f32 {
        let x = 2.0 * u - 1.0;
        ((x + self.k) / (1.0 + self.k * x)).clamp(-1.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_narrowest_peaks_are_refused_by_name() {
        for g in [0.938, -0.938, 0.0] {
            assert!(Schlick::from_asymmetry(g).is_ok(), "{g}");
        }
        for (g, error) in [
            (0.94, AsymmetryError::NoApproximation),
            (-0.999, AsymmetryError::NoApproximation),
            (1.0, AsymmetryError::OutOfRange),
        ] {
            assert_eq!(Schlick::from_asymmetry(g), Err(error), "{g}");
        }
    }
}
