use super::asymmetry::{AsymmetryError, check_asymmetry};
use super::deflection::Deflection;
use super::phase_function::PhaseFunction;
use core::f32::consts::PI;

/// A rational approximation of Henyey-Greenstein: no square root, and an inversion with one
/// division.
///
/// # Source
/// `[Blasi1993]`, section 3; sampling solved for the distance of the cosine from the peak, which
/// keeps its digits where the peak is narrow.
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

    /// The value where the cosine is less than that of the peak by `from_peak`: 1 straight forward
    /// or, where `k` is negative, straight back.
    #[inline]
    fn value_from_peak(&self, from_peak: f32) -> f32 {
        let k = self.k.abs();
        // 1 - k cos, written so that it does not cancel where it is smallest.
        let narrow = 1.0 - k;
        let denominator = narrow + k * from_peak;
        narrow * (1.0 + k) / (4.0 * PI * denominator * denominator)
    }

    /// By how much the cosine is less than that of the peak, from `u` in `[0, 1)`.
    #[inline]
    fn sample_from_peak(&self, u: f32) -> f32 {
        let k = self.k.abs();
        // Both numbers of the peak's side: the cosine rises with `u`.
        let (u, rest) = if self.k < 0.0 {
            (1.0 - u, u)
        } else {
            (u, 1.0 - u)
        };
        let narrow = 1.0 - k;
        (2.0 * rest * (narrow / (narrow + 2.0 * k * u))).min(2.0)
    }
}

impl PhaseFunction for Schlick {
    #[inline]
    fn value(&self, cos_theta: f32) -> f32 {
        self.value_from_peak((1.0 - cos_theta * self.k.signum()).max(0.0))
    }

    #[inline]
    fn sample_cos(&self, u: f32) -> f32 {
        (1.0 - self.sample_from_peak(u)) * self.k.signum()
    }

    #[inline]
    fn value_at(&self, deflection: Deflection) -> f32 {
        self.value_from_peak(deflection.distance_from_peak(self.k.signum()))
    }

    #[inline]
    fn sample_deflection(&self, u: f32) -> Deflection {
        Deflection::at_distance_from_peak(self.sample_from_peak(u), self.k.signum())
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

    #[test]
    fn narrow_peaks_keep_their_distribution() {
        use crate::phase::{Phase, tests::check_peak};
        for k in [
            0.0f32, 1e-4, 0.5, -0.5, 0.999, -0.999, 0.99999, -0.99999, 0.999999,
        ] {
            let phase = Phase::Schlick(Schlick::new(k).expect("in range"));
            check_peak(phase, k, |from_peak| {
                let k = f64::from(k).abs();
                0.5 * (1.0 + k) * from_peak / (1.0 - k + k * from_peak)
            });
        }
    }

    /// Also a little beyond a cosine of 1, as a product of two unit vectors may be.
    #[test]
    fn peaks_are_as_high_forward_as_back() {
        for k in [0.5, 0.999, 1.0 - f32::EPSILON] {
            // (1 - k^2) / (4 pi (1 - k)^2).
            let peak = f64::from(1.0 + k) / (4.0 * core::f64::consts::PI * f64::from(1.0 - k));
            for (k, cos) in [(k, 1.0), (-k, -1.0), (k, 1.0 + f32::EPSILON)] {
                let value = Schlick::new(k).expect("in range").value(cos);
                let error = (f64::from(value) / peak - 1.0).abs();
                assert!(error < 1e-6, "{k}, {cos}: {value}, {peak}");
            }
        }
    }
}
