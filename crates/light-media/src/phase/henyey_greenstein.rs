use super::asymmetry::{AsymmetryError, check_asymmetry};
use super::phase_function::PhaseFunction;
use core::f32::consts::PI;
use light_math::float;

/// The Henyey-Greenstein phase function of mean cosine `g`, the usual one for clouds, smoke, skin
/// and milk.
///
/// # Source
/// `[HenyeyGreenstein1941]`; sampling as in `[PBRT4]`, section 11.3.1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HenyeyGreenstein {
    g: f32,
}

impl HenyeyGreenstein {
    /// Below this `g` the inversion divides by a number that is mostly rounding error, and the
    /// linear term is accurate enough.
    const NEARLY_ISOTROPIC: f32 = 1e-3;

    /// The phase function with mean cosine `g`: positive for forward scattering, negative for
    /// backward scattering.
    ///
    /// # Errors
    /// `g` does not lie strictly between -1 and 1.
    pub fn new(g: f32) -> Result<Self, AsymmetryError> {
        check_asymmetry(g).map(|g| Self { g })
    }

    /// The mean cosine of deflection.
    #[must_use]
    pub const fn g(&self) -> f32 {
        self.g
    }
}

impl PhaseFunction for HenyeyGreenstein {
    #[inline]
    fn value(&self, cos_theta: f32) -> f32 {
        let g = self.g;
        // 1 + g^2 - 2 g cos, written so that it does not cancel for g and cos near 1.
        let denominator = (1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - cos_theta);
        (1.0 - g * g) / (4.0 * PI * denominator * float::safe_sqrt(denominator))
    }

    #[inline]
    fn sample_cos(&self, u: f32) -> f32 {
        let g = self.g;
        let x = 2.0 * u - 1.0;
        if g.abs() < Self::NEARLY_ISOTROPIC {
            // To first order in g the density is (1 + 3 g cos) / 2.
            return (x + 1.5 * g * (1.0 - x * x)).clamp(-1.0, 1.0);
        }
        let q = (1.0 - g * g) / (1.0 + g * x);
        ((1.0 + g * g - q * q) / (2.0 * g)).clamp(-1.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refuses_what_has_no_density() {
        for g in [1.0, -1.0, 1.5, f32::NAN, f32::INFINITY] {
            assert_eq!(
                HenyeyGreenstein::new(g),
                Err(AsymmetryError::OutOfRange),
                "{g}"
            );
        }
    }

    #[test]
    fn mean_cosine_is_g() {
        for g in [-0.9, -0.2, 0.0, 5e-4, 0.6, 0.95] {
            let f = HenyeyGreenstein::new(g).expect("in range");
            assert_eq!(f.g(), g, "as given");
            let n = 20_000u16;
            let mean = (0..n)
                .map(|i| f64::from(f.sample_cos((f32::from(i) + 0.5) / f32::from(n))))
                .sum::<f64>()
                / f64::from(n);
            let margin = 1e-3 * f64::from(g.abs()) + 1e-6;
            assert!(
                (mean - f64::from(g)).abs() < margin,
                "mean {mean} for g {g}"
            );
        }
    }
}
